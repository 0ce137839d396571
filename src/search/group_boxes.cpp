// SPDX-License-Identifier: BSD-3-Clause
#include "group_boxes.hpp"

#include <cmath>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

template <int Dim>
void GroupBoxes<Dim>::gather_leaf(const SearchNodes<Dim>& nodes, const GroupOrder& order,
                                  Offset leaf) {
    constexpr Offset look_ahead = 4 * leaf_size;  // hides the random reads of the caller's arrays
    const Slot* const slot = order.slot.data() + leaf * leaf_size;
    const bool fetch = (leaf + 5) * leaf_size <= static_cast<Offset>(order.slot.size());
    double* const data = data_.data() + leaf * leaf_stride;
    const double* const positions = nodes.positions.data();
    const double* const reach2 = has_common_reach_ ? nullptr : nodes.reach2.data();
    const double* const tensors = nodes.H.size() > 0 ? nodes.H.data() : nullptr;
    ReachBox<Dim> box;
    box.clear();
    for (int k = 0; k < leaf_size; ++k) {
        if (fetch && slot[k + look_ahead] >= 0) {
            __builtin_prefetch(positions + static_cast<Offset>(slot[k + look_ahead]) * Dim);
            __builtin_prefetch(positions + static_cast<Offset>(slot[k + look_ahead]) * Dim + Dim -
                               1);
            if (reach2 != nullptr) __builtin_prefetch(reach2 + slot[k + look_ahead]);
            if (tensors != nullptr) {
                __builtin_prefetch(tensors + slot[k + look_ahead] * Offset{n_symmetric(Dim)});
                __builtin_prefetch(tensors + (slot[k + look_ahead] + 1) * Offset{n_symmetric(Dim)} -
                                   1);
            }
        }
        if (slot[k] < 0) {
            for (int d = 0; d < Dim; ++d)
                data[d * leaf_size + k] = std::numeric_limits<double>::infinity();
            data[Dim * leaf_size + k] = -1;
            continue;
        }
        double x[Dim];
        for (int d = 0; d < Dim; ++d)
            data[d * leaf_size + k] = x[d] =
                nodes.periods.any ? folded(nodes, slot[k], d)
                                  : positions[static_cast<Offset>(slot[k]) * Dim + d];
        const double r2 = reach2 != nullptr ? reach2[slot[k]] : common_reach2_;
        // No unit may turn "sees nobody" into a threshold of zero.
        data[Dim * leaf_size + k] = r2 < 0 ? -std::numeric_limits<double>::infinity() : r2;
        box.add(x, r2);
    }
    leaves_(leaf) = box;
    store_bounds(leaf, box);
    if (nodes.H.size() > 0) gather_shapes(nodes, slot, leaf);
}

/// P = (reach H / K)², the identity for scalar supports; columns of 16, for the compiler's vectors.
template <int Dim>
void GroupBoxes<Dim>::gather_shapes(const SearchNodes<Dim>& nodes, const Slot* slot, Offset leaf) {
    constexpr int n_shape = n_symmetric(Dim);
    const double* const reach2 = data_.data() + leaf * leaf_stride + Dim * leaf_size;
    float* shape = shapes_.data() + leaf * shape_rows<Dim> * leaf_size;
    double h[Dim][Dim][leaf_size], stretch[leaf_size];
    for (int k = 0; k < leaf_size; ++k)
        stretch[k] = std::sqrt(std::fabs(reach2[k]) / nodes.extent2);
    for (int k = 0; k < leaf_size; ++k) {
        const double* const H = nodes.H.data() + std::max(slot[k], 0) * Offset{n_shape};
        for (int a = 0, s = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b, ++s)
                h[a][b][k] = h[b][a][k] = H[0] != 0.0 ? stretch[k] * H[s] : a == b;
    }
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b, shape += leaf_size)
            for (int k = 0; k < leaf_size; ++k) {
                double sum = 0;
                for (int c = 0; c < Dim; ++c) sum += h[a][c][k] * h[c][b][k];
                shape[k] = static_cast<float>(sum);
            }
    gather_widths(h, leaf);
}

/// Entry (a, b) of the adjugate, for node k of 16.
template <int Dim>
double cofactor(const double (&h)[Dim][Dim][leaf_size], int a, int b, int k) {
    if constexpr (Dim == 1) return 1;
    if constexpr (Dim == 2) return (a == b ? 1 : -1) * h[1 - a][1 - b][k];
    const auto at = [&](int i, int j) { return h[(a + i) % Dim][(b + j) % Dim][k]; };
    return at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1);
}

/// Half widths per reach of |h r| <= 1: the norms of the columns of the inverse. No eigenvalue of h
/// is below 1, so with T = |h|² the determinant exceeds sqrt(T/3), and all rounding, that of the
/// double predicate too, is less than 2^-48 T. A ball needs no more than 1.
template <int Dim>
void GroupBoxes<Dim>::gather_widths(const double (&h)[Dim][Dim][leaf_size], Offset leaf) {
    const double* const reach2 = data_.data() + leaf * leaf_stride + Dim * leaf_size;
    float* const rows = shapes_.data() + (leaf * shape_rows<Dim> + n_symmetric(Dim)) * leaf_size;
    double norm2[leaf_size], det[leaf_size];
    for (int k = 0; k < leaf_size; ++k) {
        norm2[k] = det[k] = 0;
        for (int a = 0; a < Dim; ++a) det[k] += h[0][a][k] * cofactor<Dim>(h, 0, a, k);
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) norm2[k] += h[a][b][k] * h[a][b][k];
    }
    for (int d = 0; d < Dim; ++d) {
        double width[leaf_size], largest = 0;
        for (int k = 0; k < leaf_size; ++k) {
            double sum = 0;
            for (int a = 0; a < Dim; ++a)
                sum += cofactor<Dim>(h, a, d, k) * cofactor<Dim>(h, a, d, k);
            const double w = std::sqrt(sum) / det[k] + 0x1p-48 * norm2[k];
            width[k] = (w < 1 ? w : 1) * (1 + 0x1p-22);  // NaN is a ball, too
            rows[d * leaf_size + k] = static_cast<float>(width[k]);
        }
        for (int k = 0; k < leaf_size; ++k)
            if (reach2[k] > 0) largest = std::max(largest, width[k] * std::sqrt(reach2[k]));
        widths_(leaf * Dim + d) = largest;
    }
}

template <int Dim>
void GroupBoxes<Dim>::store_bounds(Offset leaf, const ReachBox<Dim>& box) {
    double* const at = bounds_.data() + leaf;
    for (int d = 0; d < Dim; ++d)
        at[d * bounds_stride_] = box.lo[d], at[(Dim + d) * bounds_stride_] = box.hi[d];
    at[2 * Dim * bounds_stride_] = box.reach2;
}

template <int Dim>
void GroupBoxes<Dim>::gather_tree(const SearchNodes<Dim>& nodes, const GroupOrder& order,
                                  const ClassTree& tree) {
    const Offset n = tree.n_blocks;
    ReachBox<Dim>* const box = tree_nodes_.data() + tree.first_node;
    for_each_dynamic("search/groups/gather", n, [&](int, Offset b) {
        ReachBox<Dim> block;
        block.clear();
        for (Offset l = order.block_leaf[tree.first_block + b];
             l < order.block_leaf[tree.first_block + b + 1]; ++l) {
            gather_leaf(nodes, order, l);
            block.add(leaves_(l));
        }
        box[n + b] = block;
    });
    for (Offset k = n - 1; k >= 1; --k) {
        box[k] = box[2 * k];
        box[k].add(box[2 * k + 1]);
    }
    all_.add(box[1]);
}

template <int Dim>
double GroupBoxes<Dim>::spread_of(const ReachBox<Dim>& block) const {
    const double reach2 = block.reach2 > 0 ? block.reach2 : all_.least;
    if (block.empty() || !(reach2 > 0) || !std::isfinite(reach2)) return 0;
    double product = 1;
    for (int d = 0; d < Dim; ++d)
        product *= std::min((block.hi[d] - block.lo[d]) / std::sqrt(reach2), 1e6) + 2;
    return product;
}

/// One reach for all needs no random reads.
template <int Dim>
void GroupBoxes<Dim>::find_common_reach(const SearchNodes<Dim>& nodes) {
    const double* const reach2 = nodes.reach2.data();
    const double first = common_reach2_ = nodes.n > 0 ? reach2[0] : 0;
    const Offset few = std::min(nodes.n, few_items);
    Offset others = std::count_if(reach2, reach2 + few, [=](double r2) { return r2 != first; });
    if (others == 0 && nodes.n > few)  // varied ones mostly show at once
        Kokkos::parallel_reduce(
            "search/groups/common_reach",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(few, nodes.n),
            [=](const Offset i, Offset& n) { n += reach2[i] != first; }, others);
    has_common_reach_ = others == 0;
}

template <int Dim>
void GroupBoxes<Dim>::gather(const SearchNodes<Dim>& nodes, const GroupOrder& order) {
    ensure_capacity(data_, "search/groups/nodes", order.n_leaves() * leaf_stride);
    ensure_capacity(leaves_, "search/groups/leaves", order.n_leaves());
    ensure_capacity(tree_nodes_, "search/groups/tree", order.n_tree_nodes);
    shapes_ = nodes.H.size() > 0 ? shapes_ : View<float>();
    widths_ = nodes.H.size() > 0 ? widths_ : View<double>();
    if (nodes.H.size() > 0) {
        ensure_capacity(shapes_, "search/groups/shapes",
                        order.n_leaves() * leaf_size * shape_rows<Dim>);
        ensure_capacity(widths_, "search/groups/widths", order.n_leaves() * Dim);
    }
    bounds_stride_ = order.n_leaves() + leaf_box_slack;
    ensure_capacity(bounds_, "search/groups/bounds", bounds_stride_ * (2 * Dim + 1));
    find_common_reach(nodes);
    all_.clear();
    for (Offset l = order.n_leaves(); l < bounds_stride_; ++l) store_bounds(l, all_);
    for (const ClassTree& tree : order.trees) gather_tree(nodes, order, tree);

    spread_ = 0;
    for (const ClassTree& tree : order.trees) {
        for (Offset b = 0; b < tree.n_blocks; ++b)
            spread_ += spread_of(tree_nodes_(tree.first_node + tree.n_blocks + b));
    }
    fold_error_ = 0;
    if (nodes.periods.any) {
        double largest = 0;
        const double* const x = nodes.positions.data();
        Kokkos::parallel_reduce(
            "search/groups/largest",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, nodes.n * Dim),
            [=](const Offset i, double& m) { m = std::max(m, std::fabs(x[i])); },
            Kokkos::Max<double>(largest));
        for (int d = 0; d < Dim; ++d) largest = std::max(largest, nodes.periods.length[d]);
        fold_error_ = 8 * std::numeric_limits<double>::epsilon() * largest;
    }
}

template class GroupBoxes<1>;
template class GroupBoxes<2>;
template class GroupBoxes<3>;

}  // namespace connectivity::detail
