// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/box_tree.hpp>

#include <utility>

#include <connectivity/base/runtime.hpp>
#include <connectivity/tree/particle_hulls.hpp>

#include "check_input.hpp"
#include "grow.hpp"
#include "mesh_tree.hpp"
#include "restrict_levels.hpp"
#include "sort_particles.hpp"

namespace connectivity {

using namespace tree_detail;

namespace {

constexpr Offset bytes_per_box = 200;  // of a raw box, its id and its arrays, hulls included

std::int64_t limit_of(const TreeOptions& options) {
    return options.max_particles_in_box ? *options.max_particles_in_box
                                        : *options.max_leaf_refine_weight;
}

bool any_radii(const TreeInput& input) {
    return input.sources.radii != nullptr || (input.targets && input.targets->radii != nullptr);
}

void check_budget(const TreeInput& input, const Budget& budget) {
    const Offset needed = estimate_tree_bytes(input);
    if (budget.allows(needed)) return;
    throw Error(Status::budget,
                "the tree of " +
                    std::to_string(input.sources.n + (input.targets ? input.targets->n : 0)) +
                    " particles needs " + human_bytes(needed) + ", allowed are " +
                    human_bytes(budget.allowed()));
}

template <class Real, int Dim>
TreeView header_of(const TreeInput& input, const TreeOptions& options,
                   const Frame<Real, Dim>& frame) {
    TreeView tree;
    tree.dim = Dim;
    tree.coordinates = input.coordinates;
    tree.sources_are_targets = !input.targets.has_value();
    tree.root_extent = frame.extent;
    for (int d = 0; d < Dim; ++d) {
        tree.periodic[d] = options.periodic[d];
        tree.bounding_box_min[d] = frame.lo[d];
        tree.bounding_box_max[d] =
            static_cast<double>(frame.lo[d]) + static_cast<double>(frame.side[d]);
    }
    tree.stick_out_factor = options.stick_out_factor.value_or(0);
    if (any_radii(input)) tree.extent_norm = options.extent_norm;
    tree.sources.n = input.sources.n;
    tree.targets.n = input.targets ? input.targets->n : input.sources.n;
    return tree;
}

}  // namespace

struct BoxTree::Impl {
    TreeArrays arrays;
    TreeView view;
    GrowScratch scratch;
    View<std::int32_t> rank;
    Report report;

    template <class Real, int Dim>
    void build(const TreeInput& input, const TreeOptions& options);

private:
    void record(const char* part, Stopwatch& watch, Offset bytes) {
        ReportEntry& entry = report.entry(part);
        entry.built = true;
        entry.ms = watch.ms();
        entry.bytes = bytes;
        watch = Stopwatch();
    }
    void make_hulls(TreeArrays& next);
};

template <class Real, int Dim>
void BoxTree::Impl::build(const TreeInput& input, const TreeOptions& options) {
    Stopwatch watch;
    const Particles<Real, Dim> particles(input);
    check_weights(input, limit_of(options));
    const Frame<Real, Dim> frame = root_box(particles, options);
    record("root box", watch, 0);

    const StickOut<Real, Dim> stick_out{frame, options.stick_out_factor.value_or(0),
                                        options.extent_norm};
    const bool restricted = options.kind == TreeKind::adaptive_level_restricted;
    GrowOptions grow_options;
    grow_options.adaptive = options.kind != TreeKind::non_adaptive;
    grow_options.keep_empty = options.skip_prune || restricted;
    grow_options.coincident_leaf = options.coincident == Coincident::leaf;
    grow_options.limit = limit_of(options);
    grow_options.weights = input.refine_weights;
    grow_options.max_boxes = std::min(max_slots, options.budget.allowed() / bytes_per_box + 1);
    RawTree raw = grow(particles, stick_out, grow_options, scratch);
    if (restricted)
        restrict_levels(particles, stick_out, options.periodic, grow_options.max_boxes, raw);
    record("boxes", watch, 0);

    const BoxNumbers numbers = number_boxes(raw, options.skip_prune);
    TreeArrays next;
    next.header = header_of(input, options, frame);
    next.header.n_levels = static_cast<int>(numbers.ids.size());
    next.header.n_boxes = numbers.level_starts.back();
    next.header.aligned_n_boxes = (next.header.n_boxes + 31) / 32 * 32;
    next.source_radii = input.sources.radii != nullptr;
    next.target_radii = input.targets && input.targets->radii != nullptr;
    next.hulls =
        options.hulls == Hulls::always || (options.hulls == Hulls::automatic && any_radii(input));
    if (input.targets) ensure_capacity(rank, "tree/rank", particles.n() + 1);
    view = TreeView();  // lets go of the old tree; `arrays` can give it back
    try {
        next.take(arrays);
    } catch (...) {
        view = arrays.view();
        throw;
    }
    fill_boxes(raw, numbers, next);
    record("numbers", watch, 0);
    sort_particles(particles, raw, numbers, rank.data(), next);
    record("particles", watch, 0);
    if (next.hulls) make_hulls(next);
    record("hulls", watch, 0);
    arrays = std::move(next);
    view = arrays.view();
}

void BoxTree::Impl::make_hulls(TreeArrays& next) {
    const TreeView tree = next.view();
    particle_hulls(tree, tree.sources, next.sources.hull_min, next.sources.hull_max);
    if (!tree.sources_are_targets)
        particle_hulls(tree, tree.targets, next.targets.hull_min, next.targets.hull_max);
}

BoxTree::BoxTree() : impl_(std::make_unique<Impl>()) {}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::build(const TreeInput& input, const TreeOptions& options) {
    run_kernels("box tree", [&] {
        check_arguments(input, options);
        check_budget(input, options.budget);
        const auto build = [&]<class Real>(Real) {
            if (input.dim == 1) impl_->build<Real, 1>(input, options);
            if (input.dim == 2) impl_->build<Real, 2>(input, options);
            if (input.dim == 3) impl_->build<Real, 3>(input, options);
        };
        input.coordinates == CoordinateType::float32 ? build(0.0f) : build(0.0);
    });
}

void BoxTree::build(const MeshBoxes& boxes) {
    run_kernels("box tree", [&] {
        TreeArrays next = mesh_tree(boxes);
        impl_->arrays = std::move(next);
        impl_->view = impl_->arrays.view();
        impl_->report = Report();
    });
}

const TreeView& BoxTree::view() const { return impl_->view; }
const Report& BoxTree::report() const { return impl_->report; }
Offset BoxTree::bytes() const { return impl_->arrays.bytes(); }
Offset BoxTree::scratch_bytes() const {
    return impl_->scratch.bytes() + static_cast<Offset>(impl_->rank.size() * sizeof(std::int32_t));
}
void BoxTree::release_scratch() {
    impl_->scratch = {};
    impl_->rank = {};
}

Offset estimate_tree_bytes(const TreeInput& input) {
    const auto kind = [&](const ParticleArray& a) {
        return a.n * static_cast<Offset>(input.dim * sizeof(double) + sizeof(std::int32_t) +
                                         (a.radii != nullptr ? sizeof(double) : 0));
    };
    const Offset n = input.sources.n + (input.targets ? input.targets->n : 0);
    Offset bytes = kind(input.sources) + n * static_cast<Offset>(2 * sizeof(Entry) + 4);
    bytes += input.targets ? kind(*input.targets) + 4 * n : 4 * n;
    return bytes;
}

}  // namespace connectivity
