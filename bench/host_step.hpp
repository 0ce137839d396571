// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a particle code does in a step: rebuild the pairs, then one loop over them that sums the
/// density of every node (cubic spline, support R, mass 1).

#include "contestants.hpp"

namespace connectivity::bench {

/// Variants `step`, nodes in the caller's shuffled order; `reordered`, nodes laid once in the
/// library's spatial order; and `skin<s>`, a walk: 100 steps with a skin of s mean supports, each
/// of which rebuilds only if it must. agrees() compares densities.
std::unique_ptr<Contestant> make_host_step(const Input& input, const std::string& variant);

bool is_host_step(const std::string& variant);  ///< one of these
bool is_walk(const std::string& variant);

}  // namespace connectivity::bench
