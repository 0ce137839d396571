// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The tree while it grows: boxes level by level, without ids, and the order of their particles.
///
/// Invariants: a box's particles are a slice of `order`, its own first, then those of its children
/// by child number; inside a box they are in the host's order. A split box has all 2^dim children
/// if `keep_empty`, else those with particles; children lie side by side in the level below.

#include <bit>
#include <cstdint>
#include <vector>

#include <connectivity/base/spaces.hpp>

namespace connectivity::tree_detail {

struct RawBox {
    std::int32_t start = 0, count = 0;  ///< its slice of `order`
    std::int32_t n_own = 0;             ///< particles that stay in it; all of a leaf's
    std::int32_t parent = 0;            ///< index in the level above
    std::int32_t first_child = -1;      ///< index in the level below; -1: never split
    std::uint8_t children = 0;          ///< bit k: child k is there
    std::uint8_t number = 0;            ///< which child of its parent it is

    bool is_split() const { return first_child >= 0; }
    /// Index of a child that is there, in the level below.
    std::int32_t child(int k) const {
        return first_child + std::popcount(children & ((1u << k) - 1u));
    }
};

using RawLevel = std::vector<RawBox>;

struct RawTree {
    std::vector<RawLevel> levels;  ///< the root first
    View<std::int32_t> order;      ///< [n] sources, then targets, in tree order

    Offset n_boxes() const {
        Offset n = 0;
        for (const RawLevel& level : levels) n += static_cast<Offset>(level.size());
        return n;
    }
};

}  // namespace connectivity::tree_detail
