// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The parts of a tree that the lists read all the time, laid out for them, and the check that its
/// arrays do not contradict each other.
///
/// Invariant: once made, every box but the root is a child of its parent exactly once, one level
/// finer, and flags know of all particles below: walks end and miss nothing. Cost: 4 * 2^dim + 2
/// bytes a box.

#include <connectivity/tree/tree_view.hpp>

namespace connectivity::detail {

constexpr std::uint8_t source_flags = box_flag::has_own_sources | box_flag::has_child_sources;
constexpr std::uint8_t target_flags = box_flag::has_own_targets | box_flag::has_child_targets;

/// The storage of TreeTables, kept for the next build.
struct TableScratch {
    View<BoxId> children;
    View<std::uint8_t> child_mask, number;
    Offset bytes() const {
        return static_cast<Offset>(children.size() * sizeof(BoxId) + child_mask.size() +
                                   number.size());
    }
};

struct TreeTables {
    TreeView tree;
    int n_children = 0;             ///< 2^dim
    View<BoxId> children;           ///< [n_boxes][n_children]; 0: none
    View<std::uint8_t> child_mask;  ///< [n_boxes]: bit m: has child number m
    View<std::uint8_t> number;      ///< [n_boxes]: child number in the parent; 0 for the root

    /// Throws Error: argument, null, memory.
    TreeTables(const TreeView& view, TableScratch& scratch);

    Offset bytes() const {
        return tree.n_boxes * (n_children * static_cast<Offset>(sizeof(BoxId)) + 2);
    }

    std::uint8_t flags(BoxId b) const { return tree.box_flags.data()[b]; }
    BoxId child(BoxId b, int m) const { return children.data()[Offset{b} * n_children + m]; }
    unsigned mask(BoxId b) const { return child_mask.data()[b]; }
    int level(BoxId b) const { return tree.box_levels.data()[b]; }
    bool owns_sources(BoxId b) const { return flags(b) & box_flag::has_own_sources; }
    bool owns_targets(BoxId b) const { return flags(b) & box_flag::has_own_targets; }

    /// The bit of an axis in child numbers.
    int axis_bit(int axis) const { return 1 << (tree.dim - 1 - axis); }
};

}  // namespace connectivity::detail
