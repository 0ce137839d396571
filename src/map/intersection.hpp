// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Common neighbours of the two nodes of every pair.
///
/// The row of pair (a, b) holds a, b and their common neighbours: all of them, or those between the
/// two (closed slab test, see segment.hpp). Source: the intersection connectivity of Spheral's
/// design. Invariant: between `prepare` and `commit` the rows lie in arenas as bits over the
/// neighbours of a, about an eighth of the memory of the result; `commit` only expands them and
/// reads nothing of the input. Cost: see intersection_block.hpp.

#include <connectivity/base/csr.hpp>
#include <connectivity/base/parallel.hpp>

#include "intersection_block.hpp"

namespace connectivity {

/// Keeps its scratch memory from build to build.
template <int Dim>
class IntersectionBuild {
public:
    /// Counts: one row of `out` for every pair, in the order of the half rows. Returns the bytes
    /// that `out` will hold; call out.reserve() before `commit`. Throws Error{memory}; nothing
    /// visible changes.
    Offset prepare(const IntersectionInput<Dim>& input, Csr& out);

    /// Fills and publishes what was prepared: slots, ascending by label. Cannot fail.
    void commit(Csr& out);

    /// Scratch memory held.
    Offset bytes() const;

private:
    struct alignas(64) Worker {
        detail::IntersectionBlock<Dim> block;
        detail::WordArena arena;
        std::vector<Slot> row;
    };

    detail::IntersectionSource<Dim> with_places(const IntersectionInput<Dim>& input);
    void take_row_memory();

    std::vector<Worker> workers_;
    std::vector<const detail::PairRows*> chunks_;  // first node of each
    View<Slot> counts_;                            // [n_pairs]
    View<Slot> place_of_;                          // [n_slots] by label
};

extern template class IntersectionBuild<1>;
extern template class IntersectionBuild<2>;
extern template class IntersectionBuild<3>;

}  // namespace connectivity
