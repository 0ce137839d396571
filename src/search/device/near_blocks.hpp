// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Second stage: for every block, the blocks whose nodes may be neighbours of its own, by a walk
/// through every class's tree.
///
/// Cost: a thread a block, about 150 box tests where supports have one size; 24 bytes a pair of
/// near blocks.

#include "problem.hpp"
#include "spaces.hpp"

namespace connectivity::detail::device {

/// Blocks that are near each other; `near` holds candidates of `block`.
struct NearBlock {
    Slot block, near;
};

template <class Exec, int Dim>
class NearBlocks {
public:
    /// Throws Error{memory}.
    void find(const Problem<Dim>& problem);

    Offset n() const { return n_; }
    const NearBlock* pairs() const { return pairs_.data(); }   ///< [n], by block
    const Offset* offsets() const { return offsets_.data(); }  ///< [n_blocks + 1]
    Offset bytes() const { return bytes_of(pairs_) + bytes_of(offsets_); }

private:
    Offset n_ = 0;
    Array<Offset, Exec> offsets_;
    Array<NearBlock, Exec> pairs_;
};

}  // namespace connectivity::detail::device
