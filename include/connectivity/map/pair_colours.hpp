// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Half rows in blocks, blocks in colours: two blocks of a colour have no node in common, so that
/// they can add to their nodes at the same time without atomics.
///
/// Invariants: every slot is in exactly one block, every block has one colour; blocks and colours
/// depend on the pair list and the order only, never on the number of threads. Cost: one pass over
/// the pairs by one thread, 4 bytes a slot; n_colours() launches a sum. With blocks of nodes that
/// are not close in space nearly all blocks meet, and each gets a colour of its own: give
/// the spatial order unless slots are in one already.

#include <vector>

#include <connectivity/map/pair_field_base.hpp>

namespace connectivity {

class PairColours {
public:
    static constexpr Offset default_block_size = 256;  ///< slots

    PairColours() = default;
    /// `order` [n_slots] is a permutation of the slots, such as the map's spatial order, or empty:
    /// as they are. Throws Error{not_built}, Error{argument} if order is none, Error{memory}.
    explicit PairColours(const NodePairList& pairs, const ConstView<Slot>& order = {},
                         Offset block_size = default_block_size) {
        rebuild(pairs, order, block_size);
    }
    void rebuild(const NodePairList& pairs, const ConstView<Slot>& order = {},
                 Offset block_size = default_block_size);

    int n_colours() const { return static_cast<int>(colour_offset_.size()) - 1; }
    Offset n_blocks() const { return colour_offset_.back(); }
    /// Blocks of colour c are [colour_offset[c], colour_offset[c+1]).
    const std::vector<Offset>& colour_offset() const { return colour_offset_; }
    /// [n_blocks + 1]: slots of block b are slots()[block_offset[b] .. block_offset[b+1]).
    ConstView<Offset> block_offset() const { return block_offset_; }
    ConstView<Slot> slots() const { return slots_; }  ///< [n_slots], a permutation

    Stamp stamp() const { return stamp_; }  ///< of the pair list; 0: of none
    Offset bytes() const;

private:
    View<Slot> slots_;
    View<Offset> block_offset_;
    std::vector<Offset> colour_offset_{0};
    Stamp stamp_ = 0;
};

}  // namespace connectivity
