// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Boxes and their gaps, for kernels.
///
/// Invariants: boxes hold folded positions exactly, and rounding is monotone, so on open axes the
/// computed gap of two boxes never exceeds the computed distance of two of their nodes. On periodic
/// axes the gap is the least over the image itself and its two neighbours: folded positions lie in
/// [0, L), so no other is nearer. Folding, shifting and the wrapped difference of the predicate
/// round by less than `slack` together, 16 units in the last place of the largest coordinate or
/// period.

#include <cmath>
#include <limits>

#include <connectivity/search/predicate.hpp>

namespace connectivity::detail::device {

constexpr double infinity = std::numeric_limits<double>::infinity();  // kernels cannot call it

KOKKOS_INLINE_FUNCTION double larger(double a, double b) { return a < b ? b : a; }
KOKKOS_INLINE_FUNCTION double smaller(double a, double b) { return b < a ? b : a; }

/// A box and the largest squared reach of the nodes in it. Empty: inverted, reach2 = -1.
template <int Dim>
struct Box {
    double lo[Dim], hi[Dim], reach2;

    KOKKOS_INLINE_FUNCTION void clear() {
        for (int d = 0; d < Dim; ++d) lo[d] = infinity, hi[d] = -infinity;
        reach2 = -1;
    }
    KOKKOS_INLINE_FUNCTION void add(const Box& b) {
        for (int d = 0; d < Dim; ++d)
            lo[d] = smaller(lo[d], b.lo[d]), hi[d] = larger(hi[d], b.hi[d]);
        reach2 = larger(reach2, b.reach2);
    }
    /// The box of one node, whose coordinates are `stride` apart.
    KOKKOS_INLINE_FUNCTION void set(const double* x, Offset stride, double r2) {
        for (int d = 0; d < Dim; ++d) lo[d] = hi[d] = x[d * stride];
        reach2 = r2;
    }
};

/// Coordinate moved into [0, L).
KOKKOS_INLINE_FUNCTION double fold(double x, double length) {
    if (!(length > 0)) return x;
    const double y = x - length * std::floor(x / length);
    return y >= 0 && y < length ? y : 0.0;
}

/// Which nodes may be neighbours of nodes in a box.
template <int Dim>
struct Nearness {
    Periods<Dim> periods;
    double slack;
    bool own, other;  ///< whose reach counts: all but one in gather and in scatter mode

    /// May a node of b be a neighbour of a node of a? The sum runs over the axes in the order of
    /// the predicate.
    KOKKOS_INLINE_FUNCTION bool operator()(const Box<Dim>& a, const Box<Dim>& b) const {
        double sum = 0;
        for (int d = 0; d < Dim; ++d) {
            const double g = larger(gap(a, b, d) - slack, 0.0);
            sum += g * g;
        }
        return sum <= larger(own ? a.reach2 : -1, other ? b.reach2 : -1);
    }

private:
    KOKKOS_INLINE_FUNCTION double gap(const Box<Dim>& a, const Box<Dim>& b, int d) const {
        const double g = larger(b.lo[d] - a.hi[d], a.lo[d] - b.hi[d]), length = periods.length[d];
        if (!(length > 0)) return g;
        const double above = larger(b.lo[d] + length - a.hi[d], a.lo[d] - (b.hi[d] + length)),
                     below = larger(b.lo[d] - length - a.hi[d], a.lo[d] - (b.hi[d] - length));
        return smaller(g, smaller(above, below));
    }
};

}  // namespace connectivity::detail::device
