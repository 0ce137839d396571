// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a map would hold, before it is built: sizes of rows and pairs, and the memory they take.
///
/// Exact up to `exact_rows` stored nodes; beyond, the neighbours of a sample are counted, the same
/// nodes in every call. A pair counts at its end with the smaller support, where there are about as
/// many for every node: few nodes with huge supports do not spoil the sample. Cost: one order of
/// the nodes and a traversal of the sample; no list is stored.

#include <span>

#include <connectivity/map/map_options.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity {

struct MapEstimate {
    Offset n_entries = 0;  ///< of all rows; 0 if rows are not asked for
    Offset n_pairs = 0;    ///< 0 if pairs are not asked for
    /// Of rows, pairs, key order and spatial order in a new map; without overlap and intersections.
    Offset bytes = 0;
    /// At least what a new map holds after its first build, wherever the search runs on the host:
    /// bytes and three standard errors more, nodes and their order, a record of every slot, scratch
    /// of the workers, each found row in memory that grows by doubling and may be half empty, and
    /// lists from which others are made, with all pairs that `exclude` and `interactions` leave
    /// out. At most twice what is held, where the lists are most of it.
    Offset peak_bytes = 0;
    /// Overlap or intersections are asked for: they, and what they are made from, are in neither
    /// number of bytes. Their sizes would take as long to find as the lists themselves.
    bool is_lower_bound = false;
    Offset n_sampled = 0;       ///< nodes whose neighbours were counted
    double relative_error = 0;  ///< standard error of the numbers over them; 0: they are exact
};

struct EstimateLimits {
    Offset exact_rows = 20000;  ///< as many stored nodes are all counted
    Offset n_sampled = 4096;    ///< about so many of more
};

/// Throws as ConnectivityMap::rebuild does, but for the budget, which does not count here.
MapEstimate estimate(std::span<const NodeList> lists, const MapOptions& options,
                     const EstimateLimits& limits = {});

}  // namespace connectivity
