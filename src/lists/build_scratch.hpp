// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a build of interaction lists needs besides the lists, kept by their owner for the next one.
///
/// Invariant: of no meaning between builds; copies of a traversal begin without it.

#include <vector>

#include "near_rows.hpp"

namespace connectivity::detail {

/// Boxes of a base list, ascending, and where each level begins in it.
struct BaseBoxes {
    std::vector<BoxId> boxes;
    std::vector<Offset> level_starts;
    Offset size() const { return static_cast<Offset>(boxes.size()); }
    BoxId operator[](Offset i) const { return boxes[static_cast<std::size_t>(i)]; }
    Offset n_in(Offset level) const {
        const auto l = static_cast<std::size_t>(level);
        return level_starts[l + 1] - level_starts[l];
    }
};

struct BuildScratch {
    TableScratch tables;
    NearScratch near;
    BaseBoxes sources, targets, source_parents, target_parents;
    std::vector<Offset> n_near, n_close;  ///< [targets]: entries of list 1, of 3 close
    /// [chunk][level] of list 3: how many, then where the chunk begins.
    std::vector<Offset> smaller_entries, smaller_rows;

    BuildScratch() = default;
    BuildScratch(const BuildScratch&) {}
    BuildScratch& operator=(BuildScratch&&) = default;

    Offset bytes() const {
        std::size_t bytes = 0;
        for (const BaseBoxes* base : {&sources, &targets, &source_parents, &target_parents})
            bytes += base->boxes.capacity() * sizeof(BoxId) +
                     base->level_starts.capacity() * sizeof(Offset);
        for (const auto* counts : {&n_near, &n_close, &smaller_entries, &smaller_rows})
            bytes += counts->capacity() * sizeof(Offset);
        return static_cast<Offset>(bytes) + tables.bytes() + near.bytes();
    }
};

}  // namespace connectivity::detail
