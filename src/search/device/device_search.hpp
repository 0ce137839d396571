// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The device search: the stages of the group search as kernels of Kokkos' default execution space.
///
/// Invariants: every list is counted before it is stored; blocks are treated in batches, and the
/// leaves of a batch in parts, whose lists stay below a limit, or are one block or leaf each. What
/// the filling needs has been there in the counting, so nothing fails once old lists are being
/// overwritten. With one batch of one part the lists are found once, else again for the filling.
/// Cost: see the stages; memory is kept from build to build.

#include <vector>

#include "nodes.hpp"
#include "rows.hpp"

namespace connectivity::detail {

template <int Dim>
class DeviceSearch {
public:
    /// Finds the rows of nodes in an order that was made for so many. Throws
    /// Error{budget | memory}; the products are then as before.
    void run(const SearchNodes<Dim>& nodes, const GroupOrder& order, const SlotLayout& layout,
             const SearchRequest& request, Products products, Report& report);

    /// Bytes that candidates of a batch, and lists of a part of its leaves, may take.
    void limit_lists(Offset bytes) { limit_ = bytes; }

    Offset bytes() const;

private:
    using Exec = Kokkos::DefaultExecutionSpace;

    struct Range {
        Offset first, last;
    };

    /// Calls body(first leaf, last leaf) for all parts of all batches, their lists being there.
    template <class Body>
    void sweep(const device::Problem<Dim>& problem, const GroupOrder& order, const Body& body);
    template <class Body>
    void sweep_batch(const device::Problem<Dim>& problem, const GroupOrder& order,
                     const Range& blocks, const Body& body);

    /// Consecutive items whose lists fit the limit together, or one item.
    void cut(const Offset* offsets, Offset n, std::vector<Range>& ranges) const;

    Offset limit_ = Offset{256} << 20;
    Offset n_parts_ = 0;                         // of the last sweep
    const Offset* candidate_offsets_ = nullptr;  // [n_blocks + 1]
    std::vector<Range> batches_, parts_;         // members: their memory is there for the filling
    device::Nodes<Exec, Dim> nodes_;
    device::NearBlocks<Exec, Dim> near_;
    device::Candidates<Exec, Dim> candidates_;
    device::LeafLists<Exec, Dim> lists_;
    device::Rows<Exec, Dim> rows_;
};

extern template class DeviceSearch<1>;
extern template class DeviceSearch<2>;
extern template class DeviceSearch<3>;

}  // namespace connectivity::detail
