// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The cells of a box tree that carry expansions: leaves, and boxes with two children or more.
/// Chains of boxes with one child, which tight clusters hang on, are left out.
///
/// Invariants: breadth first, so children have higher numbers and are consecutive; the particles of
/// a cell are the range [first, first + count) in tree order; the centre is that of |mass| (where
/// that is 0: of the particles), radius is the largest distance of a particle from it. The same
/// bits for any number of threads. Cost: O(boxes) + O(particles) a level.

#include <connectivity/tree/tree_view.hpp>

#include "expansion_kernels.hpp"

namespace connectivity::detail {

using CellId = std::int32_t;

struct Cells {
    CellId n = 0;
    int n_levels = 0;
    View<CellId> level_starts;  ///< [n_levels + 1]; level: ancestors among cells
    View<CellId> parent, first_child, n_children;
    View<std::int32_t> first, count;
    View<double> centre;         ///< [3][n]
    View<double> radius, scale;  ///< scale: a power of two >= radius, of expansions
    View<double> mass;           ///< of |mass|
    bool softened = false;
    View<double> max_softening;  ///< [n] where softened
    View<CellId> leaves;         ///< [n_leaves], ascending
    CellId n_leaves = 0;

    int order = 0;
    std::int64_t stride = 0;  ///< doubles of one expansion, padded
    View<double> moments;     ///< [n][stride]
    View<double> rho;         ///< [n] radius of the moment of |m| of degree `degree`
    int degree = 0;

    bool is_leaf(CellId c) const { return n_children(c) == 0; }
    double x(int axis, CellId c) const { return centre(Offset{axis} * n + c); }
    /// Squared distance of the centres of a and of b moved by shift[3].
    double distance2(CellId a, CellId b, const double* shift) const {
        double d2 = 0;
        for (int d = 0; d < 3; ++d) {
            const double difference = x(d, a) - (x(d, b) + shift[d]);
            d2 += difference * difference;
        }
        return d2;
    }
    CellArrays arrays() const;  ///< with the moments
    Expansion expansion(CellId c, double* coefficients) const {
        return {{x(0, c), x(1, c), x(2, c)}, scale(c), coefficients + c * stride};
    }
    Offset bytes() const;
};

/// What a tree's particles are, in tree order; pointers valid as long as the arrays behind them.
struct TreeBodies {
    Offset n = 0;
    const double* x[3] = {};
    const double* mass = nullptr;
    const double* softening = nullptr;  ///< null: none
};

/// Cells of the tree, without moments. Throws Error{memory}.
void make_cells(const TreeView& tree, const TreeBodies& bodies, Cells& cells);

/// Moments of all cells to `order`. Throws Error{memory}.
void make_moments(const TreeBodies& bodies, int order, Cells& cells);

/// rho of all cells: the q-th root of sum |m| r^q / sum |m|, for q = degree; of large cells a bound
/// of it by Minkowski's inequality. Throws Error{memory}.
void make_rho(const TreeBodies& bodies, int degree, Cells& cells);

}  // namespace connectivity::detail
