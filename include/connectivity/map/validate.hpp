// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Every invariant of a map as a named check: for tests, for debugging a host, after a patch.
///
/// Cost: a binary search for every entry of every list, and up to 64 nodes against all others.

#include <span>
#include <string>
#include <vector>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity {

struct MapCheck {
    std::string name;  ///< the law, "rows_are_symmetric"
    bool passed;
    std::string first;  ///< the first place where it does not hold; empty if it does
};

/// All checks that apply to what the map holds. `lists` are the nodes that it was built from, or
/// what a patch left of them. Laws of geometry are checked in the modes of the last rebuild; pairs
/// that its predicate or interactions leave out are expected to be absent. What cannot be told any
/// more is not checked: after a patch whether overlap misses anybody, for witnesses may be gone;
/// after a patch with a predicate, and after remove_pairs, whether rows do. Throws Error:
/// not_built, argument (other lists), memory, and what a rebuild throws for bad nodes.
std::vector<MapCheck> validate(const ConnectivityMap& map, std::span<const NodeList> lists);

/// Did all pass? Otherwise `text`, if given, says which did not, and where.
bool all_passed(const std::vector<MapCheck>& checks, std::string* text = nullptr);

}  // namespace connectivity
