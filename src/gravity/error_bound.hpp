// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the neglected terms of all expansions that reach a particle can be at most.
///
/// With t = (r_A + r_B) / R and s = (r_A + rho_B) / R, rho_B of degree q = p, the terms of degree j
/// > p of the potential of B's masses have at most the gradient j M_B (r_A + r)^(j-1) / R^(j+1),
/// summed over the masses; since (r_A + r)^(j-1) <= (r_A + r)^p (r_A + r_B)^(j-1-p) and by
/// Minkowski's inequality,
///
///     |error of a| <= M_B / R² * s^p * ((p + 1) / (1 - t) + t / (1 - t)²)
///
/// For expansions at particles R is replaced by R - r_A, t = r_B / R, s = rho_B / R, p by p + 1.
/// Rounding is not in it. Cost: one term an entry of the far lists, added down the tree.

#include "cell_lists.hpp"

namespace connectivity::detail {

/// Bounds of all cells, [cells.n], each with its ancestors'. Throws Error{memory}.
void bound_errors(const Cells& cells, const CellLists& lists, const Images& images,
                  const FarChoice& choice, View<double>& bounds);

}  // namespace connectivity::detail
