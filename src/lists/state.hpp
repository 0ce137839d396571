// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a traversal holds.
///
/// Invariant: published lists belong to `tree` and `options`; what is prepared beside them is
/// nobody's until it is published.

#include <vector>

#include <connectivity/lists/traversal.hpp>

#include "box_rows.hpp"
#include "build_scratch.hpp"

namespace connectivity::detail {

/// Boxes by level: row l holds those of level l, so that offsets are the level starts.
struct BaseLists {
    Csr sources{"lists/source_boxes"}, targets{"lists/target_boxes"},
        source_parents{"lists/source_parent_boxes"},
        target_parents{"lists/target_or_target_parent_boxes"};

    template <class F>
    void each(const F& f) {
        f(sources), f(targets), f(source_parents), f(target_parents);
    }
};

/// List 3. Rows of `indices` and `targets` are levels, those of `levels[l]` the target boxes with
/// any entry on level l.
struct SmallerLists {
    std::vector<BoxRows> levels;
    Csr indices{"lists/from_sep_smaller/nonempty_indices"},
        targets{"lists/from_sep_smaller/target_boxes"};

    template <class F>
    void each(const F& f) {
        for (BoxRows& level : levels) f(level);
        f(indices), f(targets);
    }
};

struct TraversalState {
    bool built = false;
    TreeView tree;
    TraversalOptions options;
    bool has_close = false;  ///< the tree has radii, and close lists are not merged

    BaseLists base;
    BoxRows same_level{"lists/same_level_non_well_sep_boxes"};
    BoxRows neighbors{"lists/neighbor_source_boxes"};
    BoxRows siblings{"lists/from_sep_siblings"};
    SmallerLists smaller;
    BoxRows close_smaller{"lists/from_sep_close_smaller"};
    BoxRows bigger{"lists/from_sep_bigger"};
    BoxRows close_bigger{"lists/from_sep_close_bigger"};
    Report report;
    BuildScratch scratch;

    /// f(list) for all but list 3.
    template <class F>
    void each_list(const F& f) {
        f(same_level), f(neighbors), f(siblings), f(close_smaller), f(bigger), f(close_bigger);
    }
};

}  // namespace connectivity::detail
