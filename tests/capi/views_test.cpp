// SPDX-License-Identifier: BSD-3-Clause
// Views are pinned: valid, unchanged and consistent until released, whatever happens to the map.

#include <algorithm>
#include <numeric>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

class CapiViews : public ::testing::Test {
protected:
    Lists rebuild(std::uint64_t seed, int n = 300) {
        const NodeSet set = random_nodes(3, n, seed);
        EXPECT_TRUE(ok(nodes.set(3, set)));
        EXPECT_TRUE(ok(map.rebuild({nodes.handle})));
        return brute_force(3, {set});
    }

    Context context;
    Nodes nodes{context, 3};
    Map map{context};
    conn_rows_view rows = CONN_ROWS_VIEW_INIT;
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
};

TEST_F(CapiViews, views_outlive_rebuilds_and_the_map_unchanged) {
    const Lists first = rebuild(1);
    ASSERT_TRUE(ok(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows)));
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &pairs)));
    for (std::uint64_t seed = 2; seed < 6; ++seed) {
        const Lists next = rebuild(seed, 200 + 100 * static_cast<int>(seed % 3));
        EXPECT_EQ(read_lists(map.handle), next);
        EXPECT_EQ(rows_of(rows), first.rows);
        EXPECT_EQ(pairs_of(pairs), first.pairs);
    }
    EXPECT_EQ(rows.generation, 1u);
    EXPECT_EQ(map.generation(), 5u);
    ASSERT_TRUE(ok(conn_map_destroy(&map.handle)));
    EXPECT_EQ(rows_of(rows), first.rows);
    EXPECT_EQ(pairs_of(pairs), first.pairs);
    EXPECT_EQ(rows.list_offset[1], 300);
    EXPECT_EQ(pairs.list_offset[1], 300);
    EXPECT_EQ(rows.row_offset[1], 300);
    EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
}

TEST_F(CapiViews, the_expanded_i_names_the_first_slot_of_each_pair) {
    const Lists lists = rebuild(3);
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &pairs)));
    ASSERT_EQ(pairs.n_pairs, static_cast<std::int64_t>(lists.pairs.size()));
    for (std::size_t k = 0; k < lists.pairs.size(); ++k) {
        ASSERT_EQ(pairs.i[k], lists.pairs[k].first);
        ASSERT_EQ(pairs.j[k], lists.pairs[k].second);
    }
    EXPECT_EQ(pairs.coupling, nullptr);
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
}

TEST_F(CapiViews, i_is_there_only_if_asked_for) {
    rebuild(3);
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 0, &pairs)));
    EXPECT_EQ(pairs.i, nullptr);
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
}

TEST_F(CapiViews, a_released_view_is_empty_and_may_be_released_and_used_again) {
    rebuild(4);
    ASSERT_TRUE(ok(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows)));
    EXPECT_TRUE(fails(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows), CONN_E_ARGUMENT,
                      {"still holds"}));
    conn_rows_view copy = rows;
    EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
    EXPECT_EQ(rows.slots, nullptr);
    EXPECT_EQ(rows.offsets, nullptr);
    EXPECT_EQ(rows.owner, nullptr);
    EXPECT_EQ(rows.n_entries, 0);
    EXPECT_EQ(rows.struct_size, sizeof rows);
    EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
    EXPECT_TRUE(ok(conn_map_rows_release(nullptr)));
    EXPECT_TRUE(fails(conn_map_rows_release(&copy), CONN_E_HANDLE));
    EXPECT_TRUE(ok(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows)));
    EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
}

TEST_F(CapiViews, what_was_not_built_cannot_be_acquired) {
    EXPECT_TRUE(fails(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows), CONN_E_NOT_BUILT));
    EXPECT_TRUE(
        fails(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 0, &pairs), CONN_E_NOT_BUILT));
    EXPECT_EQ(rows.owner, nullptr);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.rows = 0;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    const Lists lists = rebuild(5);
    EXPECT_TRUE(fails(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &rows), CONN_E_NOT_BUILT));
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 0, &pairs)));
    EXPECT_EQ(pairs_of(pairs), lists.pairs);
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
    options.rows = 1;
    options.pairs = 0;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_EQ(rebuild(5).pairs, lists.pairs);
    EXPECT_TRUE(
        fails(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 0, &pairs), CONN_E_NOT_BUILT));
    EXPECT_EQ(read_lists(map.handle).rows, lists.rows);
}

TEST_F(CapiViews, spaces_and_flags_outside_their_range_are_refused) {
    rebuild(6);
    EXPECT_TRUE(
        fails(conn_map_rows_acquire(map.handle, CONN_SPACE_DEVICE, &rows), CONN_E_UNSUPPORTED));
    EXPECT_TRUE(fails(conn_map_rows_acquire(map.handle, 77, &rows), CONN_E_ARGUMENT, {"77"}));
    EXPECT_TRUE(fails(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 6, &pairs),
                      CONN_E_ARGUMENT, {"flags = 6"}));
    EXPECT_TRUE(fails(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, nullptr), CONN_E_NULL));
}

TEST_F(CapiViews, offsets_and_info_agree_with_the_views) {
    NodeSet with_ghosts = random_nodes(3, 80, 9);
    with_ghosts.n_internal = 30;
    const Nodes second(context, 3, with_ghosts);
    rebuild(7);
    ASSERT_TRUE(ok(map.rebuild({nodes.handle, second.handle})));
    std::int64_t count = 0, list_offset[3], row_offset[3];
    ASSERT_TRUE(ok(conn_map_offsets(map.handle, nullptr, nullptr, 0, &count)));
    EXPECT_EQ(count, 3);
    EXPECT_TRUE(
        fails(conn_map_offsets(map.handle, list_offset, nullptr, 2, &count), CONN_E_BUFFER, {"3"}));
    ASSERT_TRUE(ok(conn_map_offsets(map.handle, list_offset, row_offset, 3, &count)));
    EXPECT_EQ(std::vector<std::int64_t>(list_offset, list_offset + 3),
              (std::vector<std::int64_t>{0, 300, 380}));
    EXPECT_EQ(std::vector<std::int64_t>(row_offset, row_offset + 3),
              (std::vector<std::int64_t>{0, 300, 330}));
    conn_map_info info = CONN_MAP_INFO_INIT;
    ASSERT_TRUE(ok(conn_map_get_info(map.handle, &info)));
    const Lists lists = read_lists(map.handle);
    EXPECT_EQ(info.n_slots, 380);
    EXPECT_EQ(info.n_rows, 330);
    EXPECT_EQ(info.n_pairs, static_cast<std::int64_t>(lists.pairs.size()));
    std::int64_t n_entries = 0;
    for (const auto& row : lists.rows) n_entries += static_cast<std::int64_t>(row.size());
    EXPECT_EQ(info.n_entries, n_entries);
    EXPECT_EQ(info.generation, 2u);
    EXPECT_EQ(info.dim, 3);
    EXPECT_EQ(info.n_lists, 2);
    EXPECT_GT(info.bytes, 4 * n_entries);
}

TEST(CapiOptions, periodic_axes_join_the_ends_of_a_lattice) {
    const int side = 12;
    NodeSet lattice;  // spacing 1, supports 1.2, from -3 to 8
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            lattice.x.insert(lattice.x.end(), {column - 3.0, row - 3.0});
            lattice.h.push_back(0.6);
        }
    const Context context;
    for (int axes = 0; axes < 4; ++axes) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        for (int d = 0; d < 2; ++d) {
            options.periodic[d] = (axes >> d) & 1;
            options.box_lo[d] = -3;
            options.box_hi[d] = side - 3;
        }
        const std::int64_t n_joints = side * (options.periodic[0] + options.periodic[1]);
        EXPECT_EQ(std::ssize(lists_of(context, 2, {lattice}, options).pairs),
                  2 * side * (side - 1) + n_joints);
    }
}

TEST_F(CapiViews, the_spatial_order_is_a_permutation_with_internal_nodes_first) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.spatial_order = 1;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    NodeSet set = random_nodes(3, 100, 9);
    set.n_internal = 60;
    ASSERT_TRUE(ok(nodes.set(3, set)));
    ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
    std::int64_t count = 0;
    ASSERT_TRUE(ok(conn_map_spatial_order(map.handle, 0, nullptr, 0, &count)));
    ASSERT_EQ(count, 100);
    std::vector<std::int32_t> order(100), all(100);
    EXPECT_TRUE(
        fails(conn_map_spatial_order(map.handle, 0, order.data(), 99, &count), CONN_E_BUFFER));
    EXPECT_TRUE(
        fails(conn_map_spatial_order(map.handle, 1, order.data(), 99, &count), CONN_E_ARGUMENT));
    ASSERT_TRUE(ok(conn_map_spatial_order(map.handle, 0, order.data(), 100, &count)));
    EXPECT_TRUE(std::all_of(order.begin(), order.begin() + 60, [](int a) { return a < 60; }));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), all.begin()));
}

TEST_F(CapiViews, the_spatial_order_exists_only_if_asked_for) {
    rebuild(8);
    std::int64_t count = 0;
    EXPECT_TRUE(fails(conn_map_spatial_order(map.handle, 0, nullptr, 0, &count), CONN_E_NOT_BUILT));
}

TEST_F(CapiViews, the_report_shows_what_was_built_and_nothing_for_what_nobody_asked) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.pairs = 0;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    rebuild(9);
    conn_map_info info = CONN_MAP_INFO_INIT;
    ASSERT_TRUE(ok(conn_map_get_info(map.handle, &info)));
    bool has_rows = false;
    for (int k = 0; k < info.n_report_entries; ++k) {
        conn_report_entry entry = CONN_REPORT_ENTRY_INIT;
        ASSERT_TRUE(ok(conn_map_report_entry(map.handle, k, &entry)));
        const std::string product = entry.product;
        has_rows = has_rows || (product == "rows" && entry.built == 1 && entry.bytes > 0);
        if (entry.built == 0) {
            EXPECT_EQ(entry.bytes, 0) << product;
            EXPECT_EQ(entry.ms, 0) << product;
        }
        EXPECT_EQ(entry.built == 1, *entry.asked_by != '\0') << product;
    }
    EXPECT_TRUE(has_rows);
    conn_report_entry entry = CONN_REPORT_ENTRY_INIT;
    EXPECT_TRUE(fails(conn_map_report_entry(map.handle, info.n_report_entries, &entry),
                      CONN_E_ARGUMENT, {"index"}));
    EXPECT_TRUE(fails(conn_map_report_entry(map.handle, -1, &entry), CONN_E_ARGUMENT, {"-1"}));
    for (int k = 0; k < info.n_report_counters; ++k) {
        const char* name = nullptr;
        std::int64_t value = 0;
        ASSERT_TRUE(ok(conn_map_report_counter(map.handle, k, &name, &value)));
        EXPECT_STRNE(name, "");
    }
}

TEST_F(CapiViews, the_report_text_comes_by_the_two_call_pattern) {
    rebuild(10);
    std::int64_t length = 0;
    ASSERT_TRUE(ok(conn_map_report_text(map.handle, nullptr, 0, &length)));
    ASSERT_GT(length, 0);
    std::string text(static_cast<std::size_t>(length) + 1, '?');
    EXPECT_TRUE(
        fails(conn_map_report_text(map.handle, text.data(), length, &length), CONN_E_BUFFER));
    ASSERT_TRUE(ok(conn_map_report_text(map.handle, text.data(), length + 1, &length)));
    EXPECT_EQ(text[static_cast<std::size_t>(length)], '\0');
    EXPECT_NE(text.find("rows"), std::string::npos);
    EXPECT_NE(text.find("pairs"), std::string::npos);
}

}  // namespace
}  // namespace connectivity::test
