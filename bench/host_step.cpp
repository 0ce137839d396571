// SPDX-License-Identifier: BSD-3-Clause
#include "host_step.hpp"

#include <cmath>
#include <numbers>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::bench {
namespace {

template <int Dim>
double distance(const double* x, Offset i, Offset j) {
    double r2 = 0;
    for (int d = 0; d < Dim; ++d) {
        const double r = x[i * Dim + d] - x[j * Dim + d];
        r2 += r * r;
    }
    return std::sqrt(r2);
}

/// Cubic spline that ends at R.
template <int Dim>
double kernel(double r, double R) {
    constexpr double norm = Dim == 3 ? 8 / std::numbers::pi : 40 / (7 * std::numbers::pi);
    const double q = r / R, rest = 1 - q;
    if (q >= 1) return 0;
    return norm / (Dim == 3 ? R * R * R : R * R) *
           (q < 0.5 ? 1 - 6 * q * q * rest : 2 * rest * rest * rest);
}

template <int Dim>
class HostStep final : public Contestant {
public:
    HostStep(const Input& input, bool reordered) : input_(input) {
        const auto n = static_cast<std::size_t>(input.cloud.n);
        options_.rows = false;
        density_.resize(n), place_of_.resize(n);
        const std::vector<Slot> order = order_of(reordered);
        for (std::size_t k = 0; k < n; ++k)
            place_of_[static_cast<std::size_t>(order[k])] = static_cast<Slot>(k);
        R_ = laid(input.cloud.R.data(), order, 1);
        for (int state = 0; state <= input.n_moved(); ++state)
            x_.push_back(laid(input.x(state), order, Dim));
        for (const auto& x : x_) lists_.push_back({list_of(x.data(), R_.data())});
    }

    void place(int state) override { state_ = static_cast<std::size_t>(state); }

    void build() override {
        map_.rebuild(lists_[state_], options_);
        sum_density();
    }

    Offset n_row_entries() const override { return 0; }
    Offset n_pairs() const override { return map_.pairs().size(); }
    Offset result_bytes() const override {
        return n_pairs() * Offset{sizeof(Slot)} + (input_.cloud.n + 1) * Offset{sizeof(Offset)};
    }
    double check_ms() const override { return map_.report().find("nodes")->ms; }

    bool agrees(Offset node, const std::vector<Offset>& neighbours) const override {
        const double* const x = input_.x(static_cast<int>(state_));
        const double R = input_.cloud.R[static_cast<std::size_t>(node)];
        double density = kernel<Dim>(0, R);
        for (const Offset j : neighbours) density += kernel<Dim>(distance<Dim>(x, node, j), R);
        const auto at = static_cast<std::size_t>(place_of_[static_cast<std::size_t>(node)]);
        return std::abs(density_[at] - density) <= 1e-12 * density;
    }

private:
    NodeList list_of(const double* x, const double* R) const {
        const auto n = static_cast<std::size_t>(input_.cloud.n);
        return NodeList::with_h(input_.cloud.name, Dim, input_.cloud.n,
                                ConstView<double>(x, n * Dim), ConstView<double>(R, n), 1);
    }

    std::vector<Slot> order_of(bool reordered) const {
        std::vector<Slot> order(static_cast<std::size_t>(input_.cloud.n));
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Slot>(k);
        if (!reordered) return order;
        MapOptions options = options_;
        options.spatial_order = true;
        ConnectivityMap map;
        map.rebuild(std::vector{list_of(input_.x(0), input_.cloud.R.data())}, options);
        const auto slots = map.spatial_order();
        order.assign(slots.data(), slots.data() + slots.size());
        return order;
    }

    static std::vector<double> laid(const double* values, const std::vector<Slot>& order,
                                    int n_components) {
        std::vector<double> out(order.size() * static_cast<std::size_t>(n_components));
        reorder_field(ConstView<Slot>(order.data(), order.size()), values, out.data(),
                      n_components);
        return out;
    }

    void sum_density() {
        const auto pairs = map_.pairs().view();
        const double *const x = x_[state_].data(), *const R = R_.data();
        double* const density = density_.data();
        const Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>> nodes(0, input_.cloud.n);
        Kokkos::parallel_for("bench/density/self", nodes,
                             [=](const Offset i) { density[i] = kernel<Dim>(0, R[i]); });
        Kokkos::parallel_for("bench/density/pairs", nodes, [=](const Offset i) {
            double sum = 0;
            for (Offset k = pairs.offsets(i); k < pairs.offsets(i + 1); ++k) {
                const Offset j = pairs.j(k);
                const double r = distance<Dim>(x, i, j);
                sum += kernel<Dim>(r, R[i]);
                Kokkos::atomic_add(density + j, kernel<Dim>(r, R[j]));
            }
            Kokkos::atomic_add(density + i, sum);
        });
        HostExec().fence();
    }

    const Input& input_;
    MapOptions options_;
    std::vector<Slot> place_of_;  ///< of each of the caller's nodes
    std::vector<std::vector<double>> x_;
    std::vector<double> R_, density_;
    std::vector<std::vector<NodeList>> lists_;
    std::size_t state_ = 0;
    ConnectivityMap map_;
};

}  // namespace

std::unique_ptr<Contestant> make_host_step(const Input& input, bool reordered) {
    if (input.cloud.dim == 2) return std::make_unique<HostStep<2>>(input, reordered);
    return std::make_unique<HostStep<3>>(input, reordered);
}

}  // namespace connectivity::bench
