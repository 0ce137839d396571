// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/gravity/list_sums.hpp>

#include <cmath>
#include <string>
#include <utility>

#include <connectivity/base/runtime.hpp>

#include "list_operators.hpp"

namespace connectivity {

using namespace detail;

namespace {

void check_options(const ListSumOptions& o) {
    const auto refuse = [](const std::string& text) {
        throw Error(Status::argument, "list sums: " + text);
    };
    if (o.order < 1 || o.order > max_gravity_order)
        refuse("order is " + std::to_string(o.order) + ", must be in [1, " +
               std::to_string(max_gravity_order) + "]");
    if (!(o.constant > 0) || !std::isfinite(o.constant))
        refuse("constant is " + number(o.constant) + ", must be finite and > 0");
    if (o.softening != Softening::plummer && o.softening != Softening::sph_exa)
        refuse("softening is " + std::to_string(static_cast<int>(o.softening)) +
               ", must be in [0, 1]");
}

void check_lists(const FMMTraversalInfo& lists) {
    const std::pair<bool, const char*> wanted[] = {
        {lists.has_neighbor_source_boxes(), "list 1 (neighbor_source_boxes)"},
        {lists.has_from_sep_siblings(), "list 2 (from_sep_siblings)"},
        {lists.has_from_sep_smaller(), "list 3 (from_sep_smaller)"},
        {lists.has_from_sep_bigger(), "list 4 (from_sep_bigger)"}};
    for (const auto& [is_there, name] : wanted)
        if (!is_there)
            throw Error(Status::not_built, std::string("list sums: the traversal has no ") + name +
                                               ", must have been asked for all of lists 1 to 4");
}

/// Trees of boxes without particles have no arrays of these.
void check_tree(const TreeView& tree) {
    const std::pair<const TreeParticles*, const char*> kinds[] = {{&tree.sources, "sources"},
                                                                  {&tree.targets, "targets"}};
    for (const auto& [particles, name] : kinds)
        for (const auto& counts :
             {particles->box_starts, particles->box_counts_nonchild, particles->box_counts_cumul})
            if (static_cast<Offset>(counts.size()) < tree.n_boxes)
                throw Error(Status::null, std::string("list sums: the tree does not tell which ") +
                                              name +
                                              " its boxes have, must be a tree of particles");
}

struct Solution {
    Offset n = 0;
    View<double> acceleration, potential;
    Report report;
};

/// Storage for n values: the old one if it is large enough and nobody else holds it.
View<double> spare(const View<double>& old, const char* label, Offset n) {
    if (n <= static_cast<Offset>(old.size()) && old.use_count() <= 1) return old;
    return allocate<double>(label, n);
}

ConstView<double> cut(const View<double>& view, Offset n) {
    return Kokkos::subview(view, std::pair<std::size_t, std::size_t>(0, n));
}

}  // namespace

struct ListSums::Impl {
    ListOperators operators;
    ListEvaluation<ListOperators> evaluation;
    Solution now;

    void check_finite(Offset n, double force, double potential) const {
        double most_force = 0, most_potential = 0;
        const Sums sums = operators.sums();
        for (Offset k = 0; k < n; ++k) {
            most_potential = std::max(most_potential, std::abs(sums.p[k]));
            for (const double* const a : {sums.ax, sums.ay, sums.az})
                most_force = std::max(most_force, std::abs(a[k]));
        }
        if (!std::isfinite(most_force * force) || !std::isfinite(most_potential * potential))
            throw Error(Status::nonfinite,
                        "list sums overflow: the largest force is " + number(most_force) +
                            " times " + number(force) +
                            " in the units of the particles, must be below 1.8e308");
    }

    /// To the host's order and units. Nothing of the solution before is touched before nothing can
    /// fail any more.
    void hand_over(const TreeView& tree, double constant, Report&& report) {
        const Offset n = tree.targets.n;
        const double potential = constant * operators.mass_unit() / operators.length();
        const double force = potential / operators.length();
        check_finite(n, force, potential);
        auto a = spare(now.acceleration, "list_sums/acceleration", 3 * n);
        auto p = spare(now.potential, "list_sums/potential", n);
        const Sums sums = operators.sums();
        Kokkos::parallel_for("list_sums/hand_over", Kokkos::RangePolicy<HostExec>(0, n),
                             [&](const Offset i) {
                                 const Offset k = tree.sorted_target_ids(i);
                                 p(i) = -potential * sums.p[k];
                                 a(3 * i) = force * sums.ax[k];
                                 a(3 * i + 1) = force * sums.ay[k];
                                 a(3 * i + 2) = force * sums.az[k];
                             });
        HostExec().fence();
        now.n = n;
        now.acceleration = std::move(a);
        now.potential = std::move(p);
        now.report = std::move(report);
    }
};

ListSums::ListSums() : impl_(std::make_unique<Impl>()) {}
ListSums::~ListSums() = default;
ListSums::ListSums(ListSums&&) noexcept = default;
ListSums& ListSums::operator=(ListSums&&) noexcept = default;

void ListSums::evaluate(const FMMTraversalInfo& lists, const ListMasses& masses,
                        const ListSumOptions& options) {
    check_options(options);
    check_lists(lists);
    check_tree(lists.tree());
    run_kernels("list sums", [&] {
        /// The tree is the host's, who may want its arrays for the next one.
        struct Release {
            ListOperators& operators;
            ~Release() { operators.release_tree(); }
        } release{impl_->operators};
        Report report;
        const Stopwatch watch;
        impl_->operators.prepare(lists.tree(), masses, options);
        report.entry("sort").ms = watch.ms();
        impl_->evaluation.run(lists, impl_->operators, report);
        impl_->hand_over(lists.tree(), options.constant, std::move(report));
    });
}

Offset ListSums::n() const { return impl_->now.n; }
ConstView<double> ListSums::acceleration() const {
    return cut(impl_->now.acceleration, 3 * impl_->now.n);
}
ConstView<double> ListSums::potential() const { return cut(impl_->now.potential, impl_->now.n); }
const Report& ListSums::report() const { return impl_->now.report; }
Offset ListSums::scratch_bytes() const {
    return impl_->operators.bytes() + impl_->evaluation.bytes();
}
void ListSums::release_scratch() {
    impl_->operators = {};
    impl_->evaluation = {};
}

}  // namespace connectivity
