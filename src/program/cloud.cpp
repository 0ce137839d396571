// SPDX-License-Identifier: BSD-3-Clause
#include "program/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace connectivity::program {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int n_clusters = 24;
constexpr double background = 0.25;  // share of nodes outside clusters
constexpr double inside = 0.95;  // a cluster is cut where it holds this share of a Plummer sphere
constexpr double n_neighbours = 60;     // wanted inside a support
constexpr double largest_reach = 0.45;  // below half the box

constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// k-th number of a seed in [0, 1).
double u01(std::uint64_t seed, std::uint64_t k) {
    return static_cast<double>(mix(seed + (k + 1) * 0x9E3779B97F4A7C15u) >> 11) * 0x1p-53;
}

/// Radius of a Plummer sphere of scale 1 that holds this share of its mass.
double plummer_radius(double share) { return 1 / std::sqrt(std::pow(share, -2.0 / 3.0) - 1); }

/// Share of a cluster of scale 1 within `reach` of a point at distance d from its centre: what lies
/// in shells wholly inside the ball, and the integral over the shells that the ball cuts.
double share_in_ball(double d, double reach) {
    static const double edge = plummer_radius(inside);
    const auto within = [](double s) { return s * s * s / std::pow(1 + s * s, 1.5); };
    const auto antiderivative = [&](double s) {
        const double q = 1 / std::sqrt(1 + s * s), q3 = q * q * q;
        return (d * d - reach * reach) * q3 / 3 + 2 * d * s * s * s * q3 / 3 + q - q3 / 3;
    };
    const double lo = std::abs(reach - d), hi = std::min(reach + d, edge);
    double share = reach > d ? within(std::min(reach - d, edge)) : 0;
    if (hi > lo && d > 1e-6 * reach) share += 0.75 / d * (antiderivative(hi) - antiderivative(lo));
    return share / inside;
}

struct Cluster {
    std::array<double, 3> centre;
    double scale, share;  // share: of all nodes in clusters, cumulative
};
using Clusters = std::array<Cluster, n_clusters>;

/// Sizes from 0.004 to 0.04 of the box, larger ones heavier.
Clusters make_clusters(std::uint64_t seed) {
    const std::uint64_t own_seed = mix(seed ^ 0x636C757374657273u);
    Clusters clusters{};
    double sum = 0;
    for (std::uint64_t c = 0; c < n_clusters; ++c) {
        auto& cluster = clusters[c];
        for (std::uint64_t d = 0; d < 3; ++d) cluster.centre[d] = u01(own_seed, 4 * c + d);
        cluster.scale = 0.004 * std::pow(10.0, u01(own_seed, 4 * c + 3));
        cluster.share = sum += std::pow(cluster.scale, 1.5);
    }
    for (auto& cluster : clusters) cluster.share /= sum;
    return clusters;
}

struct Cloud {
    Clusters clusters;
    std::uint64_t seed;
    double n;
    double *x, *h;

    void place(Offset p) const {
        const auto k = 4 * static_cast<std::uint64_t>(p);
        const double choice = u01(seed, k);
        const double u[3] = {u01(seed, k + 1), u01(seed, k + 2), u01(seed, k + 3)};
        if (choice < background) {
            for (int d = 0; d < 3; ++d) x[3 * p + d] = u[d];
            return;
        }
        const double pick = (choice - background) / (1 - background);
        std::size_t c = 0;
        while (c + 1 < n_clusters && clusters[c].share <= pick) ++c;
        const double r = clusters[c].scale * plummer_radius(inside * u[0]);
        const double z = 2 * u[1] - 1, s = std::sqrt(1 - z * z), phi = 2 * pi * u[2];
        const double direction[3] = {s * std::cos(phi), s * std::sin(phi), z};
        for (std::size_t d = 0; d < 3; ++d) {
            const double at = clusters[c].centre[d] + r * direction[d];
            x[3 * static_cast<std::size_t>(p) + d] = at - std::floor(at);
        }
    }

    /// Nodes expected within `reach` of a point.
    double expected(const double* at, double reach) const {
        double sum = background * 4 * pi / 3 * reach * reach * reach, before = 0;
        for (const auto& cluster : clusters) {
            const double weight = (1 - background) * (cluster.share - before);
            before = cluster.share;
            double d2 = 0;
            for (std::size_t d = 0; d < 3; ++d) {
                const double difference = at[d] - cluster.centre[d];
                const double nearest = difference - std::rint(difference);
                d2 += nearest * nearest;
            }
            sum += weight * share_in_ball(std::sqrt(d2) / cluster.scale, reach / cluster.scale);
        }
        return n * sum;
    }

    /// The reach at which the expected number is what is wanted: false position (Illinois) on its
    /// cube root, which is nearly linear.
    double solve(const double* at) const {
        const double wanted = std::cbrt(n_neighbours + 1);
        double lo = 0, hi = largest_reach, f_lo = -wanted,
               f_hi = std::cbrt(expected(at, hi)) - wanted;
        if (f_hi <= 0) return hi;
        for (int step = 0; step < 100 && hi - lo > 1e-6 * hi; ++step) {
            const double middle = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
            const double f = std::cbrt(expected(at, middle)) - wanted;
            if (std::abs(f) < 1e-6 * wanted) return middle;
            (f > 0 ? hi : lo) = middle;
            (f > 0 ? f_hi : f_lo) = f;
            (f > 0 ? f_lo : f_hi) *= 0.5;
        }
        return 0.5 * (lo + hi);
    }

    void operator()(const Offset p) const {
        place(p);
        h[p] = 0.5 * solve(x + 3 * p);
    }
};

}  // namespace

ListData make_cloud(Offset n, std::uint64_t seed) {
    if (n < 1)
        throw Error(Status::argument, fmt::format("a cloud of {} nodes: must have at least 1", n));
    if (n > max_slots)
        throw Error(Status::too_many,
                    fmt::format("a cloud of {} nodes: at most {} can be indexed", n, max_slots));
    auto x = allocate<double>("cloud/positions", 3 * n), h = allocate<double>("cloud/h", n);
    auto mass = allocate<double>("cloud/mass", n);
    Kokkos::deep_copy(mass, 1.0 / static_cast<double>(n));
    const Cloud cloud{make_clusters(seed), seed, static_cast<double>(n), x.data(), h.data()};
    Kokkos::parallel_for("program/cloud",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n), cloud);
    HostExec().fence();
    ListData list{NodeList::with_h("cloud", 3, n, x, h, 2.0)};
    list.mass = mass;
    return list;
}

Domain cloud_domain() {
    Domain domain;
    domain.periodic = {true, true, true};
    domain.hi = {1, 1, 1};
    return domain;
}

}  // namespace connectivity::program
