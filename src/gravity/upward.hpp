// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Loops over the cells of a tree, level by level.

#include <connectivity/base/parallel.hpp>

#include "cells.hpp"

namespace connectivity::detail {

/// Above it a cell is measured by its children, which bounds its radii and needs no particles.
constexpr std::int32_t few_particles = 1 << 12;

/// body(cell), children before their parents. `body` must not throw.
template <class Body>
void for_each_upward(const char* label, const Cells& cells, const Body& body) {
    for (int level = cells.n_levels - 1; level >= 0; --level) {
        const CellId first = cells.level_starts(level);
        for_each_dynamic(label, cells.level_starts(level + 1) - first,
                         [&](int, Offset k) { body(static_cast<CellId>(first + k)); });
    }
}

}  // namespace connectivity::detail
