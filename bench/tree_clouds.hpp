// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Clouds of particles that the benchmarks of box trees and of interaction lists share.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <connectivity/base/types.hpp>

#include <support/random.hpp>

namespace connectivity::bench {

using test::Random;

using Point = std::array<double, 3>;

inline double normal(Random& random) {
    return std::sqrt(-2 * std::log(1 - random.uniform())) *
           std::cos(2 * std::numbers::pi * random.uniform());
}

inline Point uniform(Random& random) {
    return {random.uniform(), random.uniform(), random.uniform()};
}

inline Point plummer(Random& random) {
    double radius = 0;
    do radius = 1 / std::sqrt(std::pow(1 - random.uniform(), -2.0 / 3) - 1);
    while (!(radius < 50));
    const double z = random.uniform(-1, 1), angle = 2 * std::numbers::pi * random.uniform(),
                 rho = std::sqrt(1 - z * z);
    return {radius * rho * std::cos(angle), radius * rho * std::sin(angle), radius * z};
}

inline Point clusters(Random& random) {
    const bool first = random.chance(0.5);
    const double sigma = first ? 1e-3 : 1e-2, at = first ? 0.25 : 0.75;
    return {at + sigma * normal(random), at + sigma * normal(random), at + sigma * normal(random)};
}

inline std::vector<double> cloud(Point (*point)(Random&), Offset n, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> x;
    for (Offset i = 0; i < n; ++i) {
        const Point p = point(random);
        x.insert(x.end(), p.begin(), p.end());
    }
    return x;
}

/// Radii of n targets: 2^U(-12,-2).
inline std::vector<double> wide_radii(Offset n) {
    std::vector<double> r(n);
    for (Offset i = 0; i < n; ++i) r[i] = std::exp2(-12 + 10 * test::u01(3, i));
    return r;
}

}  // namespace connectivity::bench
