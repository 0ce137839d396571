// SPDX-License-Identifier: BSD-3-Clause
// The ellipsoid that a skin makes of a tensor, and the growth from one tensor to another, against
// support functions: along a unit vector u the ellipsoid |H r| <= K reaches K |H^-1 u|.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <map/support.hpp>
#include <support/ellipsoid.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

constexpr double K = 2.5;

Ellipsoid any_ellipsoid(Random& random, int dim, double ratio) {
    return {random, dim, ratio, random.log_uniform(1e-3, 1e3)};
}

void unit_vector(Random& random, int dim, const Ellipsoid& e, double (&u)[3]) {
    const int axis = random.below(dim);  // near an axis, or anywhere
    const double noise = random.pick({0.0, 1e-6, 1e-3, 1.0, 100.0});
    double length = 0;
    for (int d = 0; d < dim; ++d) {
        u[d] = e.direction[axis][d] + noise * random.uniform(-1, 1);
        length = std::hypot(length, u[d]);
    }
    for (int d = 0; d < dim; ++d) u[d] /= length;
}

double eta(int dim, const double* packed, const double* r) {
    double H[3][3], sum = 0;
    for (int i = 0, k = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j, ++k) H[i][j] = H[j][i] = packed[k];
    for (int i = 0; i < dim; ++i) {
        double e = 0;
        for (int j = 0; j < dim; ++j) e += H[i][j] * r[j];
        sum += e * e;
    }
    return std::sqrt(sum);
}

template <int Dim>
void holds_all_within_the_skin(Random& random) {
    const Ellipsoid e = any_ellipsoid(random, Dim, random.pick({1.0, 2.0, 1e3, 1e6}));
    const double skin = e.half[0] * random.log_uniform(1e-6, 1e3);
    double H[6], W[6], u[3], point[3];
    e.pack(Dim, K, H);
    ASSERT_TRUE(widen_tensor<Dim>(H, K, skin, W));
    for (int k = 0; k < 40; ++k) {
        unit_vector(random, Dim, e, u);
        e.farthest(Dim, u, point);
        for (int d = 0; d < Dim; ++d) point[d] += skin * u[d];
        ASSERT_LE(eta(Dim, W, point), K) << skin << " " << e.half[0] << " " << e.half[1];
    }
}

TEST(WidenedTensor, holds_every_point_within_the_skin_of_the_ellipsoid) {
    Random random(1);
    for (int k = 0; k < 5000; ++k) {
        holds_all_within_the_skin<1>(random);
        holds_all_within_the_skin<2>(random);
        holds_all_within_the_skin<3>(random);
    }
}

TEST(WidenedTensor, of_a_ball_is_the_larger_ball) {
    for (const double skin : {1e-90, 1e-6, 1.0, 1e6, 1e90}) {
        const double H[6] = {0.5, 0, 0, 0.5, 0, 0.5};
        double W[6];
        ASSERT_TRUE(widen_tensor<3>(H, K, skin, W));
        const double want = K / (K / 0.5 + skin);
        for (const int k : {0, 3, 5}) EXPECT_NEAR(W[k], want, 1e-12 * want);
        for (const int k : {1, 2, 4}) EXPECT_NEAR(W[k], 0, 1e-12 * want);
    }
}

/// Of all p > 0 the trace of (1 + 1/p) Q1 + (1 + p) Q2 is least at (sqrt(tr Q1) + sqrt(tr Q2))^2.
TEST(WidenedTensor, is_the_outer_ellipsoid_of_least_trace) {
    const double a[3] = {4, 1, 0.25}, skin = 0.5;
    const double H[6] = {K / a[0], 0, 0, K / a[1], 0, K / a[2]};
    double W[6], trace = 0;
    ASSERT_TRUE(widen_tensor<3>(H, K, skin, W));
    for (const int k : {0, 3, 5}) trace += K / W[k] * (K / W[k]);
    const double least = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) + std::sqrt(3.0) * skin;
    EXPECT_NEAR(trace, least * least, 1e-10 * trace);
}

template <int Dim>
void growth_is_enough(Random& random, double& worst) {
    Ellipsoid e = any_ellipsoid(random, Dim, random.pick({1.0, 2.0, 1e3}));
    double before[6], after[6], u[3], point[3];
    e.pack(Dim, K, before);
    const Ellipsoid old = e;
    const double change = random.log_uniform(1e-6, 1);
    if (Dim > 1) e.turn(0, 1 + random.below(Dim - 1), change * random.uniform(-1, 1), Dim);
    for (int k = 0; k < Dim; ++k) e.half[k] *= 1 + change * random.uniform(-0.5, 1);
    e.pack(Dim, K, after);
    const double bound = K * tensor_growth<Dim>(before, after);
    double most = 0;
    for (int k = 0; k < 60; ++k) {
        unit_vector(random, Dim, random.chance(0.5) ? e : old, u);
        most = std::max(most, e.farthest(Dim, u, point) - old.farthest(Dim, u, point));
    }
    ASSERT_GE(bound, most * (1 - 1e-9));
    worst = std::max(worst, most / bound);
    ASSERT_EQ(tensor_growth<Dim>(before, before), 0);
}

TEST(TensorGrowth, is_never_less_than_along_any_direction) {
    Random random(2);
    double worst = 0;
    for (int k = 0; k < 3000; ++k) {
        growth_is_enough<1>(random, worst);
        growth_is_enough<2>(random, worst);
        growth_is_enough<3>(random, worst);
    }
    EXPECT_GT(worst, 0.99) << "the bound is never near the truth";
}

TEST(TensorGrowth, of_an_ellipsoid_that_shrinks_is_zero) {
    Random random(3);
    for (int k = 0; k < 300; ++k) {
        Ellipsoid e = any_ellipsoid(random, 3, random.pick({1.0, 2.0, 100.0}));
        double before[6], after[6];
        e.pack(3, K, before);
        const double shrink = random.log_uniform(1e-6, 0.5);
        for (double& half : e.half) half *= 1 - shrink * random.uniform(0.5, 1);
        e.pack(3, K, after);
        ASSERT_EQ(tensor_growth<3>(before, after), 0);
        ASSERT_GT(tensor_growth<3>(after, before), 0);
    }
}

TEST(TensorGrowth, of_what_is_no_tensor_is_infinite) {
    const double good[3] = {1, 0, 1}, flat[3] = {1, 1, 1}, nan[3] = {std::nan(""), 0, 1};
    EXPECT_EQ(tensor_growth<2>(good, flat), HUGE_VAL);
    EXPECT_EQ(tensor_growth<2>(good, nan), HUGE_VAL);
}

}  // namespace
}  // namespace connectivity::test
