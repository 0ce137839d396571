// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Answers that do not come from the library: pair counts by brute force or by a peer, and the
/// neighbours of single nodes by the definition.

#include "contestants.hpp"

namespace connectivity::bench {

/// Number of unique pairs in each state of the input, -1 where nobody but us can tell: by brute
/// force up to 20000 nodes, beyond by the first exact peer, none of which has tensors. `tensor`: by
/// the input's H.
std::vector<Offset> reference_pairs(const Input& input, bool tensor);

/// Neighbours of a node, ascending, from the definition. Cost: one distance a node.
std::vector<Offset> neighbours_of(const Input& input, bool tensor, int state, Offset node);

}  // namespace connectivity::bench
