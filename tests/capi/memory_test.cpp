// SPDX-License-Identifier: BSD-3-Clause
// What a map holds, what it held at most, and what it would hold.

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

struct Memory {
    std::int64_t bytes = -1, high_water = -1;
};
Memory memory_of(conn_map* map) {
    Memory memory;
    EXPECT_TRUE(ok(conn_map_memory(map, CONN_SPACE_HOST, &memory.bytes, &memory.high_water)));
    return memory;
}

conn_map_info info_of(conn_map* map) {
    conn_map_info info = CONN_MAP_INFO_INIT;
    EXPECT_TRUE(ok(conn_map_get_info(map, &info)));
    return info;
}

TEST(CapiMemory, an_empty_map_holds_nothing_and_a_built_one_its_lists) {
    const Context context;
    const Map empty(context);
    EXPECT_EQ(memory_of(empty.handle).bytes, 0);
    EXPECT_EQ(memory_of(empty.handle).high_water, 0);
    const Built built(context, 3, {random_nodes(3, 2000, 1)});
    const conn_map_info info = info_of(built.map.handle);
    const Memory memory = memory_of(built.map.handle);
    EXPECT_EQ(memory.bytes, info.bytes);
    EXPECT_EQ(memory.high_water, info.bytes);
    EXPECT_GE(memory.bytes, 4 * (info.n_entries + info.n_pairs) + 8 * (2000 + 2000));
}

TEST(CapiMemory, coupling_expanded_pairs_and_sums_are_in_it) {
    const Context context;
    const Built built(context, 3, {random_nodes(3, 2000, 1)});
    conn_map* const map = built.map.handle;
    const std::int64_t n_pairs = info_of(map).n_pairs, n_entries = info_of(map).n_entries;
    std::int64_t before = memory_of(map).bytes;
    const std::vector<double> half(static_cast<std::size_t>(n_pairs), 0.5);
    ASSERT_TRUE(ok(conn_map_set_coupling(map, half.data(), n_pairs)));
    EXPECT_GE(memory_of(map).bytes, before + 8 * n_pairs);
    before = memory_of(map).bytes;
    conn_pairs_view view = CONN_PAIRS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &view)));
    EXPECT_EQ(memory_of(map).bytes, before + 4 * n_pairs);
    ASSERT_TRUE(ok(conn_map_pairs_release(&view)));
    before = memory_of(map).bytes;
    conn_pair_field* field = nullptr;
    ASSERT_TRUE(ok(conn_pair_field_create(map, 1, &field)));
    EXPECT_EQ(memory_of(map).bytes, before) << "a field is its own";
    std::vector<double> sums(2000);
    ASSERT_TRUE(ok(conn_pair_field_sum(field, map, CONN_SYMMETRIC, CONN_SUM_DETERMINISTIC,
                                       sums.data(), 2000)));
    EXPECT_GE(memory_of(map).bytes, before + 4 * n_entries);
    EXPECT_TRUE(ok(conn_pair_field_destroy(&field)));
}

TEST(CapiMemory, old_views_count_once_until_they_are_released_and_the_high_water_stays) {
    const Context context;
    const Built built(context, 3, {random_nodes(3, 2000, 1)});
    conn_map* const map = built.map.handle;
    const std::int64_t first = memory_of(map).bytes, n_entries = info_of(map).n_entries;
    conn_rows_view a = CONN_ROWS_VIEW_INIT, b = CONN_ROWS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_rows_acquire(map, CONN_SPACE_HOST, &a)));
    ASSERT_TRUE(ok(conn_map_rows_acquire(map, CONN_SPACE_HOST, &b)));
    EXPECT_EQ(memory_of(map).bytes, first) << "views of present lists are those lists";
    ASSERT_TRUE(ok(built.rebuild()));
    const std::int64_t pinned = 4 * n_entries + 8 * 2001, now = info_of(map).bytes;
    EXPECT_EQ(memory_of(map).bytes, now + pinned);
    ASSERT_TRUE(ok(conn_map_rows_release(&a)));
    EXPECT_EQ(memory_of(map).bytes, now + pinned);
    ASSERT_TRUE(ok(conn_map_rows_release(&b)));
    EXPECT_EQ(memory_of(map).bytes, now);
    EXPECT_EQ(memory_of(map).high_water, now + pinned);
}

TEST(CapiMemory, what_an_acquired_view_adds_beside_old_views_is_in_the_high_water) {
    const Context context;
    const Built built(context, 3, {random_nodes(3, 2000, 1)});
    conn_map* const map = built.map.handle;
    std::vector<conn_rows_view> old(3, conn_rows_view CONN_ROWS_VIEW_INIT);
    for (conn_rows_view& view : old)
        ASSERT_TRUE(ok(conn_map_rows_acquire(map, CONN_SPACE_HOST, &view)));
    ASSERT_TRUE(ok(built.rebuild()));
    const Memory before = memory_of(map);
    conn_pairs_view expanded = CONN_PAIRS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &expanded)));
    for (conn_rows_view& view : old) ASSERT_TRUE(ok(conn_map_rows_release(&view)));
    const Memory after = memory_of(map);
    EXPECT_EQ(after.high_water, before.bytes + 4 * info_of(map).n_pairs);
    EXPECT_LT(after.bytes, after.high_water);
    EXPECT_TRUE(ok(conn_map_pairs_release(&expanded)));
}

TEST(CapiMemory, copies_of_views_from_one_are_in_it_and_base_zero_pays_nothing) {
    const Context context;
    for (const int base : {0, 1}) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        options.index_base = base;
        const Built built(context, 3, {random_nodes(3, 2000, 1)}, options);
        conn_map* const map = built.map.handle;
        const std::int64_t before = memory_of(map).bytes;
        conn_rows_view view = CONN_ROWS_VIEW_INIT;
        ASSERT_TRUE(ok(conn_map_rows_acquire(map, CONN_SPACE_HOST, &view)));
        EXPECT_EQ(memory_of(map).bytes, before + base * 4 * info_of(map).n_entries);
        EXPECT_TRUE(ok(conn_map_rows_release(&view)));
    }
}

TEST(CapiMemory, other_spaces_are_refused_and_outputs_may_be_null) {
    const Context context;
    const Map map(context);
    std::int64_t bytes = -3;
    for (const int space : {CONN_SPACE_HOST_PINNED, CONN_SPACE_DEVICE, CONN_SPACE_MANAGED})
        EXPECT_TRUE(fails(conn_map_memory(map.handle, space, &bytes, nullptr), CONN_E_UNSUPPORTED));
    EXPECT_TRUE(fails(conn_map_memory(map.handle, 9, &bytes, nullptr), CONN_E_ARGUMENT, {"9"}));
    EXPECT_EQ(bytes, -3);
    EXPECT_TRUE(ok(conn_map_memory(map.handle, CONN_SPACE_HOST, nullptr, nullptr)));
}

TEST(CapiEstimate, of_few_nodes_is_what_a_rebuild_makes_and_leaves_the_map_alone) {
    const Context context;
    std::vector<NodeSet> sets{random_nodes(3, 600, 1), random_nodes(3, 300, 2)};
    sets[0].n_internal = 400;
    const Built built(context, 3, {sets[0]});
    const Nodes second(context, 3, sets[1]);
    conn_nodes* const lists[] = {built.lists[0], second.handle};
    const Lists before = read_lists(built.map.handle);
    const std::int64_t held = memory_of(built.map.handle).bytes;
    conn_estimate found = CONN_ESTIMATE_INIT;
    ASSERT_TRUE(ok(conn_map_estimate(built.map.handle, lists, 2, &found)));
    EXPECT_EQ(read_lists(built.map.handle), before);
    EXPECT_EQ(memory_of(built.map.handle).bytes, held);
    EXPECT_EQ(built.map.generation(), 1u);
    const Lists expected = brute_force(3, sets);
    std::int64_t n_entries = 0;
    for (const auto& row : expected.rows) n_entries += std::ssize(row);
    EXPECT_EQ(found.n_entries, n_entries);
    EXPECT_EQ(found.n_pairs, std::ssize(expected.pairs));
    EXPECT_EQ(found.relative_error, 0);
    EXPECT_EQ(found.n_sampled, 700);
    EXPECT_EQ(found.bytes, 8 * (700 * 2 + 1) + 4 * n_entries + 8 * 901 + 4 * found.n_pairs);
    EXPECT_GT(found.peak_bytes, found.bytes);
}

TEST(CapiEstimate, of_the_peak_is_at_least_what_a_first_rebuild_holds) {
    const Context context;
    const std::vector<NodeSet> sets{random_nodes(3, 6000, 1), random_nodes(3, 4000, 2)};
    std::vector<std::uint8_t> active(10000, 1);
    for (std::size_t k = 0; k < active.size(); k += 3) active[k] = 0;
    const std::uint8_t interactions[] = {1, 1, 1, 0};
    for (const bool key_order : {false, true})
        for (const bool excludes : {false, true}) {
            conn_map_options options = CONN_MAP_OPTIONS_INIT;
            options.order = key_order ? CONN_ORDER_KEY : CONN_ORDER_SLOT;
            options.active = active.data(), options.n_active = 10000;
            options.interactions = interactions, options.n_interactions = 4;
            const Map map(context, options);
            const conn_pair_predicate exclude = [](void*, std::int32_t i, std::int32_t j) {
                return (i + j) % 2;
            };
            ASSERT_TRUE(
                ok(conn_map_set_exclusion(map.handle, excludes ? exclude : nullptr, nullptr)));
            const Nodes first(context, 3, sets[0]), second(context, 3, sets[1]);
            conn_nodes* const lists[] = {first.handle, second.handle};
            conn_estimate found = CONN_ESTIMATE_INIT;
            ASSERT_TRUE(ok(conn_map_estimate(map.handle, lists, 2, &found)));
            EXPECT_EQ(found.is_lower_bound, 0);
            ASSERT_TRUE(ok(map.rebuild({first.handle, second.handle})));
            EXPECT_LE(memory_of(map.handle).high_water, found.peak_bytes);
        }
}

TEST(CapiEstimate, says_what_is_not_in_it) {
    const Context context;
    const Nodes nodes(context, 3, random_nodes(3, 300, 1));
    for (const int overlap : {0, 1})
        for (const int intersection : {CONN_INTERSECTION_NONE, CONN_INTERSECTION_ALL}) {
            conn_map_options options = CONN_MAP_OPTIONS_INIT;
            options.overlap = overlap, options.intersection = intersection;
            const Map map(context, options);
            conn_estimate found = CONN_ESTIMATE_INIT;
            ASSERT_TRUE(ok(conn_map_estimate(map.handle, &nodes.handle, 1, &found)));
            EXPECT_EQ(found.is_lower_bound,
                      overlap != 0 || intersection != CONN_INTERSECTION_NONE ? 1 : 0);
        }
}

TEST(CapiEstimate, fails_as_a_rebuild_does_but_for_the_budget) {
    const Context context;
    NodeSet set = random_nodes(3, 50, 1);
    const Nodes nodes(context, 3, set), unset(context, 3);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.budget_bytes = 1;
    const Map map(context, options);
    conn_estimate found = CONN_ESTIMATE_INIT;
    EXPECT_TRUE(fails(map.rebuild({nodes.handle}), CONN_E_BUDGET));
    EXPECT_TRUE(ok(conn_map_estimate(map.handle, &nodes.handle, 1, &found)));
    EXPECT_EQ(found.n_pairs, std::ssize(brute_force(3, {set}).pairs));
    EXPECT_TRUE(fails(conn_map_estimate(map.handle, &unset.handle, 1, &found), CONN_E_ARGUMENT,
                      {"never set"}));
    EXPECT_TRUE(fails(conn_map_estimate(map.handle, &nodes.handle, 1, nullptr), CONN_E_NULL));
    found.struct_size = 8;
    EXPECT_TRUE(fails(conn_map_estimate(map.handle, &nodes.handle, 1, &found), CONN_E_STRUCT_SIZE));
    set.h[3] = -1;
    ASSERT_TRUE(ok(nodes.set(3, set)));
    found.struct_size = sizeof found;
    EXPECT_TRUE(
        fails(conn_map_estimate(map.handle, &nodes.handle, 1, &found), CONN_E_SUPPORT, {"3"}));
}

}  // namespace
}  // namespace connectivity::test
