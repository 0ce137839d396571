// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Nodes gathered in search order, with boxes around leaves and tree nodes.
///
/// Invariants: boxes hold the gathered positions exactly, so that the computed gap of two boxes
/// never exceeds the computed distance of two of their nodes (rounding is monotone); on periodic
/// axes positions are folded into [0, L), which moves them by at most `fold_error`. Cost: one read
/// of positions and reaches in random order, 8 (Dim + 1) bytes a node written, 36 more for tensors
/// in 3D; every build.

#include <algorithm>
#include <cmath>
#include <limits>

#include "group_order.hpp"

namespace connectivity::detail {

/// A box and the reaches of the nodes in it. Empty: reach2 = -1 and an inverted box.
template <int Dim>
struct ReachBox {
    double lo[Dim], hi[Dim];
    double reach2;   ///< largest
    double least;    ///< smallest that is not negative; infinite if there is none
    bool has_blind;  ///< some node sees nobody

    void clear() {
        for (int d = 0; d < Dim; ++d)
            lo[d] = std::numeric_limits<double>::infinity(),
            hi[d] = -std::numeric_limits<double>::infinity();
        reach2 = -1;
        least = std::numeric_limits<double>::infinity();
        has_blind = false;
    }
    void add(const ReachBox& b) {
        for (int d = 0; d < Dim; ++d)
            lo[d] = std::min(lo[d], b.lo[d]), hi[d] = std::max(hi[d], b.hi[d]);
        reach2 = std::max(reach2, b.reach2);
        least = std::min(least, b.least);
        has_blind = has_blind || b.has_blind;
    }
    void add(const double (&x)[Dim], double r2) {
        for (int d = 0; d < Dim; ++d) lo[d] = std::min(lo[d], x[d]), hi[d] = std::max(hi[d], x[d]);
        reach2 = std::max(reach2, r2);
        if (r2 >= 0)
            least = std::min(least, r2);
        else
            has_blind = true;
    }
    bool empty() const { return !(lo[0] <= hi[0]); }
};

/// May nodes of a and b interact? The sum runs over the axes in the order of the predicate. Boxes
/// that touch always may: a node that sees nobody must still find itself.
template <int Dim>
inline bool is_near(const ReachBox<Dim>& a, const ReachBox<Dim>& b, double slack) {
    double sum = 0;
    for (int d = 0; d < Dim; ++d) {
        const double gap = std::max(std::max(b.lo[d] - a.hi[d], a.lo[d] - b.hi[d]) - slack, 0.0);
        sum += gap * gap;
    }
    return sum <= std::max({a.reach2, b.reach2, 0.0});
}

template <int Dim>
class GroupBoxes {
public:
    static constexpr int leaf_stride = (Dim + 1) * leaf_size;

    /// Throws Error{memory}.
    void gather(const SearchNodes<Dim>& nodes, const GroupOrder& order);

    const ReachBox<Dim>& leaf(Offset l) const { return leaves_(l); }
    LeafBoxes leaf_boxes() const { return {bounds_.data(), bounds_stride_}; }
    const ReachBox<Dim>& tree_node(Offset k) const { return tree_nodes_(k); }
    const double* leaf_data(Offset l) const { return data_.data() + l * leaf_stride; }
    LeafArray leaf_array(const GroupOrder& order) const {
        return {data_.data(), shapes_.size() > 0 ? shapes_.data() : nullptr, order.slot.data(),
                leaf_stride};
    }

    /// Largest half width of the supports of some leaves along each axis; `reach2` is their largest
    /// reach.
    void widths(Offset first, Offset last, double reach2, double (&width)[Dim]) const {
        for (int d = 0; d < Dim; ++d) {
            width[d] = shapes_.size() > 0 ? 0 : std::sqrt(std::max(reach2, 0.0));
            for (Offset l = first; l < last && shapes_.size() > 0; ++l)
                width[d] = std::max(width[d], widths_(l * Dim + d));
        }
    }

    double fold_error() const { return fold_error_; }
    const ReachBox<Dim>& all() const { return all_; }
    bool uniform() const { return all_.reach2 == all_.least && all_.reach2 > 0 && !all_.has_blind; }

    /// How wide blocks are for their reach: sum over blocks of the product of (width / reach + 2).
    /// Grows as nodes drift away from the order.
    double spread() const { return spread_; }

    Offset bytes() const {
        return static_cast<Offset>((data_.size() + bounds_.size()) * sizeof(double) +
                                   shapes_.size() * sizeof(float) +
                                   widths_.size() * sizeof(double) +
                                   (leaves_.size() + tree_nodes_.size()) * sizeof(ReachBox<Dim>));
    }

private:
    void gather_leaf(const SearchNodes<Dim>& nodes, const GroupOrder& order, Offset leaf);
    void gather_tree(const SearchNodes<Dim>& nodes, const GroupOrder& order, const ClassTree& tree);
    void find_common_reach(const SearchNodes<Dim>& nodes);
    void gather_shapes(const SearchNodes<Dim>& nodes, const Slot* slot, Offset leaf);
    void gather_widths(const double (&h)[Dim][Dim][leaf_size], Offset leaf);
    void store_bounds(Offset leaf, const ReachBox<Dim>& box);
    double spread_of(const ReachBox<Dim>& block) const;

    View<double> data_;           // by leaf: x[Dim][16], reach²[16] (-infinity: blind)
    View<float> shapes_;          // by leaf: [shape_rows][16]; see metric.hpp
    View<double> widths_;         // by leaf: largest half widths [Dim] of ellipsoids
    View<ReachBox<Dim>> leaves_;  // [n_leaves]
    View<double> bounds_;         // the same, as vector kernels read them
    Offset bounds_stride_ = 0;
    View<ReachBox<Dim>> tree_nodes_;  // heap order, tree after tree
    ReachBox<Dim> all_{};
    double fold_error_ = 0, spread_ = 0, common_reach2_ = 0;
    bool has_common_reach_ = false;
};

extern template class GroupBoxes<1>;
extern template class GroupBoxes<2>;
extern template class GroupBoxes<3>;

}  // namespace connectivity::detail
