// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Lists after nodes were dropped and renumbered, or pairs removed: made beside the old lists, from
/// them alone.
///
/// Invariant: `prepare` may fail and changes nothing; `commit` cannot fail. Storage of the lists
/// that are replaced stays here for the next patch. Cost: a count and a copy of every list; a sort
/// of every row where nodes change their order.

#include "derived_build.hpp"
#include "renumbering.hpp"

namespace connectivity {

/// Which lists a map has.
struct BuiltLists {
    bool rows, pairs, overlap, intersection, by_key;
};

class Patch {
public:
    /// Nodes dropped and renumbered. Throws Error{memory}.
    void prepare_nodes(const Renumbering& now, const SlotLayout& before, const MapLists& lists,
                       BuiltLists built);
    /// Pairs left out of rows and pairs. Throws Error{memory}.
    void prepare_pairs(const PairFilter& filter, const SlotLayout& layout, const MapLists& lists,
                       BuiltLists built);

    /// [new n_pairs]: the old number of each pair.
    ConstView<Offset> new_to_old() const;

    void commit(MapLists lists, BuiltLists built);

    Offset bytes() const;

private:
    void patch_half_rows(const Renumbering& now, const MapLists& lists, BuiltLists built);
    void turn_half_rows(const Renumbering& now, const Csr& old);
    Offset* take_sources(Offset n_pairs);

    Csr rows_{"map/rows"}, half_rows_{"map/pairs"}, overlap_{"map/overlap"},
        intersection_{"map/intersection"};
    KeyOrder key_order_;
    View<Offset> new_to_old_;
    Offset n_pairs_ = 0;
    bool renumbers_ = false;
};

}  // namespace connectivity
