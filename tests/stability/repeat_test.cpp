// SPDX-License-Identifier: BSD-3-Clause
// Order of the input, offsets and repetition: the pairs are the same, and memory does not grow.

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/process.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

Case varied_cloud(int n, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> x, h;
    for (int k = 0; k < 3 * n; ++k) x.push_back(random.uniform());
    for (int k = 0; k < n; ++k) h.push_back(random.log_uniform(0.01, 0.06));
    return scalar_case(3, std::move(x), std::move(h));
}

TEST(InputOrder, does_not_change_which_nodes_are_neighbours) {
    const int n = 10000;
    const Case original = varied_cloud(n, 1);
    using Pair = std::pair<Slot, Slot>;
    std::vector<Pair> wanted;
    Random random(2);
    std::vector<Slot> id(static_cast<std::size_t>(n));  // id[k] is the original name of node k
    std::iota(id.begin(), id.end(), 0);
    ConnectivityMap map;
    for (int round = 0; round < 6; ++round) {
        Case c = original;
        for (std::size_t k = 0; k < id.size(); ++k) {
            const auto from = static_cast<std::size_t>(id[k]);
            c.lists[0].h[k] = original.lists[0].h[from];
            for (std::size_t d = 0; d < 3; ++d)
                c.lists[0].x[3 * k + d] = original.lists[0].x[3 * from + d];
        }
        rebuild(map, c, round % 2 == 0 ? SearchMethod::groups : SearchMethod::automatic);
        const auto pairs = map.pairs().expanded_view();
        std::vector<Pair> found;
        for (Offset p = 0; p < pairs.size(); ++p) {
            const Slot a = id[static_cast<std::size_t>(pairs[p].i)],
                       b = id[static_cast<std::size_t>(pairs[p].j)];
            found.emplace_back(std::min(a, b), std::max(a, b));
        }
        std::sort(found.begin(), found.end());
        if (round == 0) wanted = found;
        ASSERT_EQ(found, wanted);
        for (std::size_t k = id.size() - 1; k > 0; --k)
            std::swap(id[k], id[static_cast<std::size_t>(random.below(static_cast<int>(k + 1)))]);
    }
    ASSERT_GT(wanted.size(), 10000u);
}

TEST(Translation, by_a_power_of_two_changes_nothing_where_positions_keep_their_bits) {
    Random random(3);
    std::vector<double> x;
    for (int k = 0; k < 3 * 1500; ++k) x.push_back(random.below(1 << 20) * 0x1p-20);
    const Expected expected = brute_force(uniform_case(3, x, 0.04));
    for (const double offset : {1.0, 1024.0, -65536.0, 0x1p30})
        for (const SearchMethod method : all_methods) {
            std::vector<double> moved = x;
            for (double& value : moved) value += offset;
            ConnectivityMap map;
            rebuild(map, uniform_case(3, moved, 0.04), method);
            ASSERT_TRUE(equals(map, expected)) << offset << " " << name_of(method);
        }
}

TEST(Translation, of_a_fine_lattice_far_from_the_origin_stays_exact) {
    for (const double offset : {0.0, 1e3, 1e5, -1e5, 1e9})
        for (const bool periodic : {false, true}) {
            std::vector<double> x;
            for (int k = 0; k < 12 * 12 * 12; ++k)
                for (const int at : {k % 12, k / 12 % 12, k / 144}) x.push_back(offset + 0.01 * at);
            Case c = uniform_case(3, x, 0.01);
            c.domain.periodic = {periodic, periodic, periodic};
            c.domain.lo = {offset, offset, offset};
            c.domain.hi = {offset + 0.12, offset + 0.12, offset + 0.12};
            const Expected expected = brute_force(c);
            for (const SearchMethod method : all_methods) {
                ConnectivityMap map;
                rebuild(map, c, method);
                ASSERT_TRUE(equals(map, expected)) << offset << " " << name_of(method);
            }
        }
}

TEST(Translation, of_single_nodes_by_many_box_lengths_stays_exact) {
    for (const double lengths : {1e0, 1e3, 1e6, 1e9, 1e12, 1e15}) {
        Random random(11);
        Case c = uniform_case(3, {}, 0);
        for (int k = 0; k < 3 * 800; ++k)
            c.lists[0].x.push_back(random.uniform() + std::rint(lengths * random.uniform(-1, 1)));
        for (int k = 0; k < 800; ++k) c.lists[0].h.push_back(random.log_uniform(0.002, 0.1));
        c.lists[0].n_internal = 800;
        c.domain.hi = {1, 1, 1};
        for (const int mask : {1, 6, 7}) {
            for (std::size_t d = 0; d < 3; ++d) c.domain.periodic[d] = (mask >> d & 1) != 0;
            const Expected expected = brute_force(c);
            for (const SearchMethod method : all_methods) {
                ConnectivityMap map;
                rebuild(map, c, method);
                ASSERT_TRUE(equals(map, expected))
                    << lengths << " " << mask << " " << name_of(method);
            }
        }
    }
}

TEST(Repetition, a_hundred_shrinking_rebuilds_keep_memory_flat) {
    ConnectivityMap map;
    const Case large = varied_cloud(20000, 4);
    const auto shrunk = [&](int n) {
        Case c = large;
        c.lists[0].x.resize(static_cast<std::size_t>(3 * n));
        c.lists[0].h.resize(static_cast<std::size_t>(n));
        c.lists[0].n_internal = n;
        return c;
    };
    for (int k = 0; k < 5; ++k) rebuild(map, large);
    const std::int64_t before = resident_bytes();
    for (int round = 0; round < 100; ++round) {
        const Case c = shrunk(20000 - 190 * round);
        rebuild(map, c);
        if (round % 33 != 32) continue;
        Case probe = shrunk(1000);  // a small one in between must not leave anything behind
        rebuild(map, probe);
        ASSERT_TRUE(equals(map, brute_force(probe)));
    }
    // 2 MiB are the cases; a thread that happens to find more rows takes another arena of 4 MiB.
    const std::int64_t allowed = before + (std::int64_t{12} << 20);
    EXPECT_TRUE(sanitized || resident_bytes() <= allowed) << resident_bytes() - before;
}

TEST(StaleUse, views_tell_their_generation_and_missing_products_are_errors) {
    ConnectivityMap map;
    rebuild(map, varied_cloud(500, 5));
    const auto rows = map.rows();
    const auto pairs = map.pairs().view();
    EXPECT_EQ(rows.generation, map.generation());
    rebuild(map, varied_cloud(400, 6));
    EXPECT_NE(rows.generation, map.generation());
    EXPECT_NE(pairs.generation, map.generation());
    MapOptions options;
    options.pairs = false;
    const Case c = varied_cloud(300, 7);
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::not_built, {"pairs"}, [&] { (void)map.pairs(); }));
    options.rows = false;
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::not_built, {"rows"}, [&] { (void)map.rows(); }));
    EXPECT_EQ(map.generation(), 4u);
}

}  // namespace
}  // namespace connectivity::test
