// SPDX-License-Identifier: BSD-3-Clause
// A whole session of C calls without memory: the old lists stay, and every call is right at last.

#include <numeric>

#include "c_session.hpp"
#include "connectivity_query.h"

namespace connectivity::test {
namespace {

TEST_F(CSession, handles_are_made_and_filled_or_not_at_all) {
    conn_context* context = nullptr;
    each_allocation(
        "conn_context_create", [&] { return conn_context_create(nullptr, &context); },
        [&] { ASSERT_EQ(context, nullptr); }, [&] { conn_context_destroy(&context); });
    each_allocation("conn_context_set_log", [&] {
        return conn_context_set_log(
            context, CONN_LOG_DEBUG, [](void*, std::int32_t, const char*) {}, nullptr);
    });
    conn_nodes* nodes = nullptr;
    each_allocation(
        "conn_nodes_create", [&] { return conn_nodes_create(context, "nodes", 2, 2.0, &nodes); },
        [&] { ASSERT_EQ(nodes, nullptr); }, [&] { conn_nodes_destroy(&nodes); });
    const std::vector<float> x(now_.x.begin(), now_.x.end()), h(now_.h.begin(), now_.h.end());
    const conn_array positions = conn_array_matrix_float(x.data(), n, 2),
                     lengths = conn_array_vector_float(h.data(), n);
    each_allocation("conn_nodes_set_h",
                    [&] { return conn_nodes_set_h(nodes, n, &positions, 1, &lengths); });
    std::vector<std::int32_t> ids(n);
    std::iota(ids.begin(), ids.end(), 7);
    const conn_array names = conn_array_vector_int32(ids.data(), n);
    each_allocation("conn_nodes_set_ids",
                    [&] { return conn_nodes_set_ids(nodes, &names, nullptr); });
    conn_map* map = nullptr;
    each_allocation(
        "conn_map_create", [&] { return conn_map_create(context, nullptr, &map); },
        [&] { ASSERT_EQ(map, nullptr); }, [&] { conn_map_destroy(&map); });
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    const std::vector<std::uint8_t> active(n, 1), interactions{1};
    options.active = active.data(), options.n_active = n;
    options.interactions = interactions.data(), options.n_interactions = 1;
    each_allocation("conn_map_set_options", [&] { return conn_map_set_options(map, &options); });
    each_allocation("conn_map_rebuild", [&] { return conn_map_rebuild(map, &nodes, 1); });
    NodeSet rounded = now_;
    rounded.x.assign(x.begin(), x.end()), rounded.h.assign(h.begin(), h.end());
    EXPECT_EQ(read_lists(map), brute_force(2, {rounded}));
    EXPECT_GT(n_failed_, 30);
    EXPECT_TRUE(ok(conn_map_destroy(&map)));
    EXPECT_TRUE(ok(conn_nodes_destroy(&nodes)));
    EXPECT_TRUE(ok(conn_context_destroy(&context)));
}

TEST_F(CSession, rebuilds_with_all_products_keep_the_lists_and_are_right_at_last) {
    ASSERT_TRUE(ok(conn_context_set_log(
        context(), CONN_LOG_DEBUG, [](void*, std::int32_t, const char*) {}, nullptr)));
    const Nodes nodes(*context_, 2, now_);
    for (const int base : {0, 1}) {
        for (const int order : {CONN_ORDER_SLOT, CONN_ORDER_KEY}) {
            conn_map_options options = all_products();
            options.order = order;
            options.index_base = base;
            const Built built(*context_, 2, {old_}, options);
            conn_map* const map = built.map.handle;
            const conn_pair_predicate odd = [](void*, std::int32_t i, std::int32_t j) {
                return (i + j) % 2;
            };
            each_allocation_keeps("conn_map_set_exclusion", map,
                                  [&] { return conn_map_set_exclusion(map, odd, nullptr); });
            ASSERT_TRUE(ok(conn_map_set_exclusion(map, nullptr, nullptr)));
            ASSERT_TRUE(ok(built.rebuild()));
            const std::uint64_t generation = generation_of(map);
            const Lists before = read_lists(map);
            each_allocation(
                "conn_map_rebuild", [&] { return conn_map_rebuild(map, &nodes.handle, 1); },
                [&] { ASSERT_EQ(read_lists(map), before); },
                [&] { ASSERT_TRUE(ok(built.rebuild())); });
            EXPECT_GT(generation_of(map), generation);
            const Built again(*context_, 2, {now_}, options);
            EXPECT_EQ(read_lists(map), read_lists(again.map.handle));
            if (base == 0 && order == CONN_ORDER_SLOT) {
                EXPECT_EQ(read_lists(map), brute_force(2, {widened(now_)}));
            }
        }
    }
    EXPECT_GT(n_failed_, 200);
}

TEST_F(CSession, views_copies_and_questions) {
    for (const int base : {0, 1}) {
        conn_map_options options = all_products();
        options.order = CONN_ORDER_KEY;
        options.index_base = base;
        const Built built(*context_, 2, {now_}, options);
        conn_map* const map = built.map.handle;
        conn_rows_view rows = CONN_ROWS_VIEW_INIT, overlap = CONN_ROWS_VIEW_INIT;
        conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
        conn_intersection_view common = CONN_INTERSECTION_VIEW_INIT;
        each_allocation(
            "rows", [&] { return conn_map_rows_acquire(map, 0, &rows); },
            [&] { ASSERT_EQ(rows.owner, nullptr); }, [&] { conn_map_rows_release(&rows); });
        each_allocation(
            "overlap", [&] { return conn_map_overlap_acquire(map, 0, &overlap); },
            [&] { ASSERT_EQ(overlap.owner, nullptr); }, [&] { conn_map_rows_release(&overlap); });
        each_allocation(
            "pairs", [&] { return conn_map_pairs_acquire(map, 0, CONN_PAIRS_EXPAND, &pairs); },
            [&] { ASSERT_EQ(pairs.owner, nullptr); }, [&] { conn_map_pairs_release(&pairs); });
        each_allocation(
            "intersection", [&] { return conn_map_intersection_acquire(map, 0, &common); },
            [&] { ASSERT_EQ(common.owner, nullptr); },
            [&] { conn_map_intersection_release(&common); });
        EXPECT_EQ(rows.n_rows, n);
        EXPECT_EQ(pairs.n_pairs, common.n_pairs);
        std::int64_t a = 0, b = 0, some = 0;
        std::vector<std::int64_t> long_room(4096);
        std::vector<std::uint64_t> keys(4096);
        std::vector<std::int32_t> room(65536), other(65536);
        std::vector<double> values(65536);
        char text[8192];
        each_allocation("rows_copy", [&] {
            return conn_map_rows_copy(map, long_room.data(), 4096, &a, room.data(), 65536, &b);
        });
        each_allocation("pairs_copy", [&] {
            return conn_map_pairs_copy(map, room.data(), other.data(), values.data(), 65536, &a);
        });
        each_allocation("find_pairs", [&] {
            return conn_map_find_pairs(map, a, room.data(), other.data(), long_room.data());
        });
        for (std::int64_t k = 0; k < a; ++k) ASSERT_EQ(long_room[static_cast<std::size_t>(k)], k);
        each_allocation("offsets", [&] {
            return conn_map_offsets(map, long_room.data(), nullptr, 4096, &some);
        });
        each_allocation("spatial_order",
                        [&] { return conn_map_spatial_order(map, 0, room.data(), 65536, &some); });
        const conn_array field = conn_array_matrix(values.data(), n, 2);
        each_allocation("reorder",
                        [&] { return conn_reorder(&field, room.data(), n, base, values.data()); });
        each_allocation("key_order", [&] {
            return conn_map_key_order(map, room.data(), other.data(), keys.data(), 4096, &some);
        });
        each_allocation("traversal order",
                        [&] { return conn_map_traversal(map, 0, room.data(), 65536, &some); });
        each_allocation("common", [&] {
            return conn_map_common_neighbours(map, 3, 4, built.lists.data(), 1, room.data(), 65536,
                                              &some);
        });
        each_allocation(
            "all", [&] { return conn_map_all_neighbours(map, 3, 4, room.data(), 65536, &some); });
        conn_estimate estimate = CONN_ESTIMATE_INIT;
        each_allocation("estimate",
                        [&] { return conn_map_estimate(map, built.lists.data(), 1, &estimate); });
        EXPECT_EQ(estimate.n_entries, rows.n_entries);
        std::int32_t needed = 1, n_failed = 1;
        each_allocation("needs_rebuild", [&] {
            return conn_map_needs_rebuild(map, built.lists.data(), 1, &needed, nullptr);
        });
        EXPECT_EQ(needed, 0);
        each_allocation("memory",
                        [&] { return conn_map_memory(map, CONN_SPACE_HOST, &some, &some); });
        conn_map_info info = CONN_MAP_INFO_INIT;
        each_allocation("info", [&] { return conn_map_get_info(map, &info); });
        conn_report_entry entry = CONN_REPORT_ENTRY_INIT;
        each_allocation("entry", [&] { return conn_map_report_entry(map, 0, &entry); });
        each_allocation("text",
                        [&] { return conn_map_report_text(map, text, sizeof text, &some); });
        each_allocation("validate", [&] {
            return conn_map_validate(map, built.lists.data(), 1, &n_failed, text, sizeof text,
                                     nullptr);
        });
        EXPECT_EQ(n_failed, 0) << text;
        EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
        EXPECT_TRUE(ok(conn_map_rows_release(&overlap)));
        EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
        EXPECT_TRUE(ok(conn_map_intersection_release(&common)));
    }
}

TEST_F(CSession, traversals_tell_every_row_at_last) {
    const Built built(*context_, 2, {now_});
    conn_map* const map = built.map.handle;
    for (const int what : {CONN_ROWS, CONN_PAIRS}) {
        std::int64_t n_neighbours = 0;
        const conn_rows_callback count = [](void* to, std::int32_t, std::int64_t n_rows,
                                            const std::int32_t*, const std::int64_t* offsets,
                                            const std::int32_t*) {
            *static_cast<std::int64_t*>(to) += offsets[n_rows];
            return 0;
        };
        each_allocation_keeps("conn_map_traverse", map, [&] {
            n_neighbours = 0;
            return conn_map_traverse(map, built.lists.data(), 1, what, count, &n_neighbours);
        });
        const auto n_pairs = std::ssize(brute_force(2, {now_}).pairs);
        EXPECT_EQ(n_neighbours, what == CONN_ROWS ? 2 * n_pairs : n_pairs);
    }
}

TEST_F(CSession, fields_coupling_patches_and_removals_keep_values_and_lists) {
    const Built built(*context_, 2, {now_});
    conn_map* const map = built.map.handle;
    const auto n_pairs = std::ssize(read_lists(map).pairs);
    const std::vector<double> half(static_cast<std::size_t>(n_pairs), 0.5);
    each_allocation_keeps("conn_map_set_coupling", map,
                          [&] { return conn_map_set_coupling(map, half.data(), n_pairs); });
    const conn_pair_function quarter = [](void*, std::int32_t, std::int32_t) { return 0.25; };
    each_allocation_keeps("conn_map_set_coupling_function", map,
                          [&] { return conn_map_set_coupling_function(map, quarter, nullptr); });
    conn_pair_field* field = nullptr;
    each_allocation(
        "conn_pair_field_create", [&] { return conn_pair_field_create(map, 1, &field); },
        [&] { ASSERT_EQ(field, nullptr); }, [&] { conn_pair_field_destroy(&field); });
    each_allocation("conn_pair_field_reset", [&] { return conn_pair_field_reset(field, map); });
    double* data = nullptr;
    ASSERT_TRUE(ok(conn_pair_field_data(field, map, &data, nullptr, nullptr)));
    std::fill_n(data, n_pairs, 1.0);
    for (const int how : {CONN_SUM_DETERMINISTIC, CONN_SUM_ATOMIC}) {
        std::vector<double> out(n);
        each_allocation_keeps("conn_pair_field_sum", map, [&] {
            return conn_pair_field_sum(field, map, CONN_SYMMETRIC, how, out.data(), n);
        });
        EXPECT_EQ(std::accumulate(out.begin(), out.end(), 0.0), 2.0 * static_cast<double>(n_pairs));
    }
    const auto values_stay = [&] {
        ASSERT_TRUE(ok(conn_pair_field_data(field, map, &data, nullptr, nullptr)));
        ASSERT_EQ(std::count(data, data + n_pairs, 1.0), n_pairs);
    };
    std::vector<std::int32_t> keep(n, 1), old2new(n);
    std::iota(old2new.begin(), old2new.end(), 0);
    keep.back() = 0;
    each_allocation(
        "conn_map_patch",
        [&] { return conn_map_patch(map, keep.data(), old2new.data(), n, &field, 1); }, values_stay,
        [&] { FAIL() << "cannot be undone"; });
    const conn_pair_predicate odd = [](void*, std::int32_t i, std::int32_t j) {
        return (i + j) % 2;
    };
    each_allocation_keeps("conn_map_remove_pairs", map,
                          [&] { return conn_map_remove_pairs(map, odd, nullptr, &field, 1); });
    EXPECT_TRUE(ok(conn_pair_field_data(field, map, &data, nullptr, nullptr)));
    EXPECT_TRUE(ok(conn_pair_field_destroy(&field)));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(read_lists(map), brute_force(2, {now_}));
}

}  // namespace
}  // namespace connectivity::test
