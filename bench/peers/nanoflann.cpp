// SPDX-License-Identifier: BSD-3-Clause
/// nanoflann, used as well as its interface allows. Double precision; compressed sparse rows.
///
/// A kd-tree with leaves of 32 over a copy of the points in the tree order of the build before;
/// queries in that order, by all threads; results in per-thread buffers, then counted and copied
/// into compressed sparse rows. Pairs: the node with the larger (R, number) owns a pair, so one
/// gather per node finds each pair once; half rows are left unsorted. Rows: for a constant R one
/// gather per node, sorted; for a variable R the owned pairs are mirrored, then sorted.

#include "peer.hpp"

#include <algorithm>
#include <numeric>

#include <nanoflann.hpp>

#include <connectivity/base/parallel.hpp>

namespace connectivity::bench {
namespace {

/// Points as nanoflann reads them.
template <int Dim>
struct Points {
    std::vector<double> x;
    std::size_t kdtree_get_point_count() const { return x.size() / Dim; }
    double kdtree_get_pt(std::size_t k, int d) const {
        return x[k * Dim + static_cast<std::size_t>(d)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

template <int Dim>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points<Dim>>,
                                                 Points<Dim>, Dim, std::uint32_t>;

/// Points in the order of the tree's leaves; the member has had two names.
template <class T>
const auto& leaf_order(const T& tree) {
    if constexpr (requires { tree.vAcc_; })
        return tree.vAcc_;
    else
        return tree.vAcc;
}

template <class T, class Result>
void query(const T& tree, Result& result, const double* x) {
    if constexpr (requires { tree.findNeighbors(result, x); })
        tree.findNeighbors(result, x);
    else
        tree.findNeighbors(result, x, nanoflann::SearchParams());
}

/// Takes the neighbours of one node inside the closed ball.
template <class Accept>
struct ClosedBall {
    double R2;
    const Accept& accept;
    std::vector<Slot>& found;

    /// The tree compares with <; the margin keeps the boundary, which addPoint decides.
    double worstDist() const { return R2 * (1 + 1e-12); }
    bool addPoint(double r2, std::uint32_t k) {
        if (r2 <= R2) accept(k, found);
        return true;
    }
    bool full() const { return true; }
    std::size_t size() const { return found.size(); }
    void sort() {}
};

/// Neighbours of consecutive queries of one thread.
struct Buffer {
    std::vector<Slot> slots;
};

/// Where the neighbours of a node lie.
struct Found {
    int worker = 0;
    Slot length = 0;
    Offset first = 0;
};

template <int Dim>
class Nanoflann final : public PeerContestant {
public:
    Nanoflann(const Input& input, Form form)
        : PeerContestant(input, form, true), w_(input.cloud), rows_(rows()) {
        order_.resize(static_cast<std::size_t>(w_.n));
        std::iota(order_.begin(), order_.end(), Slot{0});
        found_.resize(order_.size());
        buffers_.resize(static_cast<std::size_t>(n_workers()));
    }

    void build() override {
        sort_points();
        const Tree<Dim> tree(Dim, points_, nanoflann::KDTreeSingleIndexAdaptorParams(32));
        const bool mirrored = rows_ && !w_.constant_R;
        for (Buffer& buffer : buffers_) buffer.slots.clear();
        for_each_dynamic(
            "bench/nanoflann/query", (w_.n + chunk - 1) / chunk, [&](int worker, Offset c) {
                for (Offset k = c * chunk; k < std::min(w_.n, (c + 1) * chunk); ++k)
                    rows_&& w_.constant_R ? gather(tree, worker, k) : own(tree, worker, k);
            });
        mirrored ? mirror() : collect();
        remember_order(tree);
    }

    Offset result_bytes() const override {
        return static_cast<Offset>(n_values_ * sizeof(Slot) + offsets_.size() * sizeof(Offset));
    }

protected:
    Offset n_entries() const override { return static_cast<Offset>(n_values_); }
    std::vector<Offset> partners(Offset node) const override {
        return partners_in(offsets_.data(), values_.get(), w_.n, node, !rows_);
    }

private:
    static constexpr Offset chunk = 256;

    double R(Slot slot) const { return w_.R[static_cast<std::size_t>(slot)]; }
    Slot label(Offset k) const { return order_[static_cast<std::size_t>(k)]; }

    void sort_points() {
        points_.x.resize(w_.x.size());
        for_each_dynamic("bench/nanoflann/sort", (w_.n + chunk - 1) / chunk, [&](int, Offset c) {
            for (Offset k = c * chunk; k < std::min(w_.n, (c + 1) * chunk); ++k)
                std::copy_n(x() + label(k) * Offset{Dim}, Dim,
                            &points_.x[static_cast<std::size_t>(k) * Dim]);
        });
    }

    /// The next build finds its points in this tree's order.
    void remember_order(const Tree<Dim>& tree) {
        const auto& leaves = leaf_order(tree);
        std::vector<Slot> order(order_.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = order_[leaves[k]];
        order_.swap(order);
    }

    template <class Accept>
    void search(const Tree<Dim>& tree, int worker, Offset k, double radius, const Accept& accept) {
        auto& slots = buffers_[static_cast<std::size_t>(worker)].slots;
        const auto first = static_cast<Offset>(slots.size());
        ClosedBall<Accept> ball{radius * radius, accept, slots};
        query(tree, ball, &points_.x[static_cast<std::size_t>(k) * Dim]);
        found_[static_cast<std::size_t>(label(k))] = {
            worker, static_cast<Slot>(static_cast<Offset>(slots.size()) - first), first};
    }

    void gather(const Tree<Dim>& tree, int worker, Offset k) {
        const auto self = static_cast<std::uint32_t>(k);
        search(tree, worker, k, R(label(k)),
               [this, self](std::uint32_t other, std::vector<Slot>& found) {
                   if (other != self) found.push_back(order_[other]);
               });
        const Found& row = found_[static_cast<std::size_t>(label(k))];
        auto& slots = buffers_[static_cast<std::size_t>(worker)].slots;
        std::sort(slots.begin() + row.first, slots.end());
    }

    void own(const Tree<Dim>& tree, int worker, Offset k) {
        const Slot i = label(k);
        const double radius = R(i);
        search(tree, worker, k, radius,
               [this, i, radius](std::uint32_t other, std::vector<Slot>& found) {
                   const Slot j = order_[other];
                   const double theirs = w_.constant_R ? radius : R(j);
                   if (theirs < radius || (theirs == radius && j < i)) found.push_back(j);
               });
    }

    const Slot* found(Offset i) const {
        const Found& row = found_[static_cast<std::size_t>(i)];
        return buffers_[static_cast<std::size_t>(row.worker)].slots.data() + row.first;
    }

    void allocate(const std::vector<Offset>& lengths) {
        offsets_.resize(lengths.size() + 1);
        offsets_[0] = 0;
        std::partial_sum(lengths.begin(), lengths.end(), offsets_.begin() + 1);
        n_values_ = static_cast<std::size_t>(offsets_.back());
        if (n_values_ > capacity_) {
            values_ = std::make_unique_for_overwrite<Slot[]>(n_values_);
            capacity_ = n_values_;
        }
    }

    void collect() {
        lengths_.resize(found_.size());
        for (std::size_t i = 0; i < found_.size(); ++i) lengths_[i] = found_[i].length;
        allocate(lengths_);
        for_each_dynamic("bench/nanoflann/copy", (w_.n + chunk - 1) / chunk, [&](int, Offset c) {
            for (Offset i = c * chunk; i < std::min(w_.n, (c + 1) * chunk); ++i)
                std::copy_n(found(i), found_[static_cast<std::size_t>(i)].length,
                            values_.get() + offsets_[static_cast<std::size_t>(i)]);
        });
    }

    /// Both directions of every owned pair; then each row is sorted.
    void mirror() {
        lengths_.assign(found_.size(), 0);
        Offset* const length = lengths_.data();
        for_each_dynamic("bench/nanoflann/count", (w_.n + chunk - 1) / chunk, [&](int, Offset c) {
            for (Offset i = c * chunk; i < std::min(w_.n, (c + 1) * chunk); ++i) {
                const Slot n = found_[static_cast<std::size_t>(i)].length;
                Kokkos::atomic_fetch_add(length + i, Offset{n});
                for (Slot k = 0; k < n; ++k)
                    Kokkos::atomic_fetch_add(length + found(i)[k], Offset{1});
            }
        });
        allocate(lengths_);
        std::copy(offsets_.begin(), offsets_.end() - 1,
                  lengths_.begin());  // now where the next entry goes
        for_each_dynamic("bench/nanoflann/mirror", (w_.n + chunk - 1) / chunk, [&](int, Offset c) {
            for (Offset i = c * chunk; i < std::min(w_.n, (c + 1) * chunk); ++i) {
                const Slot n = found_[static_cast<std::size_t>(i)].length;
                std::copy_n(found(i), n,
                            values_.get() + Kokkos::atomic_fetch_add(length + i, Offset{n}));
                for (Slot k = 0; k < n; ++k)
                    values_[static_cast<std::size_t>(Kokkos::atomic_fetch_add(
                        length + found(i)[k], Offset{1}))] = static_cast<Slot>(i);
            }
        });
        for_each_dynamic(
            "bench/nanoflann/sort_rows", (w_.n + chunk - 1) / chunk, [&](int, Offset c) {
                for (Offset i = c * chunk; i < std::min(w_.n, (c + 1) * chunk); ++i)
                    std::sort(values_.get() + offsets_[static_cast<std::size_t>(i)],
                              values_.get() + offsets_[static_cast<std::size_t>(i) + 1]);
            });
    }

    const test::Workload& w_;
    bool rows_;
    Points<Dim> points_;
    std::vector<Slot> order_;  ///< caller's number of each sorted point
    std::vector<Found> found_;
    std::vector<Buffer> buffers_;
    std::vector<Offset> lengths_, offsets_;
    std::unique_ptr<Slot[]> values_;
    std::size_t n_values_ = 0, capacity_ = 0;
};

/// It has no tensors, which A8 is about.
bool takes_part(const CaseName& c) { return c.form != "both" && c.workload != "A8"; }

std::unique_ptr<Contestant> make(const Input& input, Form form) {
    if (input.cloud.dim == 2) return std::make_unique<Nanoflann<2>>(input, form);
    return std::make_unique<Nanoflann<3>>(input, form);
}

}  // namespace

std::vector<Peer> nanoflann_peers() {
    return {{"nanoflann", "double; compressed rows, sorted, or half rows, unsorted", true,
             takes_part, make}};
}

}  // namespace connectivity::bench
