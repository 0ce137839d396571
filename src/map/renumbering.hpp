// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Which nodes stay after culling, and what they are called then.
///
/// Invariant: within each list the new node ids of those that stay are 0 ... n-1, internal nodes
/// first; new_slot and old_slot undo each other.

#include <span>
#include <vector>

#include <connectivity/search/layout.hpp>

namespace connectivity {

struct Renumbering {
    SlotLayout layout;               ///< of the nodes that stay
    std::vector<Offset> n_internal;  ///< [n_lists]
    View<Slot> new_slot;             ///< [old n_slots]; -1: dropped
    View<Slot> old_slot;             ///< [new n_slots]
    bool keeps_order = true;         ///< new_slot ascends over the nodes that stay
};

struct PatchSource {
    const SlotLayout& layout;
    const std::vector<Offset>& n_internal;
    const std::vector<std::string>& names;
    bool all_rows;  ///< ghosts have rows
};

/// keep, old2new: [n_slots]; new node ids within their list, of no meaning where keep is 0. Throws
/// Error{argument} with the first bad node, Error{memory}.
Renumbering read_renumbering(const PatchSource& source, std::span<const Slot> keep,
                             std::span<const Slot> old2new);

}  // namespace connectivity
