// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a traversal's lists cost an FMM: operations counted box by box, for hosts that share boxes
/// out to ranks or choose the size of leaves.
///
/// Invariant: exact integers, the same for any number of threads. Work is counted at the box that
/// receives it, p2m and m2m at the box that holds the sources. Lists not asked for count 0. Cost:
/// one pass over all entries; 88 bytes a box.

#include <connectivity/lists/traversal.hpp>

namespace connectivity {

struct Work {
    Offset p2p = 0;        ///< pairs of target and source in list 1
    Offset p2p_close = 0;  ///< the same in 3 close and 4 close
    Offset m2l = 0;        ///< entries of list 2
    Offset m2p = 0;        ///< pairs of target and multipole: entries of list 3 times own targets
    Offset p2l = 0;        ///< pairs of source and local expansion: own sources in list 4
    Offset p2m = 0;        ///< own sources
    Offset l2p = 0;        ///< own targets
    Offset m2m = 0;  ///< boxes whose multipole is shifted to their parent's: those with sources
    Offset l2l = 0;  ///< boxes whose local expansion comes from their parent's: with targets
    Offset from_sep_smaller_entries = 0, from_sep_bigger_entries = 0;

    Work& operator+=(const Work& other);
    friend bool operator==(const Work&, const Work&) = default;
};

/// Seconds, or any unit, of one operation of each kind.
struct WorkWeights {
    double p2p = 1, m2l = 1, m2p = 1, p2l = 1, p2m = 1, l2p = 1, m2m = 1, l2l = 1;
    double of(const Work& work) const;
};

struct WorkCounts {
    View<Work> boxes;  ///< [nboxes]
    Work total;
};

/// Throws Error{null} if the tree lacks the particle counts of its boxes, Error{memory}.
WorkCounts count_work(const FMMTraversalInfo& traversal);

}  // namespace connectivity
