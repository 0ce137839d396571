// SPDX-License-Identifier: BSD-3-Clause
// Supports where searches fail: h = 0 among others, needles and pancakes, supports over half a box,
// one giant.

#include <cmath>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

std::vector<double> uniform(int n, int dim, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> x;
    for (int k = 0; k < n * dim; ++k) x.push_back(random.uniform());
    return x;
}

void check(const Case& c) {
    const Expected expected = brute_force(c);
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        rebuild(map, c, method);
        ASSERT_TRUE(equals(map, expected)) << name_of(method);
    }
}

TEST(ZeroSupport, one_or_many_nodes_that_see_nobody_are_seen_by_others) {
    for (const int every : {1000, 3, 2, 1}) {
        Case c = uniform_case(3, uniform(1000, 3, 1), 0.08);
        for (std::size_t k = 0; k < 1000; k += static_cast<std::size_t>(every)) c.lists[0].h[k] = 0;
        check(c);
        for (const SearchMode mode : {SearchMode::gather, SearchMode::scatter}) {
            c.mode = mode;
            check(c);
        }
    }
}

TEST(TensorSupport, a_hundred_thousand_random_positive_definite_ones_are_accepted) {
    Random random(2);
    const int n = 100000;
    std::vector<double> x, H;
    for (int k = 0; k < n; ++k) {
        const double size = random.log_uniform(1e-4, 1e-3);
        const double axes[3] = {size, size * random.log_uniform(1e-6, 1),
                                size * random.log_uniform(1e-6, 1)};
        double packed[6];
        rotated_tensor(3, axes, random, packed);
        H.insert(H.end(), packed, packed + 6);
        for (int d = 0; d < 3; ++d) x.push_back(random.uniform());
    }
    ConnectivityMap map;
    MapOptions options;
    options.rows = false;
    EXPECT_NO_THROW(map.rebuild(node_lists(tensor_case(3, x, H)), options));
}

/// Ellipsoids of one shape, each turned at random.
Case turned(const double (&axes)[3], std::uint64_t seed) {
    Random random(seed);
    std::vector<double> H;
    for (int k = 0; k < 2000; ++k) {
        double packed[6];
        rotated_tensor(3, axes, random, packed);
        H.insert(H.end(), packed, packed + 6);
    }
    return tensor_case(3, uniform(2000, 3, seed), H);
}

TEST(Anisotropy, needles_and_pancakes_of_a_million_to_one_are_exact) {
    check(turned({0.2, 0.2, 0.2e-6}, 3));
    check(turned({0.2, 0.2e-6, 0.2e-6}, 4));
    check(turned({0.2, 0.02, 0.2e-6}, 5));
    check(turned({0.2, 0.2, 0.2}, 6));
}

TEST(Anisotropy, points_lie_on_the_tilted_surface_itself) {
    // Every node is thrown on the disc of another one: |H r| is dominated by cancellation there.
    Random random(7);
    const double axes[3] = {0.3, 0.3, 0.3e-6};
    std::vector<double> x, H;
    for (int k = 0; k < 1000; ++k) {
        double packed[6];
        rotated_tensor(3, axes, random, packed);
        H.insert(H.end(), packed, packed + 6);
    }
    // Null direction of each H to working precision: a row combination orthogonal to the stiff
    // axis.
    x = {0.5, 0.5, 0.5};
    for (std::size_t k = 1; k < 1000; ++k) {
        const double* h = &H[6 * (k - 1)];
        const double length = std::hypot(h[0], h[1]), step = 0.2 * random.uniform();
        const double along[3] = {-h[1] / length, h[0] / length, 0};
        for (std::size_t d = 0; d < 3; ++d) x.push_back(x[3 * (k - 1) + d] + step * along[d]);
    }
    check(tensor_case(3, x, H));
}

TEST(Anisotropy, beyond_a_million_a_tensor_is_exact_or_refused) {
    for (const double ratio : {1e7, 1e8, 1e10, 1e13, 1e15})
        for (const SearchMethod method : all_methods) {
            const Case c = turned({0.2, 0.2, 0.2 / ratio}, 11);
            ConnectivityMap map;
            try {
                rebuild(map, c, method);
            } catch (const Error& error) {
                EXPECT_EQ(error.status(), Status::not_spd) << error.what();
                continue;
            }
            ASSERT_TRUE(equals(map, brute_force(c))) << ratio << " " << name_of(method);
        }
}

/// 3^3 lattice in a unit box, support radius H.
Case small_periodic_lattice(double radius) {
    std::vector<double> x;
    for (int k = 0; k < 27; ++k)
        for (const int at : {k % 3, k / 3 % 3, k / 9}) x.push_back((at + 0.5) / 3);
    Case c = uniform_case(3, x, radius, 1);
    c.domain.periodic = {true, true, true};
    c.domain.hi = {1, 1, 1};
    return c;
}

TEST(HalfBox, supports_up_to_half_a_box_are_exact_and_larger_ones_an_error) {
    check(small_periodic_lattice(0.4));
    check(small_periodic_lattice(0.5));
    for (const double radius : {0.51, 0.9, 1.2})
        for (const SearchMethod method : all_methods) {
            ConnectivityMap map;
            EXPECT_TRUE(fails_with(Status::half_box, {"node 0", "0.5"},
                                   [&] { rebuild(map, small_periodic_lattice(radius), method); }));
        }
}

TEST(HalfBox, a_minimum_image_lattice_has_the_neighbours_that_a_sum_over_images_has) {
    const double radius = 0.4;
    const Case c = small_periodic_lattice(radius);
    ConnectivityMap map;
    rebuild(map, c);
    const auto rows = map.rows();
    for (Offset i = 0; i < 27; ++i) {
        Offset count = 0;
        for (Offset j = 0; j < 27; ++j)
            for (int image = 0; image < 125; ++image) {
                const int shift[3] = {image % 5 - 2, image / 5 % 5 - 2, image / 25 - 2};
                double r2 = 0;
                for (int d = 0; d < 3; ++d) {
                    const auto at = [&](Offset k) {
                        return c.lists[0].x[static_cast<std::size_t>(3 * k + d)];
                    };
                    r2 += std::pow(at(i) - at(j) + shift[d], 2);
                }
                count += i != j && r2 < radius * radius;
            }
        EXPECT_EQ(rows[i].size(), count);
    }
}

TEST(GiantSupport, one_that_sees_all_is_found_and_the_others_stay_local) {
    const int n = 20000;
    std::vector<double> x = uniform(n, 3, 8), h(static_cast<std::size_t>(n), 0.01);
    const auto pairs_of = [&](const std::vector<double>& supports, SearchMethod method) {
        ConnectivityMap map;
        rebuild(map, scalar_case(3, x, supports), method);
        for (Offset i = 1; i < n; i += 97)
            EXPECT_TRUE(supports[0] < 1 || map.pairs().view().find(0, static_cast<Slot>(i)) >= 0);
        return map.pairs().size();
    };
    for (const SearchMethod method : {SearchMethod::groups, SearchMethod::automatic}) {
        h[0] = 0;
        const Offset seen_by_others = [&] {
            ConnectivityMap map;
            rebuild(map, scalar_case(3, x, h), method);
            return map.rows()[0].size();
        }();
        const Offset without = pairs_of(h, method);
        h[0] = 10;
        EXPECT_EQ(pairs_of(h, method), without - seen_by_others + n - 1) << name_of(method);
    }
    x.resize(3 * 2000);
    h.assign(2000, 0.03);
    h[1234] = 10;
    check(scalar_case(3, x, h));
}

TEST(VariableSupport, a_factor_of_a_million_between_neighbours_is_exact) {
    Random random(9);
    Case c = uniform_case(3, uniform(2500, 3, 9), 0);
    for (double& h : c.lists[0].h) h = random.log_uniform(1e-6, 1);
    check(c);
    for (double& h : c.lists[0].h)
        h = random.log_uniform(1e-150, 1e150);  // squares under- and overflow
    check(c);
}

}  // namespace
}  // namespace connectivity::test
