// SPDX-License-Identifier: BSD-3-Clause
// The oracle for periodic boxes against what is known of crystals, and against itself where
// Ewald's parameter moves the work.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <support/ewald_brute.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

using Lengths = std::array<double, 3>;

const Lengths cube{1, 1, 1}, rod{1, 1, 2}, slab{1, 3, 10};

std::vector<double> random_positions(const Lengths& lengths, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> x;
    for (std::size_t i = 0; i < 3 * n; ++i) x.push_back(random.uniform(0, lengths[i % 3]));
    return x;
}

TEST(EwaldBrute, madelung_constant_of_sodium_chloride) {
    std::vector<double> x, charge;
    for (int i = 0; i < 8; ++i) {
        const int at[3] = {i & 1, (i >> 1) & 1, i >> 2};
        x.insert(x.end(), at, at + 3);
        charge.push_back((at[0] + at[1] + at[2]) % 2 == 0 ? 1 : -1);
    }
    const EwaldSums sums = ewald_brute({2, 2, 2}, x, charge, x);
    for (int i = 0; i < 8; ++i) {
        EXPECT_NEAR(sums.p[i] * charge[i], -1.747564594633182190, 2e-15);
        for (int d = 0; d < 3; ++d) EXPECT_NEAR(sums.a[3 * i + d], 0, 1e-15);
    }
}

TEST(EwaldBrute, madelung_constant_of_cesium_chloride) {
    const std::vector<double> x{0, 0, 0, 0.5, 0.5, 0.5}, charge{1, -1};
    const EwaldSums sums = ewald_brute(cube, x, charge, x);
    for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(sums.p[i] * charge[i] * std::sqrt(0.75), -1.762674773070988, 2e-15);
}

TEST(EwaldBrute, one_particle_in_its_background) {
    for (const double length : {1e-12, 1.0, 1e12}) {
        const EwaldSums sums =
            ewald_brute({length, length, length}, {0, length, length / 2}, {3}, {0, 0, length / 2});
        EXPECT_NEAR(sums.p[0] * length / 3, -2.8372974794806195, 4e-15);
    }
}

TEST(EwaldBrute, splitting_changes_nothing) {
    for (const Lengths& lengths : {cube, rod, slab}) {
        const std::vector<double> y = random_positions(lengths, 12, 1), m(12, 1.0 / 12);
        const std::vector<double> x = random_positions(lengths, 12, 2);
        const EwaldSums a = ewald_brute(lengths, y, m, x, 2.0), b = ewald_brute(lengths, y, m, x);
        for (std::size_t i = 0; i < a.p.size(); ++i) EXPECT_NEAR(a.p[i], b.p[i], 2e-14);
        for (std::size_t i = 0; i < a.a.size(); ++i) EXPECT_NEAR(a.a[i], b.a[i], 1e-13);
    }
}

TEST(EwaldBrute, acceleration_is_the_gradient_of_the_potential) {
    const std::vector<double> y = random_positions(slab, 5, 3), m{1, -2, 3, 0, 1};
    const std::vector<double> x{0.3, 1.1, 7.5};
    const EwaldSums at = ewald_brute(slab, y, m, x);
    for (int d = 0; d < 3; ++d) {
        std::vector<double> before = x, after = x;
        before[d] -= 1e-5;
        after[d] += 1e-5;
        const double slope =
            (ewald_brute(slab, y, m, after).p[0] - ewald_brute(slab, y, m, before).p[0]) / 2e-5;
        EXPECT_NEAR(at.a[d], slope, 1e-7 * std::abs(slope) + 1e-8);
    }
}

TEST(EwaldBrute, mean_of_the_potential_over_the_box_is_zero) {
    // Only then is the sum over a lattice of n³ points the potential in a box n times smaller.
    const int n = 4;
    std::vector<double> x;
    for (int i = 0; i < n * n * n; ++i)
        x.insert(x.end(), {0.1 + (i % n) / double(n), 0.2 + i / n % n / double(n),
                           0.05 + i / (n * n) / double(n)});
    const EwaldSums sums = ewald_brute(cube, {0, 0, 0}, {1}, x);
    const EwaldSums fine = ewald_brute({0.25, 0.25, 0.25}, {0, 0, 0}, {1}, {0.1, 0.2, 0.05});
    EXPECT_NEAR(std::accumulate(sums.p.begin(), sums.p.end(), 0.0), fine.p[0], 1e-13);
}

}  // namespace
}  // namespace connectivity::test
