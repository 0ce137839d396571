// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Dropping the ghosts that no internal node interacts with.

#include <vector>

#include <connectivity/io/snapshot.hpp>
#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::program {

/// What became of every slot: its new one, -1 where it was dropped.
using NewSlots = std::vector<Slot>;

/// Patches the map and compacts the lists. Needs rows. Cost: one pass over the rows, and a patch.
NewSlots cull_ghosts(ConnectivityMap& map, std::vector<ListData>& lists);

}  // namespace connectivity::program
