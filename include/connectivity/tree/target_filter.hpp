// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Some of the targets of a tree, found by box.
///
/// flags [n_targets], user order, host: not 0 keeps a target. Cost: a pass over targets and boxes.

#include <span>

#include <connectivity/base/csr.hpp>
#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// Row b [n_boxes]: user indices of the flagged own targets of box b, in tree order. Throws
/// Error{argument} for another number of flags, {memory}.
Csr filter_targets_user_order(const TreeView& tree, std::span<const std::int8_t> flags);

/// The flagged targets, renumbered without gaps in tree order.
struct FilteredTargets {
    Offset n = 0;
    View<std::int32_t> box_starts, box_counts_nonchild;  ///< [n_boxes], as in TreeParticles
    View<std::int32_t> unfiltered_from_filtered;         ///< [n]: tree index of each
};

/// Throws as filter_targets_user_order.
FilteredTargets filter_targets_tree_order(const TreeView& tree, std::span<const std::int8_t> flags);

}  // namespace connectivity
