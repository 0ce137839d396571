// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Neighbour counts of the internal nodes of a list, and how far two densities are apart.

#include <vector>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::program {

/// Distribution of a count over nodes; `histogram[c]` nodes have c neighbours.
struct CountStatistics {
    std::vector<Offset> histogram;
    Offset n = 0;  ///< nodes
    double mean = 0;

    Offset min() const;
    Offset max() const { return n > 0 ? static_cast<Offset>(histogram.size()) - 1 : 0; }
    Offset isolated() const { return n > 0 ? histogram[0] : 0; }
    /// Smallest count that at least `percent` of the nodes do not exceed (nearest rank).
    Offset percentile(double percent) const;
};

/// Neighbours in all lists of the internal nodes of one list. Cost: one pass over the rows'
/// offsets.
CountStatistics neighbour_statistics(const ConnectivityMap& map, int list, Offset n_internal);

/// Relative differences |a - b| / |b| over nodes with b != 0.
struct Difference {
    double rms = 0, max = 0;
    Offset n = 0;
};
Difference relative_difference(const ConstView<double>& a, const ConstView<double>& b);

}  // namespace connectivity::program
