// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Third stage: for every block the nodes near its box, sorted by slot once.
///
/// Invariants: all are counted before any is stored; they are stored for a batch of blocks at a
/// time. Cost: a vector of lanes for each pair of near blocks, a team for each sort; 4 bytes a
/// candidate of the batch.

#include "near_blocks.hpp"

namespace connectivity::detail::device {

template <class Exec, int Dim>
class Candidates {
public:
    /// Counts for all blocks; candidates of block b are offsets[b + 1] - offsets[b]; [n_blocks + 1]
    /// on the host. Throws Error{memory}.
    const Offset* count(const Problem<Dim>& problem, const NearBlocks<Exec, Dim>& near);

    /// Room for n candidates. Throws Error{memory}.
    void reserve(Offset n) { ensure_capacity(slots_, "search/device/candidates", n); }

    /// Finds and sorts those of blocks [first, last), which fit.
    void fill(const Problem<Dim>& problem, const NearBlocks<Exec, Dim>& near, Offset first,
              Offset last);

    /// Of block b: slots()[offsets()[b] - offsets()[first of the batch]] and so on.
    const Slot* slots() const { return slots_.data(); }
    const Offset* offsets() const { return offsets_; }
    Offset bytes() const {
        return bytes_of(slots_) + bytes_of(pair_offsets_) + block_offsets_.bytes();
    }

private:
    Array<Offset, Exec> pair_offsets_;  // [near blocks + 1]
    Downloaded<Offset, Exec> block_offsets_;
    const Offset *offsets_ = nullptr, *host_offsets_ = nullptr;  // into block_offsets_
    Array<Slot, Exec> slots_;
};

}  // namespace connectivity::detail::device
