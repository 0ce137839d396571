// SPDX-License-Identifier: BSD-3-Clause
// Positions where trees and grids fail: coincident, collinear, planar, clusters below key
// resolution, far outliers.

#include <cmath>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/process.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

std::vector<double> uniform(int n, int dim, std::uint64_t seed, double scale = 1,
                            double offset = 0) {
    Random random(seed);
    std::vector<double> x;
    for (int k = 0; k < n * dim; ++k) x.push_back(offset + scale * random.uniform());
    return x;
}

/// Every method against brute force.
void check(const Case& c) {
    const Expected expected = brute_force(c);
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        rebuild(map, c, method);
        ASSERT_TRUE(equals(map, expected)) << name_of(method);
    }
}

TEST(CoincidentPoints, all_are_neighbours_of_all) {
    for (const int n : {2, 65, 513, 4096}) {
        const std::vector<double> x(static_cast<std::size_t>(3 * n), 0.3);
        const Offset pairs = Offset{n} * (n - 1) / 2;
        for (const SearchMethod method : all_methods) {
            ConnectivityMap map;
            rebuild(map, uniform_case(3, x, 0.1), method);
            EXPECT_EQ(map.pairs().size(), pairs) << name_of(method);
            EXPECT_EQ(map.rows().size(), 2 * pairs) << name_of(method);
            rebuild(map, uniform_case(3, x, 0.0), method);  // nobody sees anybody
            EXPECT_EQ(map.pairs().size(), 0) << name_of(method);
            std::vector<double> h(static_cast<std::size_t>(n), 0.0);
            h.back() = 1e-300;  // one sees all
            rebuild(map, scalar_case(3, x, h), method);
            EXPECT_EQ(map.pairs().size(), n - 1) << name_of(method);
        }
    }
}

TEST(CoincidentPoints, many_heaps_of_them_too) {
    std::vector<double> x;
    const std::vector<double> heap = uniform(30, 3, 2);
    for (int k = 0; k < 3000; ++k) x.insert(x.end(), &heap[3 * (k % 30)], &heap[3 * (k % 30)] + 3);
    check(uniform_case(3, x, 0.1));
    check(uniform_case(3, x, 1e-200));
}

TEST(FlatSets, points_on_an_axis_give_the_exact_pairs) {
    for (int axis = 0; axis < 3; ++axis) {
        Random random(3);
        std::vector<double> x(3000, 0.0);
        for (std::size_t k = 0; k < 1000; ++k)
            x[3 * k + static_cast<std::size_t>(axis)] = random.uniform();
        check(uniform_case(3, x, 0.01));
    }
}

TEST(FlatSets, a_lattice_plane_and_a_tilted_one_give_the_exact_pairs) {
    std::vector<double> flat, tilted;
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) {
            for (const double value : {i * 1.0, j * 1.0, 0.0}) flat.push_back(value);
            for (const double value : {i * std::sqrt(0.5), j * 1.0, i * std::sqrt(0.5)})
                tilted.push_back(value);
        }
    check(uniform_case(3, flat, 1));
    check(uniform_case(3, tilted, 1));
}

TEST(TinyClusters, below_key_resolution_are_searched_exactly) {
    for (const double diameter : {1e-9, 1e-13, 1e-16}) {
        std::vector<double> x = uniform(1000, 3, 4, diameter);
        const std::vector<double> other = uniform(1000, 3, 5, diameter, 1.0);
        x.insert(x.end(), other.begin(), other.end());
        check(uniform_case(3, x, 0.05 * diameter));  // few neighbours inside each cluster
        check(uniform_case(3, x, diameter));         // all of the own cluster
    }
}

/// 8000 nodes in the unit box and one more.
Case with_outlier(double x, double y, double z, double h = 0.03) {
    Case c = uniform_case(3, uniform(8000, 3, 6), 0.03);
    c.lists[0].x.insert(c.lists[0].x.end(), {x, y, z});
    c.lists[0].h.push_back(h);
    c.lists[0].n_internal = 8001;
    return c;
}

TEST(Outlier, leaves_the_lists_of_all_others_as_they_are) {
    Case alone = uniform_case(3, uniform(8000, 3, 6), 0.03);
    const Expected expected = brute_force(alone);
    for (const auto& [x, y, z] : {std::tuple{1e3, 1e3, 1e3},
                                  {1e30, 0.5, 0.5},
                                  {-1e30, 1e30, 1e30},
                                  {1e200, 0.0, 0.0},
                                  {-1e200, 1e200, 1e308}})
        for (const SearchMethod method : {SearchMethod::cells, SearchMethod::groups}) {
            ConnectivityMap map;
            rebuild(map, with_outlier(x, y, z), method);
            const auto rows = map.rows();
            ASSERT_EQ(rows[8000].size(), 0) << name_of(method);
            ASSERT_EQ(rows.size(), static_cast<Offset>(expected.row_slots.size()))
                << name_of(method);
            ASSERT_TRUE(std::equal(rows.slots.data(), rows.slots.data() + rows.size(),
                                   expected.row_slots.begin()));
            ASSERT_TRUE(std::equal(rows.offsets.data(), rows.offsets.data() + 8001,
                                   expected.row_offsets.begin()));
        }
}

TEST(Outlier, that_sees_everybody_is_everybodys_neighbour) {
    for (const double far : {1e3, 1e30, 1e150}) {
        Case c = with_outlier(far, 0, 0, far);  // K h = 2 far
        c.lists[0].x.resize(3 * 2000);          // fewer of the others: brute force is quadratic
        c.lists[0].x.insert(c.lists[0].x.end(), {far, 0, 0});
        c.lists[0].h.assign(2000, 0.03);
        c.lists[0].h.push_back(far);
        c.lists[0].n_internal = 2001;
        check(c);
    }
}

TEST(Outlier, does_not_cost_memory_for_the_empty_space_between) {
    const auto growth = [](const Case& c) {
        ConnectivityMap map;
        reset_peak();
        const std::int64_t before = resident_bytes();
        rebuild(map, c);
        return peak_resident_bytes() - before;
    };
    growth(with_outlier(2, 2, 2));  // the process has its scratch memory
    const std::int64_t compact = growth(with_outlier(2, 2, 2));
    for (const double far : {1e3, 1e30, 1e200})
        EXPECT_LE(growth(with_outlier(far, far, far)), 2 * compact + (std::int64_t{16} << 20))
            << far;
}

TEST(Outlier, hundreds_of_them_at_every_scale_are_found_exactly) {
    std::vector<double> x = uniform(1500, 3, 7);
    Random random(8);
    for (int k = 0; k < 500; ++k) {
        const double scale = random.log_uniform(1, 1e100);
        for (int d = 0; d < 3; ++d) x.push_back(scale * random.uniform(-1, 1));
    }
    check(uniform_case(3, x, 0.05));
    Case wide = uniform_case(3, x, 0.05);
    for (double& h : wide.lists[0].h) h = random.log_uniform(1e-3, 1e20);
    check(wide);
}

}  // namespace
}  // namespace connectivity::test
