// SPDX-License-Identifier: BSD-3-Clause
#include "sort_particles.hpp"

#include <connectivity/base/parallel.hpp>

namespace connectivity::tree_detail {

namespace {

using Range = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// rank[i]: sources among the first i particles in tree order.
void rank_sources(const std::int32_t* order, Offset n, Offset n_sources, std::int32_t* rank) {
    Kokkos::parallel_scan("tree/rank", Range(0, n),
                          [=](const Offset i, std::int32_t& sum, const bool final) {
                              if (final) rank[i] = sum;
                              sum += order[i] < n_sources ? 1 : 0;
                          });
    HostExec().fence();
    rank[n] = static_cast<std::int32_t>(n_sources);
}

template <class Real, int Dim>
struct Mover {
    const Particles<Real, Dim>& particles;

    void move(Offset from, const ParticleArrays& to, Offset at, Offset n, bool radii) const {
        for (int d = 0; d < Dim; ++d) to.positions(d * n + at) = particles.position(from, d);
        if (radii) to.radii(at) = particles.radius(from);
    }
};

/// Slices of one kind of particles; first(i) is the number of them before particle i.
template <class First>
void fill_slices(const RawTree& raw, const BoxNumbers& numbers, std::uint8_t own_flag,
                 const First& first, ParticleArrays& slices, View<std::uint8_t>& flags) {
    for (std::size_t level = 0; level < numbers.ids.size(); ++level) {
        const RawBox* const boxes = raw.levels[level].data();
        const BoxId* const ids = numbers.ids[level].data();
        const auto fill = [&](Offset b) {
            if (ids[b] < 0) return;
            const RawBox& box = boxes[b];
            const std::int32_t start = first(box.start),
                               n_own = first(box.start + box.n_own) - start;
            slices.box_starts(ids[b]) = start;
            slices.box_counts_nonchild(ids[b]) = n_own;
            slices.box_counts_cumul(ids[b]) = first(box.start + box.count) - start;
            if (n_own > 0) flags(ids[b]) = flags(ids[b]) | own_flag;
        };
        for (Offset b = 0; b < static_cast<Offset>(numbers.ids[level].size()); ++b) fill(b);
    }
}

}  // namespace

template <class Real, int Dim>
void sort_particles(const Particles<Real, Dim>& particles, const RawTree& raw,
                    const BoxNumbers& numbers, std::int32_t* rank, TreeArrays& arrays) {
    const Offset n = particles.n(), n_sources = particles.n_sources();
    const std::int32_t* const order = raw.order.data();
    const Mover<Real, Dim> mover{particles};
    if (arrays.header.sources_are_targets) {
        Kokkos::parallel_for("tree/sort", Range(0, n), [&](const Offset i) {
            mover.move(order[i], arrays.sources, i, n, false);
            arrays.user_source_ids(i) = order[i];
            arrays.sorted_target_ids(order[i]) = static_cast<std::int32_t>(i);
        });
        HostExec().fence();
        fill_slices(
            raw, numbers, box_flag::has_own_sources | box_flag::has_own_targets,
            [](std::int32_t i) { return i; }, arrays.sources, arrays.flags);
        return;
    }
    rank_sources(order, n, n_sources, rank);
    Kokkos::parallel_for("tree/sort", Range(0, n), [&](const Offset i) {
        const Offset source = rank[i], target = i - source;
        if (order[i] < n_sources) {
            mover.move(order[i], arrays.sources, source, n_sources, arrays.source_radii);
            arrays.user_source_ids(source) = order[i];
        } else {
            mover.move(order[i], arrays.targets, target, n - n_sources, arrays.target_radii);
            arrays.sorted_target_ids(order[i] - n_sources) = static_cast<std::int32_t>(target);
        }
    });
    HostExec().fence();
    fill_slices(
        raw, numbers, box_flag::has_own_sources, [=](std::int32_t i) { return rank[i]; },
        arrays.sources, arrays.flags);
    fill_slices(
        raw, numbers, box_flag::has_own_targets, [=](std::int32_t i) { return i - rank[i]; },
        arrays.targets, arrays.flags);
}

#define CONNECTIVITY_INSTANTIATE(Real, Dim)                                                      \
    template void sort_particles(const Particles<Real, Dim>&, const RawTree&, const BoxNumbers&, \
                                 std::int32_t*, TreeArrays&);
CONNECTIVITY_EACH_REAL_AND_DIM(CONNECTIVITY_INSTANTIATE)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity::tree_detail
