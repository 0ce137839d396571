// SPDX-License-Identifier: BSD-3-Clause
#include "pair_sums.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <connectivity/map/pair_sum.hpp>

namespace connectivity::bench {
namespace {

/// Some value of a pair that has no other symmetry than i <-> j.
double value_of(const double* x, int dim, Offset i, Offset j) {
    double r2 = 0;
    for (int d = 0; d < dim; ++d)
        r2 += (x[i * dim + d] - x[j * dim + d]) * (x[i * dim + d] - x[j * dim + d]);
    return std::sqrt(r2);
}

class PairSums final : public Contestant {
public:
    PairSums(const Input& input, const std::string& way) : input_(input), way_(way) {
        options_.rows = way == "sumrows";
        const auto n = static_cast<std::size_t>(input.cloud.n);
        order_.resize(n), place_of_.resize(n),
            x_.resize(n * static_cast<std::size_t>(input.cloud.dim));
        std::iota(order_.begin(), order_.end(), 0);
        lay(0);
        MapOptions options = options_;
        options.spatial_order = true;
        map_.rebuild(std::vector{list()}, options);
        const auto slots = map_.spatial_order();
        order_.assign(slots.data(), slots.data() + slots.size());
        for (std::size_t k = 0; k < n; ++k)
            place_of_[static_cast<std::size_t>(order_[k])] = static_cast<Slot>(k);
        sums_ = View<double>("bench/sums", n);
        place(0);
    }

    void place(int state) override {
        state_ = state;
        lay(state);
        map_.rebuild(std::vector{list()}, options_);
        field_.reset(map_.pairs());
        const auto pairs = map_.pairs().view();
        const auto values = field_.view();
        const double* const x = x_.data();
        const int dim = input_.cloud.dim;
        Kokkos::parallel_for(
            "bench/values",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, pairs.n_slots()),
            [=](const Offset i) {
                for (Offset k = pairs.offsets(i); k < pairs.offsets(i + 1); ++k)
                    values[k] = value_of(x, dim, i, pairs.j(k));
            });
        HostExec().fence();
        if (way_ == "sumrows") row_pairs_.rebuild(map_);
        if (way_ == "sumcolours") colours_.rebuild(map_.pairs());
    }

    void build() override {
        const auto pairs = map_.pairs().view();
        const auto values = symmetric(field_.view(map_.pairs()));
        Kokkos::deep_copy(sums_, 0.0);
        if (way_ == "sumrows")
            add_pairs_by_rows(HostExec(), row_pairs_.view(map_), values, sums_);
        else if (way_ == "sumcolours")
            add_pairs_by_colours(HostExec(), colours_, pairs, values, sums_);
        else
            add_pairs_atomically(HostExec(), pairs, values, sums_);
    }

    Offset n_row_entries() const override { return 0; }
    Offset n_pairs() const override { return map_.pairs().size(); }
    Offset result_bytes() const override { return input_.cloud.n * Offset{sizeof(double)}; }

    bool agrees(Offset node, const std::vector<Offset>& neighbours) const override {
        double sum = 0;
        for (const Offset j : neighbours)
            sum += value_of(input_.x(state_), input_.cloud.dim, node, j);
        const double got = sums_(place_of_[static_cast<std::size_t>(node)]);
        return std::abs(got - sum) <= 1e-12 * sum;
    }

private:
    NodeList list() const {
        const auto n = static_cast<std::size_t>(input_.cloud.n);
        return NodeList::with_h(input_.cloud.name, input_.cloud.dim, input_.cloud.n,
                                ConstView<double>(x_.data(), x_.size()),
                                ConstView<double>(R_.data(), n), 1);
    }
    /// The nodes of a state, in order_.
    void lay(int state) {
        R_.resize(order_.size());
        const ConstView<Slot> order(order_.data(), order_.size());
        reorder_field(order, input_.x(state), x_.data(), input_.cloud.dim);
        reorder_field(order, input_.cloud.R.data(), R_.data());
    }

    const Input& input_;
    std::string way_;
    MapOptions options_;
    std::vector<Slot> order_, place_of_;
    std::vector<double> x_, R_;
    int state_ = 0;
    ConnectivityMap map_;
    PairwiseField<double> field_;
    RowPairs row_pairs_;
    PairColours colours_;
    View<double> sums_;
};

}  // namespace

bool is_pair_sum(const std::string& variant) { return variant.rfind("sum", 0) == 0; }

std::unique_ptr<Contestant> make_pair_sums(const Input& input, const std::string& variant) {
    return std::make_unique<PairSums>(input, variant);
}

}  // namespace connectivity::bench
