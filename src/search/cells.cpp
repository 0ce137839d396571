// SPDX-License-Identifier: BSD-3-Clause
#include "cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace connectivity::detail {

namespace {

struct Extremes {
    double lo, hi, magnitude;
};

template <int Dim>
Extremes extremes_along(const SearchNodes<Dim>& nodes, int d) {
    const double* const x = nodes.positions.data();
    Kokkos::MinMaxScalar<double> range{};
    Kokkos::parallel_reduce(
        "search/cells/extremes",
        Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, nodes.n),
        [=](const Offset i, Kokkos::MinMaxScalar<double>& r) {
            r.min_val = std::min(r.min_val, x[i * Dim + d]);
            r.max_val = std::max(r.max_val, x[i * Dim + d]);
        },
        Kokkos::MinMax<double>(range));
    return {range.min_val, range.max_val,
            std::max(std::fabs(range.min_val), std::fabs(range.max_val))};
}

double largest_reach(const ConstView<double>& reach2) {
    double largest = 0;
    Kokkos::parallel_reduce(
        "search/cells/largest_reach", Kokkos::RangePolicy<HostExec>(0, reach2.size()),
        [=](const std::size_t i, double& m) { m = std::max(m, reach2(i)); },
        Kokkos::Max<double>(largest));
    return std::sqrt(std::max(0.0, largest));
}

}  // namespace

template <int Dim>
Cells<Dim>::Cells(const SearchNodes<Dim>& nodes) : positions_(nodes.positions.data()) {
    // A cell is wider than the reach by more than rounding can move a node, and no axis has more
    // than 2^30 cells.
    width_ = largest_reach(nodes.reach2) * (1 + 1e-6);
    Extremes box[Dim];
    for (int d = 0; d < Dim && nodes.n > 0; ++d) {
        box[d] = extremes_along(nodes, d);
        const bool wraps = nodes.periods.length[d] > 0;
        width_ = std::max(width_, wraps ? box[d].magnitude * 0x1p-29
                                        : (0.5 * box[d].hi - 0.5 * box[d].lo) * 0x1p-28);
    }
    width_ = std::max(width_, 0x1p-500);  // below it r² is subnormal and loses its digits
    for (int d = 0; d < Dim && nodes.n > 0; ++d) {
        period_[d] = nodes.periods.length[d];
        origin_[d] = box[d].lo;
        count_[d] =
            period_[d] > 0 ? static_cast<Index>(std::clamp(period_[d] / width_, 1.0, 0x1p30)) : 0;
    }
    fill(nodes.n);
}

template <int Dim>
typename Cells<Dim>::Index Cells<Dim>::index(double x, int d) const {
    if (period_[d] > 0) {
        const double turns = (x - origin_[d]) / period_[d], part = turns - std::floor(turns);
        return std::min(static_cast<Index>(part * count_[d]), count_[d] - 1);
    }
    const double at = (x - origin_[d]) / width_;
    return at > 0 ? static_cast<Index>(std::min(at, 0x1p30)) : 0;  // also for the NaN of inf/inf
}

template <int Dim>
int Cells<Dim>::neighbours_along(Index at, int d, Index (&out)[3]) const {
    if (period_[d] > 0 && count_[d] <= 3) {
        for (Index c = 0; c < count_[d]; ++c) out[c] = c;
        return count_[d];
    }
    for (Index k = 0; k < 3; ++k) out[k] = at + k - 1;
    if (period_[d] > 0) {
        if (at == 0) out[0] = count_[d] - 1;
        if (at == count_[d] - 1) out[2] = 0;
    }
    return 3;
}

template <int Dim>
void Cells<Dim>::fill(Offset n) {
    Offset buckets = 1;
    while (buckets < n) buckets *= 2;
    mask_ = static_cast<std::uint64_t>(buckets) - 1;
    start_ = allocate_zeroed<Offset>("search/cells/start", buckets + 1);
    slot_ = allocate<Slot>("search/cells/slot", n);
    cell_ = allocate<Cell>("search/cells/cell", n);
    const Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>> all(0, n);
    const auto start = start_;
    Kokkos::parallel_for("search/cells/count", all, [this, start](const Offset i) {
        Kokkos::atomic_add(&start(static_cast<Offset>(hash(cell(i)) & mask_)), Offset{1});
    });
    Kokkos::parallel_scan("search/cells/scan",
                          Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, buckets + 1),
                          [=](const Offset b, Offset& sum, const bool final) {
                              const Offset length = start(b);
                              sum += length;
                              if (final)
                                  start(b) =
                                      sum;  // the end of the bucket; filling moves it to the start
                          });
    Kokkos::parallel_for("search/cells/fill", all, [this, start](const Offset i) {
        const Cell c = cell(i);
        const Offset at =
            Kokkos::atomic_fetch_add(&start(static_cast<Offset>(hash(c) & mask_)), Offset{-1}) - 1;
        slot_(at) = static_cast<Slot>(i);
        cell_(at) = c;
    });
    HostExec().fence();
}

template class Cells<1>;
template class Cells<2>;
template class Cells<3>;

}  // namespace connectivity::detail
