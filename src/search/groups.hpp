// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The group search: order once, gather every build, then block by block into arenas, then into the
/// lists.
///
/// Invariants: rows do not depend on the order, the threads or the instruction set. The order is
/// found anew when the number of nodes changes or when blocks have spread by half since it was
/// made. Cost: see GroupWorker; memory 8 (Dim + 1) + 4 bytes a node for the gathered copy, 16 for
/// row records, and the arenas, which hold as many entries as the lists.

#include "group_worker.hpp"
#include "row_store.hpp"
#include "row_visitor.hpp"

namespace connectivity::detail {

template <int Dim>
class GroupSearch {
public:
    /// Orders the nodes, or keeps the order there is, and gathers them. Throws Error{memory}.
    void update_order(const SearchNodes<Dim>& nodes, Report& report);

    /// Finds the rows of the nodes ordered last. Throws Error{budget | memory}; the products are
    /// then as before.
    void run(const SearchNodes<Dim>& nodes, const SlotLayout& layout, const SearchRequest& request,
             Products products, Report& report);

    /// Hands the rows of the nodes ordered last, or their half rows, to f. Throws what f throws
    /// as HostException, Error{memory}.
    void visit(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
               const SearchRequest& request, RowFunction f);

    /// The order made last.
    const GroupOrder& order() const { return order_; }

    /// Slots in the order made last, [n].
    View<Slot> spatial_order() const;

    Offset order_bytes() const { return order_.bytes() + boxes_.bytes(); }
    Offset scratch_bytes() const;

private:
    void reserve_workers();
    void sweep(const GroupSweep<Dim>& shared, Offset stride);
    Offset estimate_entries(const GroupSweep<Dim>& shared);
    void find_rows(const GroupSweep<Dim>& shared, const SlotLayout& layout,
                   const SearchRequest& request, Products products);
    void count_work(Report& report) const;

    GroupOrder order_;
    GroupBoxes<Dim> boxes_;
    RowStore store_;
    std::vector<GroupWorker<Dim>> workers_;
    double spread_when_ordered_ = 0;
    Offset entries_before_ = -1;  // of the last successful build; -1: none
};

extern template class GroupSearch<1>;
extern template class GroupSearch<2>;
extern template class GroupSearch<3>;

}  // namespace connectivity::detail
