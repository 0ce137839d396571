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
    /// bytes, and at most about what the search holds beside them: nodes and their order, a record
    /// of every slot, scratch of the workers, and each found row until all are counted, in memory
    /// that grows by doubling for each worker and may be two thirds empty.
    Offset peak_bytes = 0;
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
