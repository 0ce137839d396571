// SPDX-License-Identifier: BSD-3-Clause
#include "drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "append.hpp"
#include "support.hpp"

namespace connectivity {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

ConstView<double> support_of(const NodeList& list) {
    return list.has_tensor() ? list.H() : list.h();
}

/// What one pass finds; infinite where a value is bad.
struct Extremes {
    double step2 = 0;  ///< largest squared displacement; not 0 if any node moved
    double far = 0;    ///< largest |coordinate|, old or new, on periodic axes
    double growth = 0;
};

/// One list, now and when it was kept.
template <int Dim>
struct ListDrift {
    const double *x, *kept_x, *support, *kept_support;
    bool has_tensor;
    double extent;
    Periods<Dim> periods;

    void add_step(Offset node, Extremes& e) const {
        double sum = 0;
        bool moved = false;
        for (int d = 0; d < Dim; ++d) {
            const double now = x[node * Dim + d], before = kept_x[node * Dim + d];
            const double step = periods.wrap(now - before, d);
            sum += step * step;
            moved = moved || now != before;
            if (periods.length[d] > 0) e.far = std::max({e.far, std::abs(now), std::abs(before)});
        }
        if (!std::isfinite(sum)) sum = infinity;
        if (moved) e.step2 = std::max({e.step2, sum, std::numeric_limits<double>::min()});
    }

    void add_growth(Offset node, Extremes& e) const {
        double growth = 0;
        if (has_tensor) {
            constexpr int size = n_symmetric(Dim);
            growth = extent * tensor_growth<Dim>(kept_support + node * size, support + node * size);
        } else {
            const double h = support[node];
            growth = h >= 0 ? extent * (h - kept_support[node]) : infinity;
        }
        e.growth = std::max(e.growth, growth <= infinity ? growth : infinity);  // NaN is not
    }

    /// Found over nodes [0, n), joined to what is known.
    Extremes over(Offset n, const Extremes& known) const {
        Extremes found;
        const ListDrift list = *this;
        Kokkos::parallel_reduce(
            "map/drift", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
            [=](const Offset node, double& step2, double& far, double& growth) {
                Extremes e{step2, far, growth};
                list.add_step(node, e);
                list.add_growth(node, e);
                step2 = e.step2, far = e.far, growth = e.growth;
            },
            Kokkos::Max<double>(found.step2), Kokkos::Max<double>(found.far),
            Kokkos::Max<double>(found.growth));
        return {std::max(found.step2, known.step2), std::max(found.far, known.far),
                std::max(found.growth, known.growth)};
    }
};

/// The storage to fill: the old one if it has room, else `next`. Nobody else holds either.
void take_room(const View<double>& held, View<double>& next, const char* label, Offset n) {
    const auto capacity = static_cast<Offset>(held.size());
    next = {};
    if (n > capacity) next = allocate<double>(label, capacity > 0 ? n + n / 4 : n);
}

}  // namespace

void DriftReference::reserve(std::span<const NodeList> lists) {
    next_shapes_.clear();
    Offset n_positions = 0, n_supports = 0;
    for (const NodeList& list : lists) {
        next_shapes_.push_back(shape_of(list));
        n_positions += static_cast<Offset>(list.positions().size());
        n_supports += static_cast<Offset>(support_of(list).size());
    }
    take_room(positions_, next_positions_, "map/skin/positions", n_positions);
    take_room(supports_, next_supports_, "map/skin/supports", n_supports);
}

void DriftReference::keep(std::span<const NodeList> lists, const Domain& domain) {
    if (next_positions_.size() > 0) positions_ = std::exchange(next_positions_, {});
    if (next_supports_.size() > 0) supports_ = std::exchange(next_supports_, {});
    shapes_.swap(next_shapes_);
    domain_ = domain;
    Offset position = 0, support = 0;
    for (const NodeList& list : lists) {
        position = append(positions_, position, list.positions());
        support = append(supports_, support, support_of(list));
    }
    HostExec().fence();
}

bool DriftReference::has_shape_of(std::span<const NodeList> lists) const {
    return std::equal(lists.begin(), lists.end(), shapes_.begin(), shapes_.end(),
                      [](const NodeList& l, const Shape& s) { return shape_of(l) == s; });
}

double DriftReference::drift(std::span<const NodeList> lists) const {
    if (lists.empty() || !has_shape_of(lists)) return infinity;
    switch (lists[0].dim()) {
        case 1: return drift_in<1>(lists);
        case 2: return drift_in<2>(lists);
        default: return drift_in<3>(lists);
    }
}

template <int Dim>
double DriftReference::drift_in(std::span<const NodeList> lists) const {
    double extent = 0;
    for (const NodeList& list : lists) extent = std::max(extent, list.kernel_extent());
    Extremes e;
    Offset position = 0, support = 0;
    for (const NodeList& list : lists) {
        const ListDrift<Dim> pass{list.positions().data(), positions_.data() + position,
                                  support_of(list).data(), supports_.data() + support,
                                  list.has_tensor(),       extent,
                                  periods<Dim>(domain_)};
        e = pass.over(list.n(), e);
        position += static_cast<Offset>(list.positions().size());
        support += static_cast<Offset>(support_of(list).size());
    }
    double largest_box = 0;
    for (int d = 0; d < Dim; ++d) largest_box = std::max(largest_box, domain_.length(d));
    // Four wrapped differences (the pair then and now, two steps), each wrong by at most
    // 8 epsilon (far + box) along each of at most three axes.
    const double wrapping =
        e.step2 > 0 ? 64 * std::numeric_limits<double>::epsilon() * (e.far + largest_box) : 0;
    return 2 * std::sqrt(e.step2) + e.growth + wrapping;
}

}  // namespace connectivity
