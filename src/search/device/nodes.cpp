// SPDX-License-Identifier: BSD-3-Clause
#include "nodes.hpp"

#include <algorithm>

namespace connectivity::detail::device {

namespace {

struct LargestMagnitude {
    const double* x;
    KOKKOS_INLINE_FUNCTION void operator()(Offset i, double& largest) const {
        largest = larger(largest, std::fabs(x[i]));
    }
};

template <int Dim>
struct Fold {
    const double* positions;
    Periods<Dim> periods;
    double* folded;
    KOKKOS_INLINE_FUNCTION void operator()(Offset i) const {
        for (int d = 0; d < Dim; ++d)
            folded[i * Dim + d] = fold(positions[i * Dim + d], periods.length[d]);
    }
};

template <int Dim>
struct GatherLeaf {
    Problem<Dim> problem;
    double* leaf_x;
    Box<Dim>* leaf;
    KOKKOS_INLINE_FUNCTION void operator()(Offset l) const {
        double* const x = leaf_x + l * problem.leaf_stride;
        Box<Dim> box;
        box.clear();
        for (int k = 0; k < leaf_size; ++k) {
            const Slot i = problem.slot[l * leaf_size + k];
            for (int d = 0; d < Dim; ++d)
                x[d * leaf_size + k] = i < 0 ? infinity : problem.place[Offset{i} * Dim + d];
            x[Dim * leaf_size + k] = i < 0 ? -1 : problem.see.reach2[i];
            if (i >= 0) box.add(problem.box_of_slot(i));
        }
        leaf[l] = box;
    }
};

template <int Dim>
struct BoxBlock {
    Problem<Dim> problem;
    Box<Dim>* node;
    int* wanted;
    KOKKOS_INLINE_FUNCTION void operator()(Offset b) const {
        Box<Dim> box;
        box.clear();
        int any = 0;
        for (Offset l = problem.block_leaf[b]; l < problem.block_leaf[b + 1]; ++l) {
            box.add(problem.leaf[l]);
            for (int k = 0; k < leaf_size && any == 0; ++k) {
                const Slot i = problem.slot[l * leaf_size + k];
                any = i >= 0 && problem.layout.is_wanted(i) ? 1 : 0;
            }
        }
        node[problem.block_node[b]] = box;
        wanted[b] = any;
    }
};

/// One level of all trees, `width` nodes each: a node is the union of its two children.
template <int Dim>
struct BoxLevel {
    Problem<Dim> problem;
    Box<Dim>* node;
    Offset width;
    KOKKOS_INLINE_FUNCTION void operator()(Offset item) const {
        const ClassTree& tree = problem.tree[item / width];
        const Offset k = width + item % width;
        if (k >= tree.n_blocks) return;
        Box<Dim>* const box = node + tree.first_node;
        box[k] = box[2 * k];
        box[k].add(box[2 * k + 1]);
    }
};

}  // namespace

template <class Exec>
void OrderCopy<Exec>::derive(const GroupOrder& order) {
    leaf_blocks_.resize(static_cast<std::size_t>(order.n_leaves()));
    block_nodes_.resize(static_cast<std::size_t>(order.n_blocks()));
    for (const ClassTree& tree : order.trees)
        for (Offset k = 0; k < tree.n_blocks; ++k) {
            const Offset b = tree.first_block + k;
            block_nodes_[b] = tree.first_node + tree.n_blocks + k;
            std::fill(leaf_blocks_.begin() + order.block_leaf[b],
                      leaf_blocks_.begin() + order.block_leaf[b + 1], static_cast<Slot>(b));
        }
}

template <class Exec>
template <int Dim>
void OrderCopy<Exec>::update(const GroupOrder& order, Problem<Dim>& problem) {
    const bool fresh = held_.data() != order.slot.data() || held_.size() != order.slot.size();
    held_ = {};  // nothing is held of an order that was copied in part
    if (fresh) derive(order);
    problem.n = order.n;
    problem.n_leaves = order.n_leaves();
    problem.n_blocks = order.n_blocks();
    problem.n_trees = static_cast<int>(order.trees.size());
    problem.slot =
        slot_("search/device/slot", order.slot.data(), problem.n_leaves * leaf_size, fresh);
    problem.block_leaf = block_leaf_("search/device/block_leaf", order.block_leaf.data(),
                                     problem.n_blocks + 1, fresh);
    problem.leaf_block =
        leaf_block_("search/device/leaf_block", leaf_blocks_.data(), problem.n_leaves, fresh);
    problem.block_node =
        block_node_("search/device/block_node", block_nodes_.data(), problem.n_blocks, fresh);
    problem.tree = tree_("search/device/tree", order.trees.data(), problem.n_trees, fresh);
    held_ = order.slot;
}

template <class Exec>
Offset OrderCopy<Exec>::bytes() const {
    return slot_.bytes() + leaf_block_.bytes() + block_leaf_.bytes() + block_node_.bytes() +
           tree_.bytes() +
           static_cast<Offset>(leaf_blocks_.size() * sizeof(Slot) +
                               block_nodes_.size() * sizeof(Offset));
}

template <class Exec, int Dim>
void Nodes<Exec, Dim>::upload(const SearchNodes<Dim>& nodes, Problem<Dim>& problem) {
    problem.see = significance(nodes);
    problem.see.positions =
        positions_("search/device/positions", nodes.positions.data(), nodes.n * Dim);
    problem.see.reach2 = reach2_("search/device/reach2", nodes.reach2.data(), nodes.n);
    if (problem.see.H != nullptr)
        problem.see.H = H_("search/device/H", problem.see.H, nodes.n * n_symmetric(Dim));
}

template <class Exec, int Dim>
void Nodes<Exec, Dim>::upload(const SlotLayout& layout, const SearchRequest& request, Layout& to) {
    const Offset n_lists = layout.n_lists();
    to.n_lists = layout.n_lists();
    to.rows = request.rows;
    to.halves = request.half_rows;
    to.last_stored = layout.n_rows() > 0 ? layout.slot_of_row(layout.n_rows() - 1) : -1;
    to.active = layout.active().size() > 0
                    ? active_("search/device/active", layout.active().data(), layout.n_slots())
                    : nullptr;
    to.list_offset =
        list_offset_("search/device/list_offset", layout.list_offset().data(), n_lists + 1);
    to.row_offset =
        row_offset_("search/device/row_offset", layout.row_offset().data(), n_lists + 1);
}

/// Positions inside the box, and how far folding may have moved them.
template <class Exec, int Dim>
void Nodes<Exec, Dim>::fold_places(const SearchNodes<Dim>& nodes, Problem<Dim>& problem) {
    problem.place = problem.see.positions;
    problem.near.periods = nodes.periods;
    problem.near.slack = 0;
    if (!nodes.periods.any) return;
    double largest = 0;
    Kokkos::parallel_reduce("search/device/largest", Items<Exec>(0, nodes.n * Dim),
                            LargestMagnitude{problem.see.positions}, Kokkos::Max<double>(largest));
    for (int d = 0; d < Dim; ++d) largest = std::max(largest, nodes.periods.length[d]);
    problem.near.slack = 16 * std::numeric_limits<double>::epsilon() * largest;
    ensure_capacity(folded_, "search/device/folded", nodes.n * Dim);
    Kokkos::parallel_for("search/device/fold", Items<Exec>(0, nodes.n),
                         Fold<Dim>{problem.see.positions, nodes.periods, folded_.data()});
    problem.place = folded_.data();
}

template <class Exec, int Dim>
void Nodes<Exec, Dim>::find_boxes(const GroupOrder& order, Problem<Dim>& problem) {
    ensure_capacity(leaf_x_, "search/device/leaf_x", problem.n_leaves * problem.leaf_stride);
    ensure_capacity(leaf_, "search/device/leaf", problem.n_leaves);
    ensure_capacity(node_, "search/device/node", order.n_tree_nodes);
    ensure_capacity(wanted_, "search/device/wanted", problem.n_blocks);
    problem.leaf_x = leaf_x_.data();
    problem.leaf = leaf_.data();
    problem.node = node_.data();
    problem.wanted = wanted_.data();
    Kokkos::parallel_for("search/device/gather", Items<Exec>(0, problem.n_leaves),
                         GatherLeaf<Dim>{problem, leaf_x_.data(), leaf_.data()});
    Kokkos::parallel_for("search/device/blocks", Items<Exec>(0, problem.n_blocks),
                         BoxBlock<Dim>{problem, node_.data(), wanted_.data()});
    Offset most = 1;
    for (const ClassTree& tree : order.trees) most = std::max(most, tree.n_blocks);
    for (Offset width = most / 2; width >= 1; width /= 2)
        Kokkos::parallel_for("search/device/tree", Items<Exec>(0, width * problem.n_trees),
                             BoxLevel<Dim>{problem, node_.data(), width});
}

template <class Exec, int Dim>
Problem<Dim> Nodes<Exec, Dim>::update(const SearchNodes<Dim>& nodes, const GroupOrder& order,
                                      const SlotLayout& layout, const SearchRequest& request) {
    Problem<Dim> problem{};
    order_.update(order, problem);
    upload(nodes, problem);
    upload(layout, request, problem.layout);
    problem.mode = request.mode;
    problem.near.own = request.mode != SearchMode::scatter;
    problem.near.other = request.mode != SearchMode::gather;
    fold_places(nodes, problem);
    find_boxes(order, problem);
    return problem;
}

template <class Exec, int Dim>
Offset Nodes<Exec, Dim>::bytes() const {
    return order_.bytes() + positions_.bytes() + reach2_.bytes() + H_.bytes() +
           list_offset_.bytes() + row_offset_.bytes() + active_.bytes() + bytes_of(folded_) +
           bytes_of(leaf_x_) + bytes_of(leaf_) + bytes_of(node_) + bytes_of(wanted_);
}

template class Nodes<Kokkos::DefaultExecutionSpace, 1>;
template class Nodes<Kokkos::DefaultExecutionSpace, 2>;
template class Nodes<Kokkos::DefaultExecutionSpace, 3>;

}  // namespace connectivity::detail::device
