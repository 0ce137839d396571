// SPDX-License-Identifier: BSD-3-Clause
// Boundaries and queries without memory, and that failures leak none.

#include <malloc.h>

#include "c_session.hpp"
#include "connectivity_boundary.h"
#include "connectivity_query.h"

namespace connectivity::test {
namespace {

/// What fails once may keep memory for the next time; what fails again must not keep more.
TEST_F(CSession, failures_leak_nothing) {
    const auto bytes_in_use = [] {
        const auto info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const Nodes nodes(*context_, 2, now_);
    const Built built(*context_, 2, {old_}, all_products());
    conn_map* const map = built.map.handle;
    const conn_rows_callback ignore = [](void*, std::int32_t, std::int64_t, const std::int32_t*,
                                         const std::int64_t*, const std::int32_t*) { return 0; };
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    conn_pair_field* field = nullptr;
    conn_query* query = nullptr;
    ASSERT_TRUE(ok(conn_query_create(context(), &query)));
    // malloc keeps freed blocks for a while and counts them as in use, hence the rounds before.
    constexpr int n_warm = 40, n_rounds = 20;
    constexpr std::size_t least_block = 32;
    std::size_t before = 0;
    for (int round = 0; round < n_warm + n_rounds; ++round) {
        if (round == n_warm) before = bytes_in_use();
        each_allocation("rebuild", [&] { return conn_map_rebuild(map, &nodes.handle, 1); });
        each_allocation("traverse", [&] {
            return conn_map_traverse(map, &nodes.handle, 1, CONN_ROWS, ignore, nullptr);
        });
        each_allocation(
            "pairs", [&] { return conn_map_pairs_acquire(map, 0, CONN_PAIRS_EXPAND, &pairs); },
            [] {}, [&] { conn_map_pairs_release(&pairs); });
        each_allocation(
            "field", [&] { return conn_pair_field_create(map, 3, &field); }, [] {},
            [&] { conn_pair_field_destroy(&field); });
        each_allocation("query",
                        [&] { return conn_query_update(query, &nodes.handle, 1, nullptr); });
        EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
        EXPECT_TRUE(ok(conn_pair_field_destroy(&field)));
        ASSERT_TRUE(ok(built.rebuild()));
    }
    EXPECT_GT(n_failed_, 300);
    EXPECT_LT(bytes_in_use(), before + n_rounds * least_block);
    EXPECT_TRUE(ok(conn_query_destroy(&query)));
}

TEST_F(CSession, boundaries_keep_their_ghosts) {
    const Nodes nodes(*context_, 2, now_);
    const Map map(*context_);
    conn_boundaries* boundaries = nullptr;
    each_allocation(
        "conn_boundaries_create", [&] { return conn_boundaries_create(context(), 2, &boundaries); },
        [&] { ASSERT_EQ(boundaries, nullptr); }, [&] { conn_boundaries_destroy(&boundaries); });
    const double wall[] = {-0.01, 0, 1, 0};
    each_allocation("conn_boundaries_add", [&] {
        return conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, "wall", wall, 1);
    });
    const auto update = [&](int how) {
        return conn_boundaries_update(boundaries, how == CONN_GHOSTS_REFRESH ? nullptr : map.handle,
                                      &nodes.handle, 1, how);
    };
    conn_boundary_nodes made = CONN_BOUNDARY_NODES_INIT;
    for (const int how : {CONN_GHOSTS_KEEP, CONN_GHOSTS_CULL, CONN_GHOSTS_CULL_MOST}) {
        each_allocation("conn_boundaries_update", [&] { return update(how); });
        ASSERT_TRUE(ok(conn_boundaries_get_nodes(boundaries, 0, &made)));
        EXPECT_EQ(made.n_internal, n);
        EXPECT_GT(made.n, n);
    }
    each_allocation("refresh", [&] { return update(CONN_GHOSTS_REFRESH); });
    std::vector<double> values(static_cast<std::size_t>(made.n), 3.0);
    each_allocation("conn_boundaries_fill_ghosts", [&] {
        return conn_boundaries_fill_ghosts(boundaries, 0, CONN_FIELD_SCALAR, values.data(), made.n,
                                           1);
    });
    EXPECT_GT(n_failed_, 50);
    EXPECT_TRUE(ok(conn_boundaries_destroy(&boundaries)));
}

TEST_F(CSession, queries_keep_their_nodes) {
    const Nodes nodes(*context_, 2, now_), old(*context_, 2, old_);
    conn_query* query = nullptr;
    each_allocation(
        "conn_query_create", [&] { return conn_query_create(context(), &query); },
        [&] { ASSERT_EQ(query, nullptr); }, [&] { conn_query_destroy(&query); });
    std::vector<std::int32_t> slots(n);
    std::int64_t count = 0;
    const auto around = [&](std::int32_t slot) {
        return conn_query_neighbours(query, slot, CONN_GATHER_SCATTER, slots.data(), n, &count);
    };
    ASSERT_TRUE(ok(conn_query_update(query, &old.handle, 1, nullptr)));
    const auto rows_before = brute_force(2, {old_}).rows, rows = brute_force(2, {now_}).rows;
    each_allocation(
        "conn_query_update", [&] { return conn_query_update(query, &nodes.handle, 1, nullptr); },
        [&] {
            ASSERT_TRUE(ok(around(5)));
            ASSERT_EQ(std::vector(slots.begin(), slots.begin() + count), rows_before[5]);
        },
        [&] { ASSERT_TRUE(ok(conn_query_update(query, &old.handle, 1, nullptr))); });
    each_allocation("conn_query_neighbours", [&] { return around(5); });
    EXPECT_EQ(std::vector(slots.begin(), slots.begin() + count), rows[5]);
    const double x[] = {0.5, 0.5}, y[] = {0.7, 0.7};
    double shift[3];
    const int both = CONN_GATHER_SCATTER;
    each_allocation("conn_query_neighbours_at", [&] {
        return conn_query_neighbours_at(query, x, 0.1, nullptr, both, slots.data(), n, &count);
    });
    each_allocation("conn_query_candidates", [&] {
        return conn_query_candidates(query, 5, both, CONN_CANDIDATES_COARSE, slots.data(), n,
                                     &count);
    });
    each_allocation("conn_query_near_box", [&] {
        return conn_query_near_box(query, x, y, both, slots.data(), n, &count);
    });
    each_allocation("conn_query_near_plane", [&] {
        return conn_query_near_plane(query, x, y, 0.1, both, slots.data(), n, &count);
    });
    each_allocation("conn_query_periodic_shift",
                    [&] { return conn_query_periodic_shift(query, 1, 2, shift); });
    EXPECT_TRUE(ok(conn_query_destroy(&query)));
}

}  // namespace
}  // namespace connectivity::test
