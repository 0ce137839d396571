// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Nodes in the group search's tree, for questions about single places.
///
/// Invariant: a walk that asks `may_hold` of boxes visits every leaf with a node that it would
/// accept, as boxes hold their nodes' positions and largest reaches. Copies of the nodes are its
/// own.

#include <algorithm>

#include "prepare.hpp"
#include "search/device/box.hpp"
#include "search/group_boxes.hpp"

namespace connectivity {

template <int Dim>
class NodeTree {
public:
    using Box = detail::device::Box<Dim>;
    using Nearness = detail::device::Nearness<Dim>;

    /// Throws as prepare_nodes does, Error{memory}.
    NodeTree(std::span<const NodeList> lists, const Domain& domain) {
        nodes_ = prepare_nodes<Dim>(lists, domain, storage_);
        own_copies();
        order_ = detail::order_groups(nodes_);
        boxes_.gather(nodes_, order_);
        largest_ = largest_coordinate();
        leaf_of_.resize(static_cast<std::size_t>(nodes_.n));
        for (std::size_t p = 0; p < order_.slot.size(); ++p)
            if (order_.slot(p) >= 0)
                leaf_of_[static_cast<std::size_t>(order_.slot(p))] =
                    static_cast<Offset>(p) / detail::leaf_size;
    }

    const SearchNodes<Dim>& nodes() const { return nodes_; }
    /// What folding, shifting and wrapping may round for a question about x: see
    /// search/device/box.hpp.
    double slack_at(const double* x) const {
        if (!nodes_.periods.any) return 0;
        double largest = largest_;
        for (int d = 0; d < Dim; ++d) largest = std::max(largest, std::fabs(x[d]));
        return 16 * std::numeric_limits<double>::epsilon() * largest;
    }
    Offset leaf_of(Slot slot) const { return leaf_of_[static_cast<std::size_t>(slot)]; }
    Box leaf_box(Offset leaf) const { return box_of(boxes_.leaf(leaf)); }

    /// What is near in a mode: `own` reach counts in gather, that of the nodes found in scatter.
    Nearness nearness(SearchMode mode, double slack) const {
        return {nodes_.periods, slack, mode != SearchMode::scatter, mode != SearchMode::gather};
    }

    /// f(slot) for all nodes of leaves whose boxes, and whose trees' boxes, may hold what is
    /// looked for.
    template <class MayHold, class F>
    void walk(const MayHold& may_hold, const F& f) const {
        for (const auto& tree : order_.trees) walk(tree, 1, may_hold, f);
    }

    /// f(slot) for the nodes of one leaf.
    template <class F>
    void visit_leaf(Offset leaf, const F& f) const {
        for (Offset p = leaf * detail::leaf_size; p < (leaf + 1) * detail::leaf_size; ++p)
            if (order_.slot(p) >= 0) f(order_.slot(p));
    }

    /// The box of one place, folded as the nodes are.
    Box box_at(const double* x, double reach2) const {
        Box box;
        for (int d = 0; d < Dim; ++d)
            box.lo[d] = box.hi[d] = detail::device::fold(x[d], nodes_.periods.length[d]);
        box.reach2 = reach2;
        return box;
    }

private:
    template <class MayHold, class F>
    void walk(const detail::ClassTree& tree, Offset node, const MayHold& may_hold,
              const F& f) const {
        if (!may_hold(box_of(boxes_.tree_node(tree.first_node + node)))) return;
        if (node < tree.n_blocks) {
            walk(tree, 2 * node, may_hold, f);
            walk(tree, 2 * node + 1, may_hold, f);
            return;
        }
        const Offset block = tree.first_block + node - tree.n_blocks;
        for (Offset leaf = order_.block_leaf[block]; leaf < order_.block_leaf[block + 1]; ++leaf)
            if (may_hold(leaf_box(leaf))) visit_leaf(leaf, f);
    }

    static Box box_of(const detail::ReachBox<Dim>& from) {
        Box box;
        for (int d = 0; d < Dim; ++d) box.lo[d] = from.lo[d], box.hi[d] = from.hi[d];
        box.reach2 = from.reach2;
        return box;
    }

    /// A single list is prepared where it lies: the tree must outlive it.
    void own_copies() {
        const auto copy = [](ConstView<double>& view, View<double>& storage) {
            if (view.size() == 0 || view.data() == storage.data()) return;
            storage = allocate<double>("map/node_tree", static_cast<Offset>(view.size()));
            Kokkos::deep_copy(storage, view);
            view = storage;
        };
        copy(nodes_.positions, storage_.positions);
        copy(nodes_.H, storage_.H);
    }

    double largest_coordinate() const {
        double largest = 0;
        for (int d = 0; d < Dim; ++d) largest = std::max(largest, nodes_.periods.length[d]);
        for (std::size_t k = 0; k < nodes_.positions.size(); ++k)
            largest = std::max(largest, std::fabs(nodes_.positions(k)));
        return largest;
    }

    PreparedStorage storage_;
    SearchNodes<Dim> nodes_;
    detail::GroupOrder order_;
    detail::GroupBoxes<Dim> boxes_;
    std::vector<Offset> leaf_of_;  // by slot
    double largest_ = 0;           // of positions and periods
};

}  // namespace connectivity
