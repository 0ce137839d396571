// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// First stage: order, nodes and layout where kernels can read them; positions in search order,
/// boxes of leaves, blocks and tree nodes.
///
/// Cost: host to device 8 (Dim + 1) bytes a node (and tensors) each build, the order where it is
/// new; one read of positions in random order.

#include <connectivity/search/search.hpp>

#include "problem.hpp"
#include "spaces.hpp"

namespace connectivity::detail::device {

/// The order on the device, and what follows from it.
template <class Exec>
class OrderCopy {
public:
    /// Throws Error{memory}, std::bad_alloc.
    template <int Dim>
    void update(const GroupOrder& order, Problem<Dim>& problem);
    Offset bytes() const;

private:
    void derive(const GroupOrder& order);

    View<Slot> held_;  // keeps a copied order's memory: another order cannot lie there
    std::vector<Slot> leaf_blocks_;
    std::vector<Offset> block_nodes_;
    Uploaded<Slot, Exec> slot_, leaf_block_;
    Uploaded<Offset, Exec> block_leaf_, block_node_;
    Uploaded<ClassTree, Exec> tree_;
};

template <class Exec, int Dim>
class Nodes {
public:
    /// The problem of this build, ready for the search. Throws Error{memory}, std::bad_alloc.
    Problem<Dim> update(const SearchNodes<Dim>& nodes, const GroupOrder& order,
                        const SlotLayout& layout, const SearchRequest& request);
    Offset bytes() const;

private:
    void upload(const SearchNodes<Dim>& nodes, Problem<Dim>& problem);
    void upload(const SlotLayout& layout, const SearchRequest& request, Layout& to);
    void fold_places(const SearchNodes<Dim>& nodes, Problem<Dim>& problem);
    void find_boxes(const GroupOrder& order, Problem<Dim>& problem);

    OrderCopy<Exec> order_;
    Uploaded<double, Exec> positions_, reach2_, H_;
    Uploaded<Offset, Exec> list_offset_, row_offset_;
    Uploaded<std::uint8_t, Exec> active_;
    Array<double, Exec> folded_, leaf_x_;
    Array<Box<Dim>, Exec> leaf_, node_;
    Array<int, Exec> wanted_;
};

}  // namespace connectivity::detail::device
