// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The one predicate: who sees whom.
///
/// Scalar h:  i sees j  iff  r² ≤ (K h_i)², each product rounded once.
/// Tensor H:  i sees j  iff  |H_i r|² ≤ K².
/// Closed ball, no square root; h = 0 sees nobody, not even a coincident node. Periodic axes:
/// difference first, then wrapped. Every step is odd or even in the difference, so `significant` is
/// symmetric bit for bit. The whole library is compiled without contraction of products and sums,
/// hence all paths agree. Source: the definition in Spheral's design, with the maximum kernel
/// extent K over all node lists.

#include <connectivity/base/box.hpp>
#include <connectivity/base/spaces.hpp>

namespace connectivity {

enum class SearchMode {
    gather,         ///< i sees j
    scatter,        ///< j sees i
    gather_scatter  ///< either: symmetric, the only mode that has pairs
};

/// All nodes laid end to end by slot, as the search reads them. Nothing is owned but references to
/// Views.
template <int Dim>
struct SearchNodes {
    Offset n = 0;
    ConstView<double> positions;  ///< [n * Dim], interleaved
    /// [n]: (K h)² for scalar h; for a tensor the squared radius of a ball that holds its
    /// ellipsoid; -1 for a node that sees nobody.
    ConstView<double> reach2;
    /// [n * n_symmetric(Dim)] packed H, empty if no list has tensors; a node with scalar h has H_xx
    /// = 0.
    ConstView<double> H;
    double extent2 = 0;  ///< K²
    Periods<Dim> periods{};
};

/// The predicate on raw pointers, for kernels in any memory space.
template <int Dim>
struct Significance {
    static constexpr int n_H = n_symmetric(Dim);  // a constant, since kernels cannot call it
    const double* positions;
    const double* reach2;
    const double* H;  ///< nullptr if all nodes are scalar
    double extent2;
    Periods<Dim> periods;

    /// Nearest-image difference x_i - x_j.
    KOKKOS_INLINE_FUNCTION void difference(Offset i, Offset j, double (&r)[Dim]) const {
        for (int d = 0; d < Dim; ++d) {
            r[d] = positions[i * Dim + d] - positions[j * Dim + d];
            if (periods.any) r[d] = periods.wrap(r[d], d);
        }
    }

    KOKKOS_INLINE_FUNCTION static double squared(const double (&r)[Dim]) {
        double sum = r[0] * r[0];
        for (int d = 1; d < Dim; ++d) sum += r[d] * r[d];
        return sum;
    }

    /// |H_i r|², components of H·r summed in the order of the axes.
    KOKKOS_INLINE_FUNCTION double eta2(Offset i, const double (&r)[Dim]) const {
        const double* h = H + i * n_H;
        double e[Dim];
        if constexpr (Dim == 1) {
            e[0] = h[0] * r[0];
        } else if constexpr (Dim == 2) {
            e[0] = h[0] * r[0] + h[1] * r[1];
            e[1] = h[1] * r[0] + h[2] * r[1];
        } else {
            e[0] = h[0] * r[0] + h[1] * r[1] + h[2] * r[2];
            e[1] = h[1] * r[0] + h[3] * r[1] + h[4] * r[2];
            e[2] = h[2] * r[0] + h[4] * r[1] + h[5] * r[2];
        }
        return squared(e);
    }

    KOKKOS_INLINE_FUNCTION bool is_tensor(Offset i) const {
        return H != nullptr && H[i * n_H] != 0.0;
    }

    /// Does i see a point at difference r, |r|² = r2?
    KOKKOS_INLINE_FUNCTION bool sees(Offset i, const double (&r)[Dim], double r2) const {
        return is_tensor(i) ? eta2(i, r) <= extent2 : r2 <= reach2[i];
    }

    KOKKOS_INLINE_FUNCTION bool operator()(Offset i, Offset j, SearchMode mode) const {
        double r[Dim];
        difference(i, j, r);
        const double r2 = squared(r);
        return (mode != SearchMode::scatter && sees(i, r, r2)) ||
               (mode != SearchMode::gather && sees(j, r, r2));
    }
};

template <int Dim>
Significance<Dim> significance(const SearchNodes<Dim>& nodes) {
    return {nodes.positions.data(), nodes.reach2.data(),
            nodes.H.size() > 0 ? nodes.H.data() : nullptr, nodes.extent2, nodes.periods};
}

}  // namespace connectivity
