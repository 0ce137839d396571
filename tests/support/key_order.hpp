// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Key order from its definition: keys bit by bit, ties by position, list and id.

#include <support/brute_force.hpp>

namespace connectivity::test {

/// What stands beside a case in key order: by list, empty where there is none.
struct NodeNames {
    std::vector<std::vector<std::int64_t>> global_id;
    std::vector<std::vector<Slot>> owner;  ///< of ghosts
};

struct ExpectedOrder {
    std::vector<Slot> slots;          ///< by rank
    std::vector<Slot> ranks;          ///< by slot
    std::vector<std::uint64_t> keys;  ///< by rank
};

ExpectedOrder key_order_of(const Case& c, const NodeNames& names = {});

/// Brute force lists of a case in which all nodes have rows, put in key order.
Expected in_key_order(const Expected& by_slot, const ExpectedOrder& order);

}  // namespace connectivity::test
