// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The order of nodes that the group search works in: support classes, kd-tree blocks, leaves
/// of 16.
///
/// Invariants: every slot has exactly one position; blocks begin at a leaf; unused places of a
/// block's last leaf have slot -1; block b of a class is leaf b of its kd-tree. A class holds
/// supports within a factor of four, so that a few large supports do not widen the boxes of the
/// small ones; nodes that see nobody have a class of their own. The order is only a matter of
/// speed: any permutation gives the same rows. Cost: O(N log N) once; kept from build to build
/// while nodes move little.

#include <vector>

#include <connectivity/search/predicate.hpp>

#include "kernels.hpp"

namespace connectivity::detail {

constexpr Offset block_size = 512;  ///< nodes a block on average at most

/// The kd-tree over the blocks of one class, in heap order: root at node 1, block b at node
/// n_blocks + b.
struct ClassTree {
    Offset n_blocks;  ///< a power of two
    Offset first_block;
    Offset first_node;  ///< in the array of node boxes, which has 2 * n_blocks entries a class
};

struct GroupOrder {
    Offset n = 0;                    ///< slots ordered
    std::vector<ClassTree> trees;    ///< largest supports first
    std::vector<Offset> block_leaf;  ///< [n_blocks + 1]: leaves of block b
    View<Slot> slot;  ///< [n_leaves * 16]: slot of a position, -1 where there is none
    Offset n_tree_nodes = 0;

    Offset n_blocks() const { return static_cast<Offset>(block_leaf.size()) - 1; }
    Offset n_leaves() const { return block_leaf.empty() ? 0 : block_leaf.back(); }
    Offset bytes() const;
};

/// Throws Error{memory}.
template <int Dim>
GroupOrder order_groups(const SearchNodes<Dim>& nodes);

/// Coordinate as the group search uses it: moved into [0, L) on a periodic axis.
template <int Dim>
inline double folded(const SearchNodes<Dim>& nodes, Offset slot, int d) {
    const double x = nodes.positions.data()[slot * Dim + d], length = nodes.periods.length[d];
    if (!(length > 0)) return x;
    const double y = x - length * std::floor(x / length);
    return y >= 0 && y < length ? y : 0.0;
}

}  // namespace connectivity::detail
