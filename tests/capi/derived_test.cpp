// SPDX-License-Identifier: BSD-3-Clause
// Overlap, intersections and key order through the interface: against their definitions, and how
// their views live.

#include <algorithm>
#include <limits>
#include <numeric>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using Slots = std::vector<std::int32_t>;

constexpr int dim = 2, n = 120;

class CapiDerived : public ::testing::Test {
protected:
    CapiDerived() {
        options.overlap = 1;
        options.intersection = CONN_INTERSECTION_ALL;
        EXPECT_TRUE(ok(built.rebuild(options)));
        rows = brute_force(dim, {set}).rows;
    }

    bool are_neighbours(std::int32_t a, std::int32_t b) const {
        return std::ranges::binary_search(rows[static_cast<std::size_t>(a)], b);
    }
    bool sees(std::int32_t a, std::int32_t b) const {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        const double dx = set.x[2 * i] - set.x[2 * j], dy = set.x[2 * i + 1] - set.x[2 * j + 1];
        const double reach = set.extent * set.h[i];
        return dx * dx + dy * dy <= reach * reach;
    }
    /// Where the foot of c on the line from a to b lies: 0 at a, 1 at b.
    double foot(std::int32_t a, std::int32_t b, std::int32_t c) const {
        double along = 0, length = 0;
        for (int d = 0; d < dim; ++d) {
            const auto at = [&](std::int32_t k) {
                return set.x[static_cast<std::size_t>(2 * k + d)];
            };
            along += (at(c) - at(a)) * (at(b) - at(a));
            length += (at(b) - at(a)) * (at(b) - at(a));
        }
        return along / length;
    }

    Slots common(std::int32_t a, std::int32_t b, bool between) const {
        Slots slots;
        for (std::int32_t c = 0; c < n; ++c) {
            const bool is_end = c == a || c == b;
            if (!is_end && !(are_neighbours(a, c) && are_neighbours(b, c))) continue;
            if (is_end || !between || (foot(a, b, c) >= 0 && foot(a, b, c) <= 1))
                slots.push_back(c);
        }
        return slots;
    }

    NodeSet set = random_nodes(dim, n, 3);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    Context context;
    Built built{context, dim, {set}};
    conn_map* map = built.map.handle;
    std::vector<Slots> rows;
};

TEST_F(CapiDerived, overlap_names_the_nodes_that_see_a_common_node) {
    std::vector<Slots> expected(n);
    for (std::int32_t a = 0; a < n; ++a)
        for (std::int32_t b = 0; b < n; ++b)
            for (std::int32_t c = 0; c < n && a != b; ++c)
                if (sees(a, c) && sees(b, c)) {
                    expected[static_cast<std::size_t>(a)].push_back(b);
                    break;
                }
    conn_rows_view view = CONN_ROWS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_overlap_acquire(map, CONN_SPACE_HOST, &view)));
    EXPECT_EQ(rows_of(view), expected);
    EXPECT_TRUE(ok(conn_map_rows_release(&view)));
}

TEST_F(CapiDerived, the_neighbours_of_any_two_nodes_are_those_of_brute_force) {
    for (std::int32_t a = 0; a < n; a += 7)
        for (std::int32_t b = 0; b < n; b += 3) {
            if (a == b) continue;
            const auto ask = [&](bool between) {
                return two_calls<std::int32_t>([&](auto* slots, auto capacity, auto* count) {
                    return conn_map_common_neighbours(map, a, b,
                                                      between ? built.lists.data() : nullptr,
                                                      between ? 1 : 0, slots, capacity, count);
                });
            };
            EXPECT_EQ(ask(false), common(a, b, false));
            EXPECT_EQ(ask(true), common(a, b, true));
            Slots all;
            const Slots &of_a = rows[static_cast<std::size_t>(a)],
                        &of_b = rows[static_cast<std::size_t>(b)];
            std::ranges::set_union(of_a, of_b, std::back_inserter(all));
            EXPECT_EQ(two_calls<std::int32_t>([&](auto* slots, auto capacity, auto* count) {
                          return conn_map_all_neighbours(map, a, b, slots, capacity, count);
                      }),
                      all);
        }
}

TEST_F(CapiDerived, questions_about_nodes_without_a_row_are_refused) {
    std::int64_t count = 0;
    Slots slots(n);
    EXPECT_TRUE(fails(conn_map_all_neighbours(map, 0, n, slots.data(), n, &count), CONN_E_ARGUMENT,
                      {"slot 120", "[0, 120)"}));
    EXPECT_TRUE(fails(conn_map_common_neighbours(map, -1, 3, nullptr, 0, slots.data(), n, &count),
                      CONN_E_ARGUMENT, {"slot -1"}));
    EXPECT_TRUE(
        fails(conn_map_common_neighbours(map, 1, 3, built.lists.data(), 0, slots.data(), n, &count),
              CONN_E_ARGUMENT, {"n_lists = 0"}));
    EXPECT_TRUE(
        fails(conn_map_all_neighbours(map, 1, 2, nullptr, 0, nullptr), CONN_E_NULL, {"count"}));
    EXPECT_TRUE(
        fails(conn_map_traversal(map, 1, slots.data(), n, &count), CONN_E_ARGUMENT, {"list 1"}));
    EXPECT_TRUE(fails(conn_map_key_order(map, slots.data(), nullptr, nullptr, n, &count),
                      CONN_E_NOT_BUILT));
    set.n_internal = 60;
    ASSERT_TRUE(ok(built.nodes[0]->set(dim, set)));
    ASSERT_TRUE(ok(built.rebuild(CONN_MAP_OPTIONS_INIT)));
    EXPECT_TRUE(fails(conn_map_all_neighbours(map, 0, 61, slots.data(), n, &count), CONN_E_ARGUMENT,
                      {"slot 61", "ghost"}));
}

TEST_F(CapiDerived, views_outlive_rebuilds_patches_and_the_map_unchanged) {
    conn_rows_view overlap = CONN_ROWS_VIEW_INIT;
    conn_intersection_view view = CONN_INTERSECTION_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_overlap_acquire(map, CONN_SPACE_HOST, &overlap)));
    ASSERT_TRUE(ok(conn_map_intersection_acquire(map, CONN_SPACE_HOST, &view)));
    const std::vector<Slots> before = rows_of(overlap);
    const Slots nodes(view.slots, view.slots + view.n_entries);
    EXPECT_TRUE(fails(conn_map_intersection_acquire(map, CONN_SPACE_HOST, &view), CONN_E_ARGUMENT,
                      {"still holds"}));
    Slots keep(n, 1), ids(n);
    std::iota(ids.begin(), ids.end(), 0);
    keep.back() = 0;
    ASSERT_TRUE(ok(conn_map_patch(map, keep.data(), ids.data(), n, nullptr, 0)));
    for (const std::uint64_t seed : {5, 6, 7}) {
        ASSERT_TRUE(ok(built.nodes[0]->set(dim, random_nodes(dim, 150, seed))));
        ASSERT_TRUE(ok(built.rebuild()));
    }
    ASSERT_TRUE(ok(conn_map_destroy(&built.map.handle)));
    EXPECT_EQ(rows_of(overlap), before);
    EXPECT_EQ(Slots(view.slots, view.slots + view.n_entries), nodes);
    EXPECT_EQ(view.generation, 2u);
    EXPECT_TRUE(ok(conn_map_rows_release(&overlap)));
    EXPECT_TRUE(ok(conn_map_intersection_release(&view)));
    EXPECT_EQ(view.slots, nullptr);
    EXPECT_EQ(view.struct_size, sizeof view);
    EXPECT_TRUE(ok(conn_map_intersection_release(&view)));
    EXPECT_TRUE(ok(conn_map_intersection_release(nullptr)));
}

TEST_F(CapiDerived, what_was_not_built_cannot_be_acquired) {
    conn_map_info info = CONN_MAP_INFO_INIT;
    ASSERT_TRUE(ok(built.rebuild(CONN_MAP_OPTIONS_INIT)));
    conn_rows_view overlap = CONN_ROWS_VIEW_INIT;
    conn_intersection_view view = CONN_INTERSECTION_VIEW_INIT;
    EXPECT_TRUE(fails(conn_map_overlap_acquire(map, CONN_SPACE_HOST, &overlap), CONN_E_NOT_BUILT));
    EXPECT_TRUE(
        fails(conn_map_intersection_acquire(map, CONN_SPACE_HOST, &view), CONN_E_NOT_BUILT));
    EXPECT_EQ(view.owner, nullptr);
    options.pairs = 0;
    ASSERT_TRUE(ok(built.rebuild(options)));
    ASSERT_TRUE(ok(conn_map_get_info(map, &info)));
    ASSERT_TRUE(ok(conn_map_intersection_acquire(map, CONN_SPACE_HOST, &view)));
    EXPECT_EQ(view.n_pairs, info.n_pairs) << "intersections have a pair list";
    EXPECT_GT(view.n_pairs, 0);
    EXPECT_TRUE(ok(conn_map_intersection_release(&view)));
}

/// Pairs in key order by name, which does not depend on how the nodes are stored.
std::vector<std::pair<std::int64_t, std::int64_t>> named_pairs(
    const conn_map* map, const std::vector<std::int64_t>& names) {
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    for (const auto& [i, j] : read_lists(const_cast<conn_map*>(map)).pairs)
        pairs.emplace_back(names[static_cast<std::size_t>(i)], names[static_cast<std::size_t>(j)]);
    return pairs;
}

TEST(CapiKeyOrder, does_not_depend_on_storage_or_on_which_nodes_are_ghosts) {
    const Context context;
    NodeSet set = random_nodes(3, 90, 4);
    for (int d = 0; d < 3; ++d)  // coincident nodes, which only their names tell apart
        set.x[static_cast<std::size_t>(3 * 41 + d)] = set.x[static_cast<std::size_t>(3 * 40 + d)];
    set.h[41] = set.h[40];
    std::vector<std::int64_t> names(90);
    std::iota(names.begin(), names.end(), 1000);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    const Built first(context, 3, {set}, options);
    ASSERT_TRUE(ok(set_ids(first.lists[0], names)));
    ASSERT_TRUE(ok(first.rebuild()));
    const auto expected = named_pairs(first.map.handle, names);
    EXPECT_FALSE(expected.empty());
    NodeSet turned = set;
    for (std::size_t a = 0; a < 90; ++a) {
        std::copy_n(set.x.begin() + 3 * static_cast<std::ptrdiff_t>(89 - a), 3,
                    turned.x.begin() + 3 * static_cast<std::ptrdiff_t>(a));
        turned.h[a] = set.h[89 - a];
    }
    std::ranges::reverse(names);
    turned.n_internal = 50;
    const Built other(context, 3, {turned}, options);
    const std::vector<std::int32_t> own(40, -1);
    ASSERT_TRUE(ok(set_ids(other.lists[0], names, own)));
    ASSERT_TRUE(ok(other.rebuild()));
    EXPECT_EQ(named_pairs(other.map.handle, names), expected);
}

TEST(CapiKeyOrder, an_image_has_the_key_of_its_owner_until_nodes_are_set_anew) {
    const Context context;
    NodeSet set;
    set.x = {0.1, 0.2, 0.4, 0.9, 1.2};  // the last is the image of node 1, shifted by 1
    set.h = {0.1, 0.1, 0.1, 0.1, 0.1};
    set.n_internal = 4;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    const Built built(context, 1, {set}, options);
    const auto keys = [&] {
        std::vector<std::uint64_t> by_rank(5), by_slot(5);
        Slots ranks(5);
        std::int64_t count = 0;
        EXPECT_TRUE(ok(conn_map_key_order(built.map.handle, nullptr, ranks.data(), by_rank.data(),
                                          5, &count)));
        for (std::size_t s = 0; s < 5; ++s)
            by_slot[s] = by_rank[static_cast<std::size_t>(ranks[s])];
        return by_slot;
    };
    const auto as_its_own = keys();
    EXPECT_NE(as_its_own[4], as_its_own[1]);
    ASSERT_TRUE(ok(set_ids(built.lists[0], {}, {1})));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(keys()[4], keys()[1]);
    ASSERT_TRUE(ok(built.nodes[0]->set(1, set)));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(keys(), as_its_own);
}

TEST(CapiKeyOrder, names_that_do_not_fit_the_list_are_refused) {
    const Context context;
    NodeSet set = random_nodes(2, 10, 1);
    set.n_internal = 8;
    const Nodes nodes(context, 2, set), unset(context, 2);
    const std::vector<std::int64_t> ids(10), few(9);
    conn_nodes* const list = nodes.handle;
    EXPECT_TRUE(fails(set_ids(list, few), CONN_E_ARGUMENT, {"global_ids has 9", "10"}));
    EXPECT_TRUE(fails(set_ids(list, ids, {7}), CONN_E_ARGUMENT, {"owner has 1", "2"}));
    EXPECT_TRUE(fails(set_ids(list, ids, {7, 8}), CONN_E_ARGUMENT, {"owner[1] = 8", "[0, 8)"}));
    EXPECT_TRUE(fails(set_ids(list, ids, {-2, 0}), CONN_E_ARGUMENT, {"owner[0] = -2"}));
    EXPECT_TRUE(
        fails(conn_nodes_set_ids(unset.handle, nullptr, nullptr), CONN_E_ARGUMENT, {"never set"}));
    conn_array nowhere = conn_array_vector_int64(nullptr, 10), real = conn_array_vector(nullptr, 0);
    EXPECT_TRUE(fails(conn_nodes_set_ids(list, &nowhere, nullptr), CONN_E_NULL, {"global_ids"}));
    EXPECT_TRUE(fails(conn_nodes_set_ids(list, nullptr, &real), CONN_E_ARGUMENT,
                      {"owner.dtype = 0", "CONN_INT32"}));
    EXPECT_TRUE(ok(set_ids(list, ids, {-1, 7})));
}

TEST(CapiKeyOrder, names_may_be_of_either_width_and_have_a_stride) {
    const Context context;
    NodeSet set = random_nodes(2, 40, 3);
    set.n_internal = 30;
    for (std::size_t k = 0; k < 80; ++k) set.x[k] = 0.5;  // names alone decide
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    const Built built(context, 2, {set}, options);
    std::vector<std::int32_t> narrow(120, -7), owner(20, -1);
    std::vector<std::int64_t> wide(40), wide_owner(10, -1);
    for (std::size_t a = 0; a < 40; ++a)
        wide[39 - a] = narrow[3 * a] = static_cast<std::int32_t>((a * 17) % 40);
    conn_array names = conn_array_vector_int32(narrow.data(), 40),
               owners = conn_array_vector_int32(owner.data(), 10);
    names.stride[0] = 3, owners.stride[0] = 2;
    const auto order = [&] {
        EXPECT_TRUE(ok(built.rebuild()));
        return two_calls<std::int32_t>(
            [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                return conn_map_key_order(built.map.handle, out, nullptr, nullptr, room, count);
            });
    };
    ASSERT_TRUE(ok(conn_nodes_set_ids(built.lists[0], &names, &owners)));
    const Slots strided = order();
    for (std::size_t k = 0; k < 40; ++k)
        EXPECT_EQ(narrow[3 * static_cast<std::size_t>(strided[k])], static_cast<int>(k));
    conn_array backwards = conn_array_vector_int64(wide.data() + 39, 40);
    const conn_array own = conn_array_vector_int64(wide_owner.data(), 10);
    backwards.stride[0] = -1;
    ASSERT_TRUE(ok(conn_nodes_set_ids(built.lists[0], &backwards, &own)));
    EXPECT_EQ(order(), strided);
}

}  // namespace
}  // namespace connectivity::test
