// SPDX-License-Identifier: BSD-3-Clause
// A host may call from inside its own OpenMP regions, where Kokkos alone would do half of the work.

#include <thread>

#include <gtest/gtest.h>

#include <connectivity/base/kokkos_shim.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// body() by one thread of a region with two.
template <class Body>
void inside_a_region(const Body& body) {
#if defined(_OPENMP)
#pragma omp parallel num_threads(2)
#pragma omp single
    {
        EXPECT_TRUE(shim::inside_parallel_region());
        body();
    }
#else
    body();
#endif
}

TEST(OpenMPRegion, a_rebuild_inside_finds_all) {
    const Case c = cloud(6000, 1, 0.04);
    const Expected expected = brute_force(c);
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        inside_a_region([&] { rebuild(map, c, method); });
        EXPECT_TRUE(equals(map, expected)) << name_of(method);
    }
}

TEST(OpenMPRegion, drift_inside_sees_every_node) {
    Case c = cloud(6000, 1, 0.04);
    MapOptions options = map_options(c);
    options.skin = 0.01;
    ConnectivityMap map;
    map.rebuild(node_lists(c), options);
    c.lists[0].x[3 * 5000] += 0.5;
    inside_a_region([&] {
        EXPECT_DOUBLE_EQ(map.drift(node_lists(c)), 1.0);
        EXPECT_TRUE(map.needs_rebuild(node_lists(c)));
    });
}

TEST(OpenMPRegion, a_traversal_inside_hands_over_all) {
    const Case c = cloud(6000, 1, 0.04);
    const Expected expected = brute_force(c);
    std::atomic<std::size_t> entries{0};
    ConnectivityMap map;
    inside_a_region([&] {
        map.for_each_row(node_lists(c), map_options(c),
                         [&](int, Slot, std::span<const Slot> row) { entries += row.size(); });
    });
    EXPECT_EQ(entries, expected.row_slots.size());
}

TEST(OpenMPRegion, a_coupling_set_inside_or_by_another_thread_reaches_every_pair) {
    const Case c = cloud(2000, 1);
    ConnectivityMap map;
    rebuild(map, c);
    const auto all_are = [&](double value) {
        for (Offset k = 0; k < map.pairs().size(); ++k)
            if (map.pairs().coupling(k) != value) return false;
        return true;
    };
    inside_a_region([&] { map.pairs().set_coupling([](Slot, Slot) { return 0.5; }); });
    EXPECT_TRUE(all_are(0.5));
    std::thread([&] { map.pairs().set_coupling([](Slot, Slot) { return 0.25; }); }).join();
    EXPECT_TRUE(all_are(0.25));
}

TEST(OpenMPRegion, the_function_of_a_traversal_may_not_launch_more) {
    const Case c = cloud(2000, 1);
    const auto lists = node_lists(c);
    MapOptions options = map_options(c);
    options.skin = 0.01;
    ConnectivityMap map;
    map.rebuild(lists, options);
    const auto traverse = [&](auto call) {
        map.for_each_row(lists, options, [&](int, Slot, std::span<const Slot>) { call(); });
    };
    const auto refused = [&](auto call) {
        return fails_with(Status::callback, {"traversal"}, [&] { traverse(call); });
    };
    EXPECT_TRUE(refused([&] { (void)map.drift(lists); }));
    EXPECT_TRUE(refused([&] { map.rebuild(lists, options); }));
    EXPECT_TRUE(refused([&] { traverse([] {}); }));
    map.rebuild(lists, options);
    EXPECT_EQ(map.drift(lists), 0);
}

}  // namespace
}  // namespace connectivity::test
