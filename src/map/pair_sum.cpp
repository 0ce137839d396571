// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/pair_sum.hpp>

namespace connectivity::detail {

void check_pair_sum(Offset n_slots, int n_components, Offset n_out) {
    if (n_out != n_slots * n_components)
        throw Error(Status::argument, "pair sum: out has " + std::to_string(n_out) +
                                          " values, must have " + std::to_string(n_components) +
                                          " for each of " + std::to_string(n_slots) + " slots");
}

void check_pair_stamp(Stamp given, Stamp pairs, const char* what) {
    if (given != pairs)
        throw Error(Status::stale, "pair sum: " + std::string(what) +
                                       " made for another pair list, or for one before a rebuild "
                                       "or patch (stamp " +
                                       std::to_string(given) + ", the list has " +
                                       std::to_string(pairs) + ")");
}

}  // namespace connectivity::detail
