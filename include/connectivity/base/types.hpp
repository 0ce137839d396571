// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Integer types by meaning, and the number of components of a symmetric tensor.

#include <cstdint>
#include <limits>

namespace connectivity {

/// Position of a node in all node lists laid end to end: list_offset[list] + node.
using Slot = std::int32_t;

/// Counts and positions inside CSR arrays; always 64 bits.
using Offset = std::int64_t;

/// Counter that changes with every rebuild or patch of a map.
using Generation = std::uint64_t;

constexpr Offset max_slots = std::numeric_limits<Slot>::max();

/// Components of a packed symmetric tensor: xx | xx,xy,yy | xx,xy,xz,yy,yz,zz.
constexpr int n_symmetric(int dim) { return dim * (dim + 1) / 2; }

}  // namespace connectivity
