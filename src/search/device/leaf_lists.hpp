// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Fourth stage: for every leaf the candidates of its block that are near the leaf's own box, still
/// sorted.
///
/// Invariants: counted for all leaves of a batch, then stored for as many of them as fit. Cost: a
/// box test for each leaf and candidate of its block, twice; 4 bytes an entry that is stored.

#include "candidates.hpp"

namespace connectivity::detail::device {

template <class Exec, int Dim>
class LeafLists {
public:
    /// Counts for the leaves of a batch of blocks, whose candidates are there. Returns
    /// [last_leaf - first_leaf + 1] offsets on the host. Throws Error{memory}.
    const Offset* count(const Problem<Dim>& problem, const Candidates<Exec, Dim>& candidates,
                        Offset first_block, Offset first_leaf, Offset last_leaf);

    /// Room for n entries. Throws Error{memory}.
    void reserve(Offset n) { ensure_capacity(slots_, "search/device/leaf_lists", n); }

    /// Stores the lists of leaves [first, last) of the batch, which fit.
    void fill(const Problem<Dim>& problem, const Candidates<Exec, Dim>& candidates,
              Offset first_block, Offset first, Offset last);

    /// Of leaf l: slots()[offsets()[l - first] - offsets()[0]] and so on, from the first leaf
    /// that was filled last.
    const Slot* slots() const { return slots_.data(); }
    const Offset* offsets() const { return filled_; }
    Offset bytes() const { return bytes_of(slots_) + offsets_.bytes(); }

private:
    Offset first_leaf_ = 0;
    Offset* counted_ = nullptr;  // both into offsets_
    const Offset* filled_ = nullptr;
    Downloaded<Offset, Exec> offsets_;
    Array<Slot, Exec> slots_;
};

}  // namespace connectivity::detail::device
