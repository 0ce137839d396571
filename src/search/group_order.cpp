// SPDX-License-Identifier: BSD-3-Clause
#include "group_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

namespace {

constexpr int n_classes = 33;  // 32 by size, the last for nodes that see nobody
constexpr Offset samples_per_block = 32;

template <int Dim>
struct Point {
    double x[Dim];
    Slot slot;
};

/// Where a kd node splits: coordinate and slot, so that coincident nodes are divided too.
struct Split {
    double x;
    Slot slot;
    int axis;
};

template <int Dim>
bool is_before(const Point<Dim>& p, const Split& s) {
    return p.x[s.axis] < s.x || (p.x[s.axis] == s.x && p.slot < s.slot);
}

template <int Dim>
int widest_axis(const Point<Dim>* p, Offset n) {
    int widest = 0;
    double width = -1;
    for (int d = 0; d < Dim; ++d) {
        double lo = p[0].x[d], hi = lo;
        for (Offset i = 1; i < n; ++i) lo = std::min(lo, p[i].x[d]), hi = std::max(hi, p[i].x[d]);
        if (0.5 * hi - 0.5 * lo > width) width = 0.5 * hi - 0.5 * lo, widest = d;
    }
    return widest;
}

/// Puts the k smallest points along the widest axis first.
template <int Dim>
Split divide(Point<Dim>* p, Offset k, Offset n) {
    const int axis = widest_axis(p, n);
    std::nth_element(p, p + k, p + n, [axis](const Point<Dim>& a, const Point<Dim>& b) {
        return a.x[axis] < b.x[axis] || (a.x[axis] == b.x[axis] && a.slot < b.slot);
    });
    return {p[k].x[axis], p[k].slot, axis};
}

/// Splits points into leaves, by halves of whole leaves.
template <int Dim>
void order_leaves(Point<Dim>* p, Offset n) {
    if (n <= leaf_size) return;
    const Offset unit = n > 4 * leaf_size ? 4 * leaf_size : leaf_size;
    const Offset k = ((n + unit - 1) / unit + 1) / 2 * unit;
    divide(p, k, n);
    order_leaves(p, k);
    order_leaves(p + k, n - k);
}

double largest_finite_reach2(const ConstView<double>& reach2) {
    double largest = 0;
    Kokkos::parallel_reduce(
        "search/order/largest_reach", Kokkos::RangePolicy<HostExec>(0, reach2.size()),
        [=](const std::size_t i, double& m) {
            if (std::isfinite(reach2(i))) m = std::max(m, reach2(i));
        },
        Kokkos::Max<double>(largest));
    return largest;
}

/// Class of a support: a factor of 16 in squared reach each, counted down from the largest.
int class_of(double reach2, double largest) {
    if (reach2 < 0) return n_classes - 1;
    if (reach2 >= largest) return 0;
    const double level = std::log2(largest / reach2) / 4;
    return level < n_classes - 2 ? static_cast<int>(level) : n_classes - 2;
}

std::vector<std::vector<Slot>> classify(const ConstView<double>& reach2, Offset n) {
    std::vector<std::vector<Slot>> classes(n_classes);
    const double largest = largest_finite_reach2(reach2);
    for (Offset i = 0; i < n; ++i)
        classes[class_of(reach2(i), largest)].push_back(static_cast<Slot>(i));
    return classes;
}

/// Orders the nodes of one class into the blocks of a kd-tree that was found from a strided sample.
template <int Dim>
class ClassOrder {
public:
    ClassOrder(const SearchNodes<Dim>& nodes, const std::vector<Slot>& slots)
        : nodes_(nodes), slots_(slots) {
        while ((size() + n_blocks_ - 1) / n_blocks_ > block_size) n_blocks_ *= 2, ++levels_;
    }

    void append_to(GroupOrder& order, std::vector<Slot>& out) {
        find_splits();
        sort_into_blocks();
        for_each_dynamic("search/order/leaves", n_blocks_, [this](int, Offset b) {
            order_leaves(sorted_.data() + first_[b], first_[b + 1] - first_[b]);
        });
        order.trees.push_back({n_blocks_, order.n_blocks(), order.n_tree_nodes});
        order.n_tree_nodes += 2 * n_blocks_;
        for (Offset b = 0; b < n_blocks_; ++b) {
            for (Offset k = first_[b]; k < first_[b + 1]; ++k) out.push_back(sorted_[k].slot);
            while (out.size() % leaf_size != 0) out.push_back(-1);
            order.block_leaf.push_back(static_cast<Offset>(out.size()) / leaf_size);
        }
    }

private:
    Offset size() const { return static_cast<Offset>(slots_.size()); }

    Point<Dim> point(Offset k) const {
        Point<Dim> p;
        p.slot = slots_[k];
        for (int d = 0; d < Dim; ++d) p.x[d] = folded(nodes_, p.slot, d);
        return p;
    }

    void find_splits() {
        const Offset n = std::min(size(), samples_per_block * n_blocks_);
        std::vector<Point<Dim>> sample(n);
        for (Offset k = 0; k < n; ++k) sample[k] = point(k * size() / n);
        splits_.resize(n_blocks_);
        for (Offset nodes = 1; nodes < n_blocks_; nodes *= 2)  // a level at a time
            for_each_dynamic("search/order/splits", nodes, [&](int, Offset at) {
                const Offset begin = at * n / nodes, end = (at + 1) * n / nodes,
                             middle = (2 * at + 1) * n / (2 * nodes);
                splits_[nodes + at] = divide(sample.data() + begin, middle - begin, end - begin);
            });
    }

    Offset block_of(const Point<Dim>& p) const {
        Offset node = 1;
        for (int level = 0; level < levels_; ++level)
            node = 2 * node + (is_before(p, splits_[node]) ? 0 : 1);
        return node - n_blocks_;
    }

    /// Counting sort by block; chunks keep their order, so the result is independent of threads.
    void sort_into_blocks() {
        const Offset n = size(), chunks = 4 * static_cast<Offset>(n_workers());
        std::vector<Slot> block(n);
        std::vector<Offset> count(chunks * n_blocks_, 0);
        for_each_dynamic("search/order/count", chunks, [&](int, Offset c) {
            for (Offset k = n * c / chunks; k < n * (c + 1) / chunks; ++k) {
                block[k] = static_cast<Slot>(block_of(point(k)));
                ++count[c * n_blocks_ + block[k]];
            }
        });
        first_.assign(n_blocks_ + 1, 0);
        Offset sum = 0;
        for (Offset b = 0; b < n_blocks_; ++b) {
            first_[b] = sum;
            for (Offset c = 0; c < chunks; ++c) {
                const Offset length = count[c * n_blocks_ + b];
                count[c * n_blocks_ + b] = sum;
                sum += length;
            }
        }
        first_[n_blocks_] = sum;
        sorted_.resize(n);
        for_each_dynamic("search/order/move", chunks, [&](int, Offset c) {
            for (Offset k = n * c / chunks; k < n * (c + 1) / chunks; ++k)
                sorted_[count[c * n_blocks_ + block[k]]++] = point(k);
        });
    }

    const SearchNodes<Dim>& nodes_;
    const std::vector<Slot>& slots_;
    Offset n_blocks_ = 1;
    int levels_ = 0;
    std::vector<Split> splits_;       // [n_blocks], heap order
    std::vector<Offset> first_;       // [n_blocks + 1]
    std::vector<Point<Dim>> sorted_;  // by block
};

}  // namespace

Offset GroupOrder::bytes() const {
    return static_cast<Offset>(slot.size() * sizeof(Slot) + block_leaf.size() * sizeof(Offset));
}

template <int Dim>
GroupOrder order_groups(const SearchNodes<Dim>& nodes) {
    GroupOrder order;
    order.n = nodes.n;
    order.block_leaf.push_back(0);
    std::vector<Slot> slots;
    slots.reserve(nodes.n + nodes.n / 16 + leaf_size);
    try {
        for (const auto& members : classify(nodes.reach2, nodes.n))
            if (!members.empty()) ClassOrder<Dim>(nodes, members).append_to(order, slots);
    } catch (const std::bad_alloc&) {
        throw_allocation_failed("search/order", nodes.n, sizeof(Point<Dim>), "out of memory");
    }
    order.slot = allocate<Slot>("search/order/slot", static_cast<Offset>(slots.size()));
    std::copy(slots.begin(), slots.end(), order.slot.data());
    return order;
}

template GroupOrder order_groups<1>(const SearchNodes<1>&);
template GroupOrder order_groups<2>(const SearchNodes<2>&);
template GroupOrder order_groups<3>(const SearchNodes<3>&);

}  // namespace connectivity::detail
