// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Gives the boxes of a grown tree their ids, level by level, without those that hold nothing.

#include "raw_boxes.hpp"
#include "tree_arrays.hpp"

namespace connectivity::tree_detail {

struct BoxNumbers {
    std::vector<std::vector<BoxId>> ids;  ///< by level and index; -1: pruned
    std::vector<BoxId> level_starts;      ///< [n_levels + 1]; levels without boxes are dropped
};

/// The root is never pruned. Throws Error{too_many}.
BoxNumbers number_boxes(const RawTree& raw, bool skip_prune);

/// Fills parents, children, centres, levels and flags (of children alone) of the arrays taken.
void fill_boxes(const RawTree& raw, const BoxNumbers& numbers, TreeArrays& arrays);

}  // namespace connectivity::tree_detail
