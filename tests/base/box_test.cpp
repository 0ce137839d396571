// SPDX-License-Identifier: BSD-3-Clause
// The domain: which boxes are legal, and how differences are wrapped.

#include <limits>

#include <gtest/gtest.h>

#include <connectivity/base/box.hpp>

#include <support/expect_error.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

Domain periodic_on(int axis, double lo, double hi) {
    Domain domain;
    const auto d = static_cast<std::size_t>(axis);
    domain.periodic[d] = true;
    domain.lo[d] = lo;
    domain.hi[d] = hi;
    return domain;
}

TEST(Box, open_axes_accept_anything) {
    Domain domain;
    domain.lo = {nan, 3, inf};
    domain.hi = {0, -3, -inf};
    EXPECT_NO_THROW(domain.check(3));
    EXPECT_FALSE(domain.any_periodic(3));
    EXPECT_EQ(domain.length(0), 0);
}

TEST(Box, a_periodic_axis_needs_two_finite_ends_in_order) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NO_THROW(periodic_on(axis, -1, 1).check(3));
        for (const auto& [lo, hi] : {std::pair{1.0, -1.0},
                                     {0.5, 0.5},
                                     {nan, 1.0},
                                     {0.0, nan},
                                     {-inf, inf},
                                     {0.0, inf},
                                     {-1.7e308, 1.7e308}})
            EXPECT_TRUE(fails_with(Status::box, {"axis " + std::to_string(axis)},
                                   [&, l = lo, h = hi] { periodic_on(axis, l, h).check(3); }));
    }
}

TEST(Box, axes_beyond_the_dimension_are_ignored) {
    const Domain domain = periodic_on(2, 1, 0);
    EXPECT_NO_THROW(domain.check(2));
    EXPECT_FALSE(domain.any_periodic(2));
    EXPECT_TRUE(domain.any_periodic(3));
}

TEST(Wrap, is_odd_bit_for_bit_and_ends_within_half_a_length) {
    Random random(1);
    for (int k = 0; k < 20000; ++k) {
        const double length = random.log_uniform(1e-3, 1e3);
        const Periods<1> p = periods<1>(periodic_on(0, 0, length));
        const double r = length * random.uniform(-5, 5), wrapped = p.wrap(r, 0);
        ASSERT_EQ(p.wrap(-r, 0), -wrapped);
        ASSERT_LE(std::fabs(wrapped), 0.5 * length * (1 + 1e-15));
        ASSERT_NEAR(std::remainder(r - wrapped, length), 0, 1e-14 * length);
    }
}

TEST(Wrap, leaves_small_differences_and_open_axes_alone) {
    const Periods<2> p = periods<2>(periodic_on(0, 0, 8));
    EXPECT_EQ(p.wrap(3.9, 0), 3.9);
    EXPECT_EQ(p.wrap(-4.0, 0), -4.0);
    EXPECT_EQ(p.wrap(5.0, 0), -3.0);
    EXPECT_EQ(p.wrap(21.0, 0), -3.0);
    EXPECT_EQ(p.wrap(21.0, 1), 21.0);
    EXPECT_TRUE(p.any);
}

}  // namespace
}  // namespace connectivity::test
