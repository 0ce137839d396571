// SPDX-License-Identifier: BSD-3-Clause
// Spatial order: a permutation, on request, and fields follow it.

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

void rebuild_with_order(ConnectivityMap& map, const Case& c, SearchMethod method) {
    MapOptions options = map_options(c, method);
    options.spatial_order = true;
    map.rebuild(node_lists(c), options);
}

template <class View>
bool is_permutation_of_range(const View& order, Offset first, Offset last) {
    std::vector<Slot> values(order.data(), order.data() + order.size()),
        range(static_cast<std::size_t>(last - first));
    std::iota(range.begin(), range.end(), static_cast<Slot>(first));
    std::sort(values.begin(), values.end());
    return values == range;
}

TEST(SpatialOrder, is_a_permutation_of_all_slots_and_of_each_list) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
        for (const SearchMethod method : all_methods) {
            const Case c =
                random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 600, 0});
            rebuild_with_order(map, c, method);
            ASSERT_TRUE(is_permutation_of_range(map.spatial_order(), 0, c.n_slots())) << c.text;
            for (std::size_t l = 0; l < c.lists.size(); ++l) {
                const auto order = map.spatial_order(static_cast<int>(l));
                ASSERT_TRUE(is_permutation_of_range(order, 0, c.n(l))) << c.text;
                const auto n_internal = static_cast<std::size_t>(c.lists[l].n_internal);
                for (std::size_t k = 0; k < order.size(); ++k)
                    ASSERT_EQ(order(k) < c.lists[l].n_internal, k < n_internal)
                        << "ghosts come last";
            }
            ASSERT_TRUE(equals(map, brute_force(c))) << c.text;
        }
}

TEST(SpatialOrder, is_not_there_unless_asked_for) {
    ConnectivityMap map;
    const Case c = uniform_case(1, {0, 1, 2}, 1);
    rebuild_with_order(map, c, SearchMethod::automatic);
    EXPECT_NO_THROW((void)map.spatial_order());
    rebuild(map, c);
    EXPECT_TRUE(
        fails_with(Status::not_built, {"spatial_order"}, [&] { (void)map.spatial_order(); }));
    rebuild_with_order(map, c, SearchMethod::automatic);
    EXPECT_TRUE(fails_with(Status::argument, {"list 1"}, [&] { (void)map.spatial_order(1); }));
    EXPECT_TRUE(fails_with(Status::argument, {"list -1"}, [&] { (void)map.spatial_order(-1); }));
}

/// Mean distance between nodes that follow each other.
double mean_step(const std::vector<double>& x) {
    double sum = 0;
    for (std::size_t k = 3; k < x.size(); k += 3)
        sum += std::hypot(x[k] - x[k - 3], x[k + 1] - x[k - 2], x[k + 2] - x[k - 1]);
    return sum / static_cast<double>(x.size() / 3 - 1);
}

TEST(SpatialOrder, fields_follow_it_and_neighbours_come_close_in_memory) {
    Random random(4);
    Case c = uniform_case(3, {}, 0.05);
    for (int k = 0; k < 3 * 20000; ++k) c.lists[0].x.push_back(random.uniform());
    c.lists[0].h.assign(20000, 0.02);
    c.lists[0].n_internal = 20000;
    ConnectivityMap map;
    rebuild_with_order(map, c, SearchMethod::automatic);
    const auto order = map.spatial_order(0);
    std::vector<double> sorted(c.lists[0].x.size());
    reorder_field<double>(order, c.lists[0].x.data(), sorted.data(), 3);
    for (std::size_t k = 0; k < order.size(); ++k)
        for (std::size_t d = 0; d < 3; ++d)
            ASSERT_EQ(sorted[3 * k + d], c.lists[0].x[3 * static_cast<std::size_t>(order(k)) + d]);
    EXPECT_LT(mean_step(sorted), 0.2 * mean_step(c.lists[0].x));
    // The reordered host finds the same pairs, under their new numbers.
    const Offset n_pairs = map.pairs().size();
    c.lists[0].x = sorted;
    rebuild(map, c);
    EXPECT_EQ(map.pairs().size(), n_pairs);
}

TEST(SpatialOrder, fields_of_any_type_and_width_follow) {
    start_runtime();
    const std::vector<Slot> order = {2, 0, 1};
    const std::vector<int> in = {10, 11, 20, 21, 30, 31};
    std::vector<int> out(6);
    reorder_field<int>(ConstView<Slot>(order.data(), 3), in.data(), out.data(), 2);
    EXPECT_EQ(out, (std::vector<int>{30, 31, 10, 11, 20, 21}));
}

}  // namespace
}  // namespace connectivity::test
