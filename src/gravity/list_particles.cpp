// SPDX-License-Identifier: BSD-3-Clause
// What list sums are of: the host's numbers checked and sorted, and boxes, in the sums' units.
#include <cmath>
#include <string>

#include "list_operators.hpp"
#include "tree/check_array.hpp"

namespace connectivity::detail {

namespace {

using tree_detail::check_array;
using tree_detail::element;

struct Survey {
    double mass = 0, softening = 0;  ///< sum of |m|, largest length
};

void check_lengths(const char* kind, const void* lengths, CoordinateType type, Offset stride,
                   Offset n, Survey& found) {
    if (lengths == nullptr) return;
    check_array(std::string(kind) + " softening",
                {.positions = lengths, .n = n, .particle_stride = stride}, 1, type);
    for (Offset i = 0; i < n; ++i) {
        const double e = element(lengths, type, i * stride);
        if (!std::isfinite(e) || e < 0)
            throw Error(std::isfinite(e) ? Status::argument : Status::nonfinite,
                        std::string(kind) + " " + std::to_string(i) + ": softening = " + number(e) +
                            ", must be finite and >= 0");
        found.softening = std::max(found.softening, e);
    }
}

Survey survey(const TreeView& tree, const ListMasses& in) {
    if (in.n != tree.sources.n)
        throw Error(Status::argument, "list sums: masses of " + std::to_string(in.n) +
                                          " sources are given, must be " +
                                          std::to_string(tree.sources.n) + " as in the tree");
    if (tree.sources_are_targets && in.target_softening != nullptr)
        throw Error(Status::argument,
                    "list sums: target_softening is given for a tree whose sources are its "
                    "targets, must be null there");
    Survey found;
    check_array("mass", {.positions = in.masses, .n = in.n, .particle_stride = in.mass_stride}, 1,
                in.type);
    for (Offset i = 0; i < in.n; ++i) {
        const double m = element(in.masses, in.type, i * in.mass_stride);
        if (!std::isfinite(m))
            throw Error(Status::nonfinite, "source " + std::to_string(i) + ": mass = " + number(m) +
                                               ", must be finite");
        found.mass += std::abs(m);
    }
    if (!std::isfinite(found.mass))
        throw Error(Status::argument,
                    "list sums: the masses sum to " + number(found.mass) + ", must be finite");
    check_lengths("source", in.softening, in.type, in.softening_stride, in.n, found);
    check_lengths("target", in.target_softening, in.type, in.target_softening_stride,
                  tree.targets.n, found);
    return found;
}

/// The power of two u with value / u in (0.5, 1]; 1 for 0.
double unit_of(double value) {
    if (value == 0) return 1;
    int exponent = 0;
    if (std::frexp(value, &exponent) == 0.5) --exponent;
    return std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
}

template <class Body>
void for_range(const char* label, Offset n, const Body& body) {
    Kokkos::parallel_for(label, Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         body);
    HostExec().fence();
}

}  // namespace

void ListOperators::prepare(const TreeView& tree, const ListMasses& masses,
                            const ListSumOptions& options) {
    const Survey found = survey(tree, masses);
    tree_ = tree;
    order_ = options.order;
    stride_ = expansion_stride(order_);
    law_ = found.softening == 0                      ? PairLaw::newton
           : options.softening == Softening::plummer ? PairLaw::plummer
                                                     : PairLaw::sph_exa;
    choose_units(found.mass);
    reserve(options.budget);
    sort_particles(masses);
    place_boxes();
}

/// Where the root is small and far from the origin, the origin decides.
void ListOperators::choose_units(double total_mass) {
    double farthest = 0;
    for (int d = 0; d < tree_.dim; ++d)
        farthest = std::max(
            {farthest, std::abs(tree_.bounding_box_min[d]), std::abs(tree_.bounding_box_max[d])});
    length_ = std::max(unit_of(tree_.root_extent), unit_of(farthest) * 0x1p-55);
    mass_unit_ = unit_of(total_mass);
    for (int image = 0; image < 27; ++image)
        for (int d = 0; d < 3; ++d)
            shifts_[3 * image + d] =
                image_shift(static_cast<ImageCode>(image))[d] * (tree_.root_extent / length_);
}

void ListOperators::reserve(const Budget& budget) {
    const bool softened = law_ != PairLaw::newton, same = tree_.sources_are_targets;
    const Offset n_sources = (softened ? 5 : 4) * tree_.sources.n,
                 n_targets = same ? 0 : (softened ? 4 : 3) * tree_.targets.n,
                 n_expansions = tree_.n_boxes * stride_;
    const Offset bytes =
        static_cast<Offset>(sizeof(double)) *
        (n_sources + n_targets + 4 * tree_.targets.n + 4 * tree_.n_boxes + 2 * n_expansions);
    if (!budget.allows(bytes))
        throw Error(Status::budget, "list sums of order " + std::to_string(order_) + " in " +
                                        std::to_string(tree_.n_boxes) + " boxes need " +
                                        human_bytes(bytes) + ", the budget is " +
                                        human_bytes(budget.allowed()));
    ensure_capacity(sources_, "list_sums/sources", n_sources);
    ensure_capacity(targets_, "list_sums/targets", n_targets);
    ensure_capacity(boxes_, "list_sums/boxes", 4 * tree_.n_boxes);
    ensure_capacity(moments_, "list_sums/moments", n_expansions);
    ensure_capacity(locals_, "list_sums/locals", n_expansions);
    ensure_capacity(sums_, "list_sums/sums", 4 * tree_.targets.n);
    rows_.resize(static_cast<std::size_t>(n_workers()));
}

void ListOperators::sort_particles(const ListMasses& in) {
    const bool softened = law_ != PairLaw::newton;
    const auto length = [&](const void* lengths, Offset i) {
        return lengths == nullptr ? 0 : element(lengths, in.type, i) / length_;
    };
    const auto place = [&](const TreeParticles& particles, Offset k, const View<double>& to) {
        for (int d = 0; d < 3; ++d)
            to(d * particles.n + k) =
                d < tree_.dim ? particles.positions(d * particles.n + k) / length_ : 0;
    };
    const Offset n = tree_.sources.n, n_targets = tree_.targets.n;
    for_range("list_sums/sources", n, [&](const Offset k) {
        const Offset i = tree_.user_source_ids(k);
        place(tree_.sources, k, sources_);
        sources_(3 * n + k) = element(in.masses, in.type, i * in.mass_stride) / mass_unit_;
        if (softened) sources_(4 * n + k) = length(in.softening, i * in.softening_stride);
    });
    if (tree_.sources_are_targets) return;
    for_range("list_sums/targets", n_targets, [&](const Offset i) {
        const Offset k = tree_.sorted_target_ids(i);
        place(tree_.targets, k, targets_);
        if (softened)
            targets_(3 * n_targets + k) =
                length(in.target_softening, i * in.target_softening_stride);
    });
}

void ListOperators::place_boxes() {
    const Offset n = tree_.n_boxes;
    const double half_diagonal = 0.5 * std::sqrt(tree_.dim) * (tree_.root_extent / length_);
    int exponent = 0;
    if (std::frexp(half_diagonal, &exponent) == 0.5) --exponent;
    for_range("list_sums/boxes", n, [&](const Offset b) {
        for (int d = 0; d < 3; ++d)
            boxes_(d * n + b) =
                d < tree_.dim ? tree_.center(d, static_cast<BoxId>(b)) / length_ : 0;
        boxes_(3 * n + b) = std::ldexp(1.0, exponent - tree_.box_levels(b));
    });
}

Offset ListOperators::bytes() const {
    std::size_t n = sources_.size() + targets_.size() + boxes_.size() + moments_.size() +
                    locals_.size() + sums_.size();
    for (const std::vector<double>& rows : rows_) n += rows.capacity();
    return static_cast<Offset>(n * sizeof(double));
}

}  // namespace connectivity::detail
