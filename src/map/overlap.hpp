// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Overlap rows: who shares a witness with whom.
///
/// O(a) = all b != a such that some node k is seen by both a and b; a node counts as a witness of
/// itself, so O(a) holds all neighbours of a. Source: the overlap connectivity of Spheral's design.
/// The relation is symmetric.
///
/// Where an order is given, rows are first copied into it: a block then reads them side by side,
/// and not all over the memory once a witness. Invariant: between `prepare` and `commit` the rows
/// lie in arenas as bits, about a sixth of the memory of the result where neighbours are close in
/// the order, at most three times it where not; `commit` only expands them and reads nothing of the
/// input. Cost: see overlap_block.hpp. A node that sees very many is a block of its own and costs
/// the rows of all its witnesses.

#include <connectivity/base/csr.hpp>
#include <connectivity/base/parallel.hpp>

#include "overlap_block.hpp"

namespace connectivity {

/// Keeps its scratch memory from build to build.
class OverlapBuild {
public:
    /// Counts: n_slots * n_lists rows of `out` are prepared, row slot * n_lists + list. Returns the
    /// bytes that `out` will hold; call out.reserve() before `commit`. Throws Error{memory};
    /// nothing visible changes.
    Offset prepare(const OverlapInput& input, Csr& out);

    /// Fills and publishes what was prepared. Cannot fail.
    void commit(Csr& out);

    /// Scratch memory held.
    Offset bytes() const;

private:
    struct alignas(64) Worker {
        detail::OverlapBlock block;
        detail::WordArena arena;
        std::vector<Slot> row;
    };

    const detail::OverlapRows* count_chunk(const detail::OverlapSource& input, Worker& worker,
                                           Offset first, Offset last);
    detail::OverlapSource in_places(const OverlapInput& input);
    LabelRows by_place(LabelRows rows, const OverlapInput& input, Csr& copy) const;
    void write(const detail::OverlapRows& rows, Slot* row, Csr& out, bool past_caches) const;

    int n_lists_ = 1;
    std::vector<Worker> workers_;
    std::vector<const detail::OverlapRows*> chunks_;                     // first block of each
    View<Slot> counts_;                                                  // [n_slots * n_lists]
    View<Slot> place_of_;                                                // [n_slots] by label
    Csr gather_{"map/overlap/gather"}, scatter_{"map/overlap/scatter"};  // by place, of places
};

}  // namespace connectivity
