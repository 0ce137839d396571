// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a first build holds when it is done, from the sizes of its lists.
///
/// Invariant: without overlap and intersections never less than the report of that build adds up
/// to, so whoever keeps more storage for a later build adds it here. Cost: none.

#include <span>

#include <connectivity/map/map_options.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity {

struct ListSizes {
    Offset entries = 0;  ///< of all rows
    Offset pairs = 0;
};

struct BuildSizes {
    ListSizes kept;           ///< of the lists
    ListSizes found;          ///< with the pairs that are left out afterwards
    Offset later_halves = 0;  ///< found pairs whose first node has no row: stored beside the rows
    Offset nodes = 0, order = 0, scratch = 0;  ///< bytes that a traversal of these nodes held
};

/// Of rows, pairs and orders, without spare memory.
Offset list_bytes(const BuildSizes& sizes, const MapOptions& options, const SlotLayout& layout);

/// Of everything else, at most: copies of nodes, their order, scratch memory, lists from which
/// others were made. Without overlap and intersections and what they are made from.
Offset spare_bytes(const BuildSizes& sizes, std::span<const NodeList> lists,
                   const MapOptions& options, const SlotLayout& layout);

}  // namespace connectivity
