// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Writer of the node file, the HDF5 form in which node lists are exchanged. `open_snapshot` reads
/// it.
///
///     /                    attrs: dim, kernel_extent (scalar or [n_lists]), optional periodic,
///     box_lo, box_hi [dim] /node_lists/<name>/  attrs: n_internal, order; datasets: positions [n,
///     dim], H [n, dim(dim+1)/2] or h [n],
///                          optional global_id, mass, softening [n]

#include <span>
#include <string>

#include <connectivity/io/snapshot.hpp>

namespace connectivity {

/// Writes the lists in the order given; `command` says what made them (may be empty). Atomic:
/// `path` appears whole or not at all. Throws Error: argument (no list, dimensions differ, a field
/// has the wrong length), file.
void write_node_file(const std::string& path, std::span<const ListData> lists, const Domain& domain,
                     const std::string& command);

}  // namespace connectivity
