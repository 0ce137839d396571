// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The common neighbours of the pairs of a block of close nodes, as bits over the row of the pair's
/// first node.
///
/// The nodes of all the members' rows get small numbers, the rows of all partners are read once a
/// block, as numbers. For member a a table holds the bit of every number in a's row; a pair (a, b)
/// is the union of the entries of b's row, 128 neighbours of a at a time. Members with very long
/// rows, and partners with rows much longer than a's, are searched by bisection instead. Invariant:
/// a pair's row is ascending by label and holds both ends.

#include <vector>

#include <connectivity/search/predicate.hpp>

#include "label_rows.hpp"
#include "labels.hpp"
#include "local_numbers.hpp"
#include "segment.hpp"
#include "word_arena.hpp"

namespace connectivity {

/// What intersections are made from.
template <int Dim>
struct IntersectionInput {
    LabelRows rows;           ///< all nodes stored, symmetric
    LabelRows half_rows;      ///< the pairs: of row a the labels b > a
    const double* positions;  ///< [n_slots * Dim] by label
    Periods<Dim> periods;
    bool in_segment;  ///< only nodes between the two, see segment.hpp
    const Labels& labels;
    /// [n_slots] labels, close ones together; null: ascending, many times slower where labels say
    /// nothing of the place.
    const Slot* order = nullptr;
};

namespace detail {

/// The inverse of the order beside the input.
template <int Dim>
struct IntersectionSource : IntersectionInput<Dim> {
    const Slot* place_of = nullptr;  ///< [n_slots] by label; null: places are labels

    Slot label_at(Slot place) const { return this->order != nullptr ? this->order[place] : place; }
    Slot place(Slot label) const { return place_of != nullptr ? place_of[label] : label; }
};

/// Rows of the pairs of one node, in an arena: bits over its neighbours, or else (no bits) all rows
/// end to end.
struct PairRows {
    const PairRows* next = nullptr;
    Offset first_pair = 0, n_pairs = 0, n_entries = 0;
    int n_words = 0;                      ///< of a pair
    const Slot* slots = nullptr;          ///< of the bits, padded to whole words; or the rows
    const std::uint64_t* bits = nullptr;  ///< [n_pairs * n_words]
};

template <int Dim>
class IntersectionBlock {
public:
    /// Counts the pairs of the labels at places [first, last) to counts[pair]. Throws
    /// std::bad_alloc, Error{memory}.
    const PairRows* store(const IntersectionSource<Dim>& input, Offset first, Offset last,
                          WordArena& arena, Slot* counts);
    Offset bytes() const;

private:
    using Source = IntersectionSource<Dim>;
    struct Entry {
        std::uint64_t bits[2];
    };

    void take_members(const Source& input, Offset first, Offset last);
    void read_partners(const Source& input, Offset first, Offset last);
    void read_row(const Source& input, Slot label);
    void take_universe(const Source& input, Slot a);
    PairRows* store_bits(const Source& input, Slot a, WordArena& arena, Slot* counts);
    PairRows* store_rows(const Source& input, Slot a, WordArena& arena, Slot* counts);
    void mark_common(const Source& input, std::span<const Slot> half, std::uint64_t* bits);
    void unite(int partner, std::uint64_t (&sum)[2]) const;
    void bisect(const Source& input, Slot b, std::uint64_t* bits);

    LocalNumbers numbers_;
    std::vector<int> index_;    // by number: without gaps, from 1; 0: not met
    std::vector<int> partner_;  // by index; -1: its row was not read
    std::vector<int> row_;      // indices, partner by partner
    std::vector<Offset> row_end_;
    std::vector<int> scratch_;
    std::vector<Entry> table_;     // by index
    std::vector<Slot> universe_;   // row of the member, with itself and its partners
    std::vector<int> own_;         // index of each, 0 if it is no neighbour
    std::vector<int> ends_;        // place of each partner there
    int own_end_ = 0;              // of the member itself
    std::vector<Slot> long_rows_;  // slots
    SegmentsFrom<Dim> segments_;
    int n_index_ = 0;
};

/// The labels that rows a and b have in common, filtered if the input says so, and both ends.
template <int Dim>
void common_row(const IntersectionInput<Dim>& input, Slot a, Slot b, std::vector<Slot>& out,
                SegmentsFrom<Dim>& segments);

extern template class IntersectionBlock<1>;
extern template class IntersectionBlock<2>;
extern template class IntersectionBlock<3>;

}  // namespace detail
}  // namespace connectivity
