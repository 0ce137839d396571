// SPDX-License-Identifier: BSD-3-Clause
// The life of a map over many rebuilds: storage, held views, generations, products not asked for.

#include <cmath>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

TEST(Rebuild, growing_and_shrinking_sequences_leave_nothing_behind) {
    ConnectivityMap map;
    for (const int n : {10, 800, 3, 0, 500, 1200, 1, 2, 1200, 40})
        for (const SearchMethod method : all_methods) {
            const Case c = cloud(n, static_cast<std::uint64_t>(n));
            rebuild(map, c, method);
            ASSERT_TRUE(equals(map, brute_force(c))) << n << " " << name_of(method);
        }
}

TEST(Rebuild, dimensions_and_numbers_of_lists_may_change) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 0, 100, 0});
        rebuild(map, c);
        ASSERT_TRUE(equals(map, brute_force(c))) << c.text;
        ASSERT_EQ(map.dim(), c.dim);
        ASSERT_EQ(map.list_names().size(), c.lists.size());
        ASSERT_EQ(map.list_names().back(), c.lists.back().name);
    }
}

TEST(Rebuild, held_views_stay_valid_and_unchanged) {
    ConnectivityMap map;
    struct Held {
        RowsView<> rows;
        NodePairList::View<> pairs, expanded;
        Expected expected;
    };
    std::vector<Held> held;
    for (int k = 0; k < 8; ++k) {
        const Case c = cloud(200 + 150 * (k % 3), static_cast<std::uint64_t>(k % 5));
        rebuild(map, c);
        held.push_back(
            {map.rows(), map.pairs().view(), map.pairs().expanded_view(), brute_force(c)});
        for (const Held& h : held) {
            ASSERT_TRUE(rows_equal(h.rows, h.expected));
            ASSERT_TRUE(pairs_equal(h.pairs, h.expected));
            ASSERT_TRUE(pairs_equal(h.expanded, h.expected));
            for (Slot i = 0; i < h.expanded.n_slots(); ++i)
                for (Offset p = h.expanded.offsets(i); p < h.expanded.offsets(i + 1); ++p)
                    ASSERT_EQ(h.expanded.i(p), i);
        }
    }
    for (std::size_t k = 1; k < held.size(); ++k) {
        EXPECT_EQ(held[k].rows.generation, held[k - 1].rows.generation + 1);
        EXPECT_EQ(held[k].pairs.generation, held[k].rows.generation);
    }
}

TEST(Rebuild, views_outlive_their_map) {
    const Case c = cloud(300, 5);
    RowsView<> rows;
    NodePairList::View<> pairs;
    {
        ConnectivityMap map;
        rebuild(map, c);
        rows = map.rows();
        pairs = map.pairs().view();
    }
    const Expected expected = brute_force(c);
    EXPECT_TRUE(rows_equal(rows, expected));
    EXPECT_TRUE(pairs_equal(pairs, expected));
}

TEST(Rebuild, a_moved_map_keeps_its_lists_and_goes_on) {
    const Case c = cloud(300, 5), other = cloud(100, 6);
    ConnectivityMap first;
    rebuild(first, c);
    ConnectivityMap second = std::move(first);
    EXPECT_TRUE(equals(second, brute_force(c)));
    rebuild(second, other);
    EXPECT_TRUE(equals(second, brute_force(other)));
    ConnectivityMap third;
    third = std::move(second);
    EXPECT_TRUE(equals(third, brute_force(other)));
}

TEST(Rebuild, inputs_are_read_during_the_call_only) {
    Case c = cloud(300, 5);
    ConnectivityMap map;
    rebuild(map, c);
    const Expected expected = brute_force(c);
    for (double& x : c.lists[0].x) x = -1e9;
    c = Case();
    EXPECT_TRUE(equals(map, expected));
}

TEST(Rebuild, moved_nodes_are_found_where_they_are) {
    ConnectivityMap map;
    Case c = cloud(700, 9);
    Random random(3);
    for (int step = 0; step < 30; ++step) {
        for (double& x : c.lists[0].x)  // small moves first, then everything anew
            x = step < 20 ? x + 0.05 * (random.uniform() - 0.5) : 3 * random.uniform();
        for (double& h : c.lists[0].h) h *= random.uniform(0.8, 1.25);
        for (const SearchMethod method : all_methods) {
            rebuild(map, c, method);
            ASSERT_TRUE(equals(map, brute_force(c))) << step << " " << name_of(method);
        }
    }
}

/// One list of n nodes with everything else at random.
Case one_list_of(int n, std::uint64_t seed, int dim) {
    for (;; seed += 1000) {
        Case c = random_case(seed, {dim, seed % 2 == 1, n, n});
        if (c.lists.size() == 1 && c.n_slots() == n) return c;
    }
}

TEST(Rebuild, everything_but_the_number_of_nodes_may_change) {
    for (int dim = 1; dim <= 3; ++dim) {
        ConnectivityMap
            map;  // what it keeps from build to build belongs to other positions and supports
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            const Case c = one_list_of(700, seed, dim);
            rebuild(map, c, SearchMethod::groups);
            ASSERT_TRUE(equals(map, brute_force(c))) << c.text;
        }
    }
}

TEST(Rebuild, sizes_around_powers_of_two_and_of_blocks_are_exact) {
    ConnectivityMap map;
    for (int size = 16; size <= 4096; size *= 2)
        for (int n = size - 1; n <= size + 1; ++n) {
            const Case c = cloud(n, static_cast<std::uint64_t>(n), 0.3 / std::cbrt(n));
            rebuild(map, c, SearchMethod::groups);
            ASSERT_TRUE(equals(map, brute_force(c))) << n;
        }
}

TEST(Rebuild, the_same_input_gives_the_same_bits_again) {
    const Case c = random_case(11, {3, false, 2000, 1500});
    ConnectivityMap map;
    rebuild(map, c);
    const Expected expected = brute_force(c);
    for (int k = 0; k < 5; ++k) {
        rebuild(map, c);
        ASSERT_TRUE(equals(map, expected));
    }
}

TEST(Products, nothing_is_built_before_the_first_rebuild) {
    ConnectivityMap map;
    EXPECT_EQ(map.generation(), 0u);
    EXPECT_EQ(map.layout().n_slots(), 0);
    EXPECT_TRUE(fails_with(Status::not_built, {"rows"}, [&] { (void)map.rows(); }));
    EXPECT_TRUE(fails_with(Status::not_built, {"pairs"}, [&] { (void)map.pairs(); }));
    EXPECT_TRUE(
        fails_with(Status::not_built, {"spatial_order"}, [&] { (void)map.spatial_order(); }));
}

TEST(Products, what_is_not_asked_for_costs_nothing_and_says_so) {
    const Case c = cloud(1000, 1);
    const Expected expected = brute_force(c);
    ConnectivityMap map;
    for (const bool rows : {true, false})
        for (const bool pairs : {true, false})
            for (const SearchMethod method : all_methods) {
                MapOptions options = map_options(c, method);
                options.rows = rows;
                options.pairs = pairs;
                map.rebuild(node_lists(c), options);
                for (const auto& [asked, product] : {std::pair{rows, "rows"}, {pairs, "pairs"}}) {
                    const ReportEntry* entry = map.report().find(product);
                    const std::int64_t bytes = entry != nullptr ? entry->bytes : 0;
                    EXPECT_EQ(asked, bytes > 0) << product;
                    EXPECT_EQ(asked, entry != nullptr && entry->built) << product;
                    EXPECT_TRUE(asked || entry == nullptr || entry->ms == 0) << product;
                }
                if (rows)
                    EXPECT_TRUE(rows_equal(map.rows(), expected));
                else
                    EXPECT_TRUE(fails_with(Status::not_built, {"rows"}, [&] { (void)map.rows(); }));
                if (pairs)
                    EXPECT_TRUE(pairs_equal(map.pairs().view(), expected));
                else
                    EXPECT_TRUE(
                        fails_with(Status::not_built, {"pairs"}, [&] { (void)map.pairs(); }));
            }
}

TEST(Products, the_report_says_which_method_searched_and_why) {
    ConnectivityMap map;
    rebuild(map, cloud(1000, 1));
    std::string text = map.report().text();
    bool named = false;
    for (const ReportEntry& entry : map.report().entries())
        named = named || (!entry.reason.empty() && entry.built &&
                          (entry.reason.find("cells") != std::string::npos ||
                           entry.reason.find("groups") != std::string::npos ||
                           entry.reason.find("brute") != std::string::npos));
    EXPECT_TRUE(named) << text;
}

TEST(Products, a_small_budget_is_refused_with_the_bytes_needed_and_the_old_lists_stay) {
    const Case c = cloud(2000, 1, 0.2);
    const Expected expected = brute_force(c);
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        rebuild(map, cloud(100, 2), method);
        MapOptions options = map_options(c, method);
        options.budget.bytes = 1000;
        EXPECT_TRUE(fails_with(Status::budget,
                               {std::to_string(expected.row_slots.size()), "1000", "node"},
                               [&] { map.rebuild(node_lists(c), options); }));
        EXPECT_TRUE(equals(map, brute_force(cloud(100, 2))));
        EXPECT_EQ(map.generation(), 1u);
        options.budget.bytes = Offset{1} << 30;
        map.rebuild(node_lists(c), options);
        EXPECT_TRUE(equals(map, expected));
        options.budget.bytes = -1;
        EXPECT_TRUE(
            fails_with(Status::argument, {"budget"}, [&] { map.rebuild(node_lists(c), options); }));
    }
}

}  // namespace
}  // namespace connectivity::test
