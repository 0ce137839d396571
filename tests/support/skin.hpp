// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Maps with a skin: whether their lists are complete for nodes that have moved since.

#include <support/case.hpp>

namespace connectivity::test {

/// Rebuilds the map from the case, supports widened by the skin.
void build(ConnectivityMap& map, const Case& c, double skin,
           SearchMethod method = SearchMethod::automatic);

/// Number of neighbours and pairs of a state, by brute force, that the map does not list.
int missing(const ConnectivityMap& map, const Case& now);

/// The farthest point of a path at which the map still says that its lists are good, or -1.
template <class Path>
double last_good(ConnectivityMap& map, const Path& path) {
    const auto good = [&](double t) {
        const Case c = path.at(t);
        return !map.needs_rebuild(node_lists(c));
    };
    if (good(1)) return 1;
    double lo = 0, hi = 1;
    for (int k = 0; k < 56; ++k) (good(0.5 * (lo + hi)) ? lo : hi) = 0.5 * (lo + hi);
    return lo > 0 ? lo : -1;
}

}  // namespace connectivity::test
