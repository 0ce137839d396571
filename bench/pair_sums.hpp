// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What determinism costs where values of pairs are summed at their nodes: the same stored field,
/// in the three ways of connectivity/map/pair_sum.hpp, nodes laid in the library's spatial order.

#include "contestants.hpp"

namespace connectivity::bench {

/// Variants `sumatomic`, `sumrows` and `sumcolours`. A build is one sum of one double a pair to
/// both of its nodes; lists, field and what the way needs are made by place(), which is not timed.
/// agrees() compares sums.
std::unique_ptr<Contestant> make_pair_sums(const Input& input, const std::string& variant);

bool is_pair_sum(const std::string& variant);  ///< one of these

}  // namespace connectivity::bench
