// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a particle code does in a step: rebuild the pairs, then one loop over them that sums the
/// density of every node (cubic spline, support R, mass 1).

#include "contestants.hpp"

namespace connectivity::bench {

/// Variants `step`, nodes in the caller's shuffled order, and `reordered`, nodes laid once in the
/// library's spatial order. agrees() compares densities.
std::unique_ptr<Contestant> make_host_step(const Input& input, bool reordered);

}  // namespace connectivity::bench
