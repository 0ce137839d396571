// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The overlap rows of a block of close nodes, as bits over the nodes that the block can reach.
///
/// Universe: all nodes that are seen at some witness of the block (a witness is a node that one of
/// the members sees, or a member). The scatter row of every witness becomes one row of bits over
/// the universe, once a block, and a member's row is the union of its witnesses' rows. So a block
/// costs its witnesses' rows once, not once a member, and unions run 64 nodes an instruction or
/// more. Invariant: a block whose bits would outgrow its limits has one member, and its row is the
/// universe. Scratch memory follows the block, not the number of nodes.

#include <vector>

#include "label_rows.hpp"
#include "labels.hpp"
#include "local_numbers.hpp"
#include "word_arena.hpp"

namespace connectivity {

/// What overlap rows are made from.
struct OverlapInput {
    LabelRows gather;   ///< the labels that a label sees, without itself
    LabelRows scatter;  ///< the labels that see it; the same arrays if all supports are equal
    const Labels& labels;
    /// [n_slots] labels, close ones together; null: ascending, many times slower where labels say
    /// nothing of the place.
    const Slot* order = nullptr;
};

namespace detail {

/// The same in places of the order: rows by place, of places.
struct OverlapSource {
    LabelRows gather, scatter;
    const Labels& labels;
    const Slot* order = nullptr;  ///< [n_slots] labels by place; null: places are labels

    Slot label_at(Slot place) const { return order != nullptr ? order[place] : place; }
};

/// Overlap rows of the members of a block, in an arena.
struct OverlapRows {
    const OverlapRows* next = nullptr;
    int n_members = 0, n_universe = 0;
    long stride = 0;                      ///< words a row
    const Slot* members = nullptr;        ///< slots
    const Slot* universe = nullptr;       ///< slots by (list, label), padded to whole words
    const std::uint64_t* bits = nullptr;  ///< [n_members * stride]
};

class OverlapBlock {
public:
    /// Forgets the members.
    void begin();

    /// Adds the nodes at places [first, last), or at first those that go together with the
    /// members; returns how many. Throws std::bad_alloc.
    Offset add(const OverlapSource& input, Offset first, Offset last);

    /// The next labels should go to another block.
    bool is_full() const;

    /// Writes the members' rows, and their lengths to counts[slot * n_lists + list]. Throws
    /// std::bad_alloc, Error{memory}.
    OverlapRows* store(const OverlapSource& input, WordArena& arena, Slot* counts);

    Offset bytes() const;

private:
    void add_member(const OverlapSource& input, Slot place);
    int witness(const OverlapSource& input, Slot place);
    void read_witnesses(const OverlapSource& input);
    void order_universe(const OverlapSource& input);
    const std::uint64_t* witness_bits(long stride);
    OverlapRows* take(WordArena& arena) const;
    void count(const OverlapRows& rows, int member, Slot* counts) const;

    LocalNumbers numbers_;
    std::vector<Slot> members_, witnesses_;  // places
    std::vector<int> own_;                   // number of each member
    std::vector<int> witness_of_;            // by number; -1: no witness
    std::vector<int> use_;                   // witnesses, member by member
    std::vector<Offset> use_end_;
    std::vector<int> seen_;  // numbers at each witness, witness by witness
    std::vector<Offset> seen_end_;
    std::vector<std::uint64_t> keys_, spare_keys_;
    std::vector<Offset> digits_;
    std::vector<int> rank_;       // in the universe, by number
    std::vector<Slot> universe_;  // slots
    std::vector<int> list_end_;   // in the universe
    int n_universe_ = 0;
    WordArena bits_;      // of the witnesses
    bool alone_ = false;  // one member that sees too many for bits
};

}  // namespace detail
}  // namespace connectivity
