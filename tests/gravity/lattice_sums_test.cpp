// SPDX-License-Identifier: BSD-3-Clause
// Lattice sums of harmonics against Ewald's sum, the kernels against sums in complex numbers, and
// the wrapping of positions.

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <gravity/lattice_kernels.hpp>
#include <gravity/lattice_sums.hpp>
#include <gravity/lattice_wrap.hpp>
#include <support/ewald_brute.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

using detail::LatticeSums;
using Vector = std::array<double, 3>;
using Complex = std::complex<double>;

constexpr int order = 20, n_terms = (order + 1) * (order + 1);
const std::vector<Vector> boxes{{1, 1, 1}, {1, 1, 2}, {1, 3, 10}, {1, 10, 10}, {1, 1, 10}};

std::vector<LatticeSums::Image> images_within(int n) {
    std::vector<LatticeSums::Image> images;
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
            for (int k = -n; k <= n; ++k) images.push_back({i, j, k});
    return images;
}

/// Ewald's potential at distance r without near images and the background's square.
double far_part(const Vector& box, const Vector& r, const std::vector<LatticeSums::Image>& near) {
    double square = 0;
    for (int d = 0; d < 3; ++d) square += r[d] * r[d];
    long double h = ewald_brute(box, {0, 0, 0}, {1}, {r[0], r[1], r[2]}).p[0];
    h -= 2 * std::numbers::pi / (3 * box[0] * box[1] * box[2]) * square;
    for (const auto& image : near)
        h -= 1 / std::hypot(r[0] - image[0] * box[0], r[1] - image[1] * box[1],
                            r[2] - image[2] * box[2]);
    return static_cast<double>(h);
}

/// sum_nm conj(R_nm(y)) T_nm.
double series(const double* sums, const Vector& y) {
    double harmonics[n_terms], sum = 0;
    detail::regular_harmonics(y.data(), order, harmonics);
    for (int n = 0; n <= order; ++n)
        for (int i = n * n; i < (n + 1) * (n + 1); ++i)
            sum += (i == n * n ? 1 : 2) * harmonics[i] * sums[i];
    return sum;
}

TEST(LatticeSums, are_the_expansion_of_ewalds_potential_about_any_point) {
    const auto near = images_within(1);
    for (const Vector& box : boxes) {
        const LatticeSums lattice(box, near, order);
        for (const Vector& part : {Vector{0, 0, 0}, {0.75, -0.5, 0.25}, {0, -1, 0.125}}) {
            const Vector d{part[0] * box[0], part[1] * box[1], part[2] * box[2]};
            double sums[n_terms];
            lattice.at(d, order, sums);
            for (const Vector& y : {Vector{0, 0, 0}, {0.1, 0.05, -0.12}, {0, -0.1, 0.1}}) {
                const double wanted = far_part(box, {d[0] - y[0], d[1] - y[1], d[2] - y[2]}, near);
                EXPECT_NEAR(series(sums, y), wanted, 1e-13 * std::abs(wanted) + 3e-14);
            }
        }
    }
}

TEST(LatticeSums, of_a_cube_have_its_symmetry) {
    const LatticeSums lattice({1, 1, 1}, images_within(1), order);
    double sums[n_terms];
    lattice.at({0, 0, 0}, order, sums);
    for (int i = 1; i < 16; ++i) EXPECT_NEAR(sums[i], 0, 1e-13) << i;
    // Degree 4: the cubic harmonic, as the sum over many shells of far images gives it.
    double wanted = 0;
    for (int i = -60; i <= 60; ++i)
        for (int j = -60; j <= 60; ++j)
            for (int k = -60; k <= 60; ++k) {
                const double r2 = i * i + j * j + k * k, z = k;
                if (std::max({std::abs(i), std::abs(j), std::abs(k)}) <= 1) continue;
                wanted +=
                    3 * (35 * std::pow(z, 4) - 30 * z * z * r2 + 3 * r2 * r2) / std::pow(r2, 4.5);
            }
    EXPECT_NEAR(sums[16], wanted, 1e-3 * std::abs(wanted));
    EXPECT_NEAR(sums[23], 5 * sums[16], 1e-12 * std::abs(wanted));
}

/// Coefficient of any m in the layout of expansions, n_lanes apart.
Complex coefficient(const double* c, int n, int m, int lanes = 1, int lane = 0) {
    const int a = std::abs(m);
    const double re = c[(a == 0 ? n * n : n * n + 2 * a - 1) * lanes + lane];
    const Complex value(re, a == 0 ? 0 : c[(n * n + 2 * a) * lanes + lane]);
    return m >= 0 ? value : (a % 2 == 0 ? 1.0 : -1.0) * std::conj(value);
}

void expect_all_terms(detail::LatticeKernel kernel, int to_order) {
    const int lanes = detail::n_reflections, n = (to_order + 1) * (to_order + 1);
    Random random(5);
    std::vector<double> sums(n), moments(n * lanes), locals(n * lanes, 0.5);
    for (double& value : sums) value = random.uniform(-1, 1);
    for (double& value : moments) value = random.uniform(-1, 1);
    kernel(to_order, sums.data(), moments.data(), locals.data());
    for (int lane = 0; lane < lanes; ++lane)
        for (int j = 0; j <= to_order; ++j)
            for (int q = 0; q <= j; ++q) {
                Complex wanted = 0;
                for (int k = 0; j + k <= to_order; ++k)
                    for (int l = -k; l <= k; ++l)
                        wanted += std::conj(coefficient(moments.data(), k, l, lanes, lane)) *
                                  coefficient(sums.data(), j + k, l + q);
                wanted *= j % 2 == 0 ? 1 : -1;
                const Complex half(0.5, q == 0 ? 0 : 0.5);
                const Complex found = coefficient(locals.data(), j, q, lanes, lane) - half;
                ASSERT_NEAR(std::abs(found - wanted), 0, 1e-12) << j << ' ' << q << ' ' << lane;
            }
}

TEST(LatticeKernels, add_every_term_up_to_the_order) {
    for (const int to_order : {0, 1, 2, 7, 12, 20}) {
        expect_all_terms(detail::lattice_kernel_portable, to_order);
        expect_all_terms(detail::lattice_kernel(), to_order);
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
            expect_all_terms(detail::lattice_kernel_avx2, to_order);
#endif
    }
}

TEST(WrapIntoBox, keeps_what_is_in_the_box_and_moves_the_far_end_to_the_near_one) {
    EXPECT_EQ(detail::wrap_into_box(2.5, 2, 3), 0.5);
    EXPECT_EQ(detail::wrap_into_box(2, 2, 3), 0);
    EXPECT_EQ(detail::wrap_into_box(5, 2, 3), 0);
    EXPECT_EQ(detail::wrap_into_box(std::nextafter(5, 0), 2, 3), std::nextafter(5, 0) - 2);
    EXPECT_EQ(detail::wrap_into_box(1.5, 2, 3), 2.5);
    EXPECT_EQ(detail::wrap_into_box(-9.75, 2, 3), 0.25);
    EXPECT_EQ(detail::wrap_into_box(-1e-300, 0, 1), 0);
}

TEST(WrapIntoBox, is_in_the_box_from_any_distance) {
    Random random(9);
    for (int i = 0; i < 20000; ++i) {
        const double length = random.log_uniform(1e-12, 1e12);
        const double lo = random.uniform(-1, 1) * random.log_uniform(1e-12, 1e13);
        const double x = random.uniform(-1, 1) * random.log_uniform(1e-12, 1e300);
        const double r = detail::wrap_into_box(x, lo, length);
        ASSERT_TRUE(r >= 0 && r < length) << x << ' ' << lo << ' ' << length << ' ' << r;
    }
    const double huge = std::numeric_limits<double>::max();
    const double r = detail::wrap_into_box(huge, -huge, 0.3);
    EXPECT_TRUE(r >= 0 && r < 0.3);
}

TEST(WrapIntoBox, moves_by_whole_lengths) {
    // A float times any number of boxes is exact in long double.
    const float length = 0.7F;
    for (const double x : {7e9 + 0.25, -3e10, 123456.789, -0.25}) {
        const long double boxes_away = std::floor(static_cast<long double>(x) / length);
        EXPECT_EQ(detail::wrap_into_box(x, 0, length),
                  static_cast<double>(x - boxes_away * length));
    }
}

}  // namespace
}  // namespace connectivity::test
