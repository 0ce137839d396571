// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// SPH density from the rows of a map: rho_i = sum over j of the same list with r < R_i of m_j W(r,
/// R_i), i itself and ghosts included, W the cubic spline that ends at R_i.
///
/// R_i = K·h_i with the list's own kernel extent K, so the density of a list does not depend on
/// which other lists take part. Rows are gather-scatter: those who only see i are filtered out.
/// Summed in ascending order: the same bits for any number of threads. Cost: one pass over the rows
/// of the list.

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::program {

/// Density of all nodes of list number `list`, [n]; mass is [n]. A node with h = 0 has density 0.
/// Ghosts without a stored row get one in a search of their own. Throws Error: argument (tensors,
/// wrong length of mass), memory, budget.
ConstView<double> density(const ConnectivityMap& map, int list, const NodeList& nodes,
                          const ConstView<double>& mass);

}  // namespace connectivity::program
