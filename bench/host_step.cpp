// SPDX-License-Identifier: BSD-3-Clause
#include "host_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::bench {
namespace {

template <int Dim>
double squared_distance(const double* x, Offset i, Offset j) {
    double r2 = 0;
    for (int d = 0; d < Dim; ++d) {
        const double r = x[i * Dim + d] - x[j * Dim + d];
        r2 += r * r;
    }
    return r2;
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
class HostStep : public Contestant {
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
        sum_density(x_[state_].data());
    }

    Offset n_row_entries() const override { return 0; }
    Offset n_pairs() const override { return map_.pairs().size(); }
    Offset result_bytes() const override {
        return map_.pairs().size() * Offset{sizeof(Slot)} +
               (input_.cloud.n + 1) * Offset{sizeof(Offset)};
    }
    double check_ms() const override { return map_.report().find("nodes")->ms; }

    bool agrees(Offset node, const std::vector<Offset>& neighbours) const override {
        const double* const x = input_.x(static_cast<int>(state_));
        const double R = input_.cloud.R[static_cast<std::size_t>(node)];
        double density = kernel<Dim>(0, R);
        for (const Offset j : neighbours)
            density += kernel<Dim>(std::sqrt(squared_distance<Dim>(x, node, j)), R);
        const auto at = static_cast<std::size_t>(place_of_[static_cast<std::size_t>(node)]);
        return std::abs(density_[at] - density) <= 1e-12 * density;
    }

protected:
    NodeList list_of(const double* x, const double* R) const {
        const auto n = static_cast<std::size_t>(input_.cloud.n);
        return NodeList::with_h(input_.cloud.name, Dim, input_.cloud.n,
                                ConstView<double>(x, n * Dim), ConstView<double>(R, n), 1);
    }

    void sum_density(const double* x) {
        const auto pairs = map_.pairs().view();
        const double* const R = R_.data();
        double* const density = density_.data();
        const Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>> nodes(0, input_.cloud.n);
        Kokkos::parallel_for("bench/density/self", nodes,
                             [=](const Offset i) { density[i] = kernel<Dim>(0, R[i]); });
        Kokkos::parallel_for("bench/density/pairs", nodes, [=](const Offset i) {
            double sum = 0;
            for (Offset k = pairs.offsets(i); k < pairs.offsets(i + 1); ++k) {
                const Offset j = pairs.j(k);
                const double r2 = squared_distance<Dim>(x, i, j), reach = std::max(R[i], R[j]);
                if (r2 > reach * reach) continue;  // in the skin
                const double r = std::sqrt(r2);
                sum += kernel<Dim>(r, R[i]);
                Kokkos::atomic_add(density + j, kernel<Dim>(r, R[j]));
            }
            Kokkos::atomic_add(density + i, sum);
        });
        HostExec().fence();
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

    const Input& input_;
    MapOptions options_;
    std::vector<Slot> place_of_;  ///< of each of the caller's nodes
    std::vector<std::vector<double>> x_;
    std::vector<double> R_, density_;
    std::vector<std::vector<NodeList>> lists_;
    std::size_t state_ = 0;
    ConnectivityMap map_;
};

/// A walk of many steps to the positions of the state: each node straight on in a direction of its
/// own, 0.05 of the mean support in ten steps. Pairs are rebuilt where their skin is used up.
template <int Dim>
class Walk final : public HostStep<Dim> {
public:
    Walk(const Input& input, double skin) : HostStep<Dim>(input, false) {
        const std::vector<double>& R = input.cloud.R;
        const double mean =
            std::accumulate(R.begin(), R.end(), 0.0) / static_cast<double>(R.size());
        this->options_.skin = skin * mean;
        step_ = displaced(input.cloud, 5);
        for (std::size_t k = 0; k < step_.size(); ++k)
            step_[k] = (step_[k] - input.cloud.x[k]) * mean / (10 * R[k / Dim]);
        x_ = step_;
        lists_ = {this->list_of(x_.data(), R.data())};
    }

    void build() override {
        n_rebuilds_ = 0;
        for (int left = n_steps(); left-- > 0;) {
            stand_before_end(left);
            if (this->map_.needs_rebuild(lists_)) {
                this->map_.rebuild(lists_, this->options_);
                ++n_rebuilds_;
            }
            this->sum_density(x_.data());
        }
    }

    int n_steps() const override { return 100; }
    int n_rebuilds() const override { return n_rebuilds_; }
    double check_ms() const override { return 0; }

    /// Those inside the support after the last step: without a skin, and where none is missed,
    /// all pairs of the state.
    Offset n_pairs() const override {
        const auto pairs = this->map_.pairs().view();
        const double *const x = x_.data(), *const R = this->R_.data();
        Offset n = 0;
        for (Offset i = 0; i < this->input_.cloud.n; ++i)
            for (Offset k = pairs.offsets(i); k < pairs.offsets(i + 1); ++k) {
                const double reach = std::max(R[i], R[pairs.j(k)]);
                n += squared_distance<Dim>(x, i, pairs.j(k)) <= reach * reach ? 1 : 0;
            }
        return n;
    }

private:
    void stand_before_end(int steps) {
        const double *const end = this->input_.x(static_cast<int>(this->state_)), *const step =
                                                                                      step_.data();
        double* const x = x_.data();
        Kokkos::parallel_for("bench/move",
                             Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(
                                 0, static_cast<Offset>(x_.size())),
                             [=](const Offset k) { x[k] = end[k] - steps * step[k]; });
        HostExec().fence();
    }

    std::vector<double> step_, x_;  ///< [n * Dim]
    std::vector<NodeList> lists_;
    int n_rebuilds_ = 0;
};

template <int Dim>
std::unique_ptr<Contestant> make(const Input& input, const std::string& variant) {
    if (is_walk(variant)) return std::make_unique<Walk<Dim>>(input, std::stod(variant.substr(4)));
    return std::make_unique<HostStep<Dim>>(input, variant == "reordered");
}

}  // namespace

bool is_walk(const std::string& variant) { return variant.rfind("skin", 0) == 0; }

bool is_host_step(const std::string& variant) {
    return variant == "step" || variant == "reordered" || is_walk(variant);
}

std::unique_ptr<Contestant> make_host_step(const Input& input, const std::string& variant) {
    return input.cloud.dim == 2 ? make<2>(input, variant) : make<3>(input, variant);
}

}  // namespace connectivity::bench
