// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Local expansions: far lists by M2L, then from parents to children.
///
/// Invariants: the same bits for any number of threads. Cost: one M2L an entry of the far lists of
/// the cells asked for, one L2L a cell.

#include "cell_lists.hpp"

namespace connectivity::detail {

/// Target cells in ascending order, and where the levels of the tree begin among them; the parent
/// of each is among them.
struct CellSet {
    std::vector<CellId> ids;
    std::vector<std::size_t> level_starts;  ///< [n_levels + 1]
    std::vector<std::uint8_t> is_in;        ///< [n_cells]; empty: all are

    bool contains(CellId c) const { return is_in.empty() || is_in[c] != 0; }
    const std::uint8_t* mask() const { return is_in.empty() ? nullptr : is_in.data(); }
};

/// All cells of a tree.
void take_all(const Cells& cells, CellSet& set);
/// Those that hold one of the particles (places in tree order, ascending).
void take_paths(const Cells& cells, const std::vector<std::int32_t>& particles, CellSet& set);

/// Locals of the cells of a set, in [cells.n][cells.stride], of which nothing else is touched.
/// `unpacked` is scratch, one a worker. Throws Error{memory}.
void make_locals(const Cells& cells, const CellLists& lists, const Images& images,
                 const CellSet& set, std::vector<UnpackedList>& unpacked, View<double>& locals);

}  // namespace connectivity::detail
