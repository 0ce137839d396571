// SPDX-License-Identifier: BSD-3-Clause
// A map that counts nodes from 1 says and takes what one that counts from 0 does, each number of a
// node larger by one; positions are the same.

#include <algorithm>
#include <mutex>
#include <numeric>
#include <set>

#include <connectivity_query.h>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using Slots = std::vector<std::int32_t>;

Slots shifted(Slots slots) {
    for (std::int32_t& slot : slots) ++slot;
    return slots;
}

std::vector<NodeSet> two_lists() {
    std::vector<NodeSet> sets{random_nodes(2, 90, 1), random_nodes(2, 60, 2)};
    sets[0].n_internal = 70;
    sets[1].n_internal = 40;
    return sets;
}

conn_map_options counting_from(int base) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.index_base = base;
    return options;
}

/// The same map twice.
struct Both {
    Context context;
    Built zero, one;
    explicit Both(conn_map_options options = CONN_MAP_OPTIONS_INIT)
        : zero(context, 2, two_lists(), with(options, 0)),
          one(context, 2, two_lists(), with(options, 1)) {}

    static conn_map_options with(conn_map_options options, int base) {
        options.index_base = base;
        return options;
    }
    /// list(map) counts its nodes from the base of the map.
    template <class List>
    void expect_shifted(const List& list) const {
        const Slots from_zero = list(zero.map.handle);
        EXPECT_FALSE(from_zero.empty());
        EXPECT_EQ(list(one.map.handle), shifted(from_zero));
    }
    template <class Value>
    void expect_equal(const Value& value) const {
        EXPECT_EQ(value(one.map.handle), value(zero.map.handle));
    }
};

/// What a view of rows holds: slots, or offsets.
template <class Acquire>
std::pair<Slots, std::vector<std::int64_t>> rows_in(const Acquire& acquire, conn_map* map) {
    conn_rows_view view = CONN_ROWS_VIEW_INIT;
    EXPECT_TRUE(ok(acquire(map, CONN_SPACE_HOST, &view)));
    std::pair<Slots, std::vector<std::int64_t>> out{
        {view.slots, view.slots + view.n_entries},
        {view.offsets, view.offsets + view.n_rows * view.n_lists + 1}};
    for (int l = 0; l <= view.n_lists; ++l) out.second.push_back(view.list_offset[l]);
    EXPECT_TRUE(ok(conn_map_rows_release(&view)));
    return out;
}

struct PairArrays {
    Slots i, j, slots, ranks;
    std::vector<std::int64_t> offsets;
};
PairArrays pairs_in(conn_map* map) {
    conn_pairs_view view = CONN_PAIRS_VIEW_INIT;
    EXPECT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &view)));
    PairArrays out{{view.i, view.i + view.n_pairs},
                   {view.j, view.j + view.n_pairs},
                   {},
                   {},
                   {view.offsets, view.offsets + view.n_slots + 1}};
    if (view.slots != nullptr) out.slots.assign(view.slots, view.slots + view.n_slots);
    if (view.ranks != nullptr) out.ranks.assign(view.ranks, view.ranks + view.n_slots);
    EXPECT_TRUE(ok(conn_map_pairs_release(&view)));
    return out;
}

TEST(CapiIndexBase, views_of_all_lists_count_nodes_from_one_and_positions_from_zero) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.overlap = 1;
    options.intersection = CONN_INTERSECTION_ALL;
    options.order = CONN_ORDER_KEY;
    const Both both(options);
    for (const auto acquire : {conn_map_rows_acquire, conn_map_overlap_acquire}) {
        both.expect_shifted([&](conn_map* map) { return rows_in(acquire, map).first; });
        both.expect_equal([&](conn_map* map) { return rows_in(acquire, map).second; });
    }
    both.expect_shifted([](conn_map* map) { return pairs_in(map).i; });
    both.expect_shifted([](conn_map* map) { return pairs_in(map).j; });
    both.expect_shifted([](conn_map* map) { return pairs_in(map).slots; });
    both.expect_equal([](conn_map* map) { return pairs_in(map).ranks; });
    both.expect_equal([](conn_map* map) { return pairs_in(map).offsets; });
    both.expect_shifted([](conn_map* map) {
        conn_intersection_view view = CONN_INTERSECTION_VIEW_INIT;
        EXPECT_TRUE(ok(conn_map_intersection_acquire(map, CONN_SPACE_HOST, &view)));
        const Slots out(view.slots, view.slots + view.n_entries);
        EXPECT_TRUE(ok(conn_map_intersection_release(&view)));
        return out;
    });
}

TEST(CapiIndexBase, orders_count_nodes_from_one_and_ranks_from_zero) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    options.spatial_order = 1;
    const Both both(options);
    for (int list = 0; list < 2; ++list)
        for (const auto order : {conn_map_spatial_order, conn_map_traversal})
            both.expect_shifted([&](conn_map* map) {
                return two_calls<std::int32_t>(
                    [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                        return order(map, list, out, room, count);
                    });
            });
    const auto key_order = [](conn_map* map, bool ranks) {
        return two_calls<std::int32_t>(
            [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                return conn_map_key_order(map, ranks ? nullptr : out, ranks ? out : nullptr,
                                          nullptr, room, count);
            });
    };
    both.expect_shifted([&](conn_map* map) { return key_order(map, false); });
    both.expect_equal([&](conn_map* map) { return key_order(map, true); });
}

TEST(CapiIndexBase, questions_about_two_nodes_count_from_one) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.ghost_rows = 1;
    const Both both(options);
    const PairArrays pairs = pairs_in(both.zero.map.handle);
    const Slots i1 = shifted(pairs.i), j1 = shifted(pairs.j);
    const auto n = static_cast<std::int64_t>(i1.size());
    std::vector<std::int64_t> found(i1.size()), counted(i1.size());
    std::iota(counted.begin(), counted.end(), 0);
    ASSERT_TRUE(
        ok(conn_map_find_pairs(both.one.map.handle, n, i1.data(), j1.data(), found.data())));
    EXPECT_EQ(found, counted);
    const std::int32_t none = 0, some = 1;
    ASSERT_TRUE(ok(conn_map_find_pairs(both.one.map.handle, 1, &none, &some, found.data())));
    EXPECT_EQ(found[0], -1);
    for (std::size_t k = 0; k < i1.size(); k += 29) {
        const auto common = [&](const Built& built, std::int32_t a, std::int32_t b, int n_lists) {
            return two_calls<std::int32_t>(
                [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                    return conn_map_common_neighbours(built.map.handle, a, b,
                                                      n_lists > 0 ? built.lists.data() : nullptr,
                                                      n_lists, out, room, count);
                });
        };
        const auto all = [&](const Built& built, std::int32_t a, std::int32_t b) {
            return two_calls<std::int32_t>(
                [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                    return conn_map_all_neighbours(built.map.handle, a, b, out, room, count);
                });
        };
        for (const int n_lists : {0, 2})
            EXPECT_EQ(common(both.one, i1[k], j1[k], n_lists),
                      shifted(common(both.zero, pairs.i[k], pairs.j[k], n_lists)));
        EXPECT_EQ(all(both.one, i1[k], j1[k]), shifted(all(both.zero, pairs.i[k], pairs.j[k])));
    }
    std::int64_t count = 0;
    EXPECT_TRUE(fails(conn_map_all_neighbours(both.one.map.handle, 0, 1, nullptr, 0, &count),
                      CONN_E_ARGUMENT));
    EXPECT_TRUE(
        fails(conn_map_all_neighbours(both.one.map.handle, INT32_MIN, 1, nullptr, 0, &count),
              CONN_E_ARGUMENT));
    EXPECT_TRUE(ok(conn_map_all_neighbours(both.one.map.handle, 150, 1, nullptr, 0, &count)));
    EXPECT_TRUE(fails(conn_map_all_neighbours(both.one.map.handle, 151, 1, nullptr, 0, &count),
                      CONN_E_ARGUMENT));
}

/// Everything that a traversal shows, as (node, neighbour).
std::set<std::pair<int, int>> traversed(const Built& built, int what) {
    struct Seen {
        std::mutex mutex;
        std::set<std::pair<int, int>> entries;
    } seen;
    const conn_rows_callback collect = [](void* data, std::int32_t, std::int64_t n_rows,
                                          const std::int32_t* slots, const std::int64_t* offsets,
                                          const std::int32_t* neighbours) {
        auto& to = *static_cast<Seen*>(data);
        const std::lock_guard lock(to.mutex);
        for (std::int64_t r = 0; r < n_rows; ++r)
            for (std::int64_t k = offsets[r]; k < offsets[r + 1]; ++k)
                to.entries.emplace(slots[r], neighbours[k]);
        return 0;
    };
    EXPECT_TRUE(
        ok(conn_map_traverse(built.map.handle, built.lists.data(), 2, what, collect, &seen)));
    return seen.entries;
}

TEST(CapiIndexBase, traversals_count_from_one) {
    const Both both;
    for (const int what : {CONN_ROWS, CONN_PAIRS}) {
        std::set<std::pair<int, int>> expected;
        for (const auto& [i, j] : traversed(both.zero, what)) expected.emplace(i + 1, j + 1);
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(traversed(both.one, what), expected);
    }
}

/// Odd where it counts from 0, hence another pair than where it counts from 1.
std::int32_t is_odd_from(void* base, std::int32_t i, std::int32_t) {
    return (i - *static_cast<const int*>(base)) % 2;
}
double coupling_from(void* base, std::int32_t i, std::int32_t j) {
    const int shift = *static_cast<const int*>(base);
    return 1.0 / (1 + (i - shift) + 3 * (j - shift));
}

TEST(CapiIndexBase, functions_of_the_host_get_numbers_from_one) {
    int bases[] = {0, 1};
    const Both both;
    const auto each = [&](const auto& call) {
        EXPECT_TRUE(ok(call(both.zero, &bases[0])));
        EXPECT_TRUE(ok(call(both.one, &bases[1])));
        both.expect_shifted([](conn_map* map) { return pairs_in(map).j; });
        both.expect_shifted([](conn_map* map) { return pairs_in(map).i; });
    };
    const std::size_t n_before = pairs_in(both.zero.map.handle).i.size();
    each([](const Built& built, int* base) {
        return conn_map_set_coupling_function(built.map.handle, coupling_from, base);
    });
    both.expect_equal([&](conn_map* map) {
        conn_pairs_view view = CONN_PAIRS_VIEW_INIT;
        EXPECT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &view)));
        const std::vector<double> out(view.coupling, view.coupling + view.n_pairs);
        EXPECT_TRUE(ok(conn_map_pairs_release(&view)));
        return out;
    });
    each([](const Built& built, int* base) {
        return conn_map_remove_pairs(built.map.handle, is_odd_from, base, nullptr, 0);
    });
    const std::size_t n_removed = pairs_in(both.zero.map.handle).i.size();
    EXPECT_LT(n_removed, n_before);
    each([](const Built& built, int* base) {
        EXPECT_TRUE(ok(conn_map_set_exclusion(built.map.handle, is_odd_from, base)));
        return built.rebuild();
    });
    EXPECT_EQ(pairs_in(both.zero.map.handle).i.size(), n_removed);
}

TEST(CapiIndexBase, patches_take_new_numbers_from_one) {
    const Both both;
    std::vector<std::int32_t> keep(150, 1), old2new(150), from_one(150);
    for (int k = 0; k < 150; ++k)  // internal nodes of each list turned round, one ghost dropped
        old2new[static_cast<std::size_t>(k)] = k < 70    ? 69 - k
                                               : k < 90  ? k
                                               : k < 130 ? 39 - (k - 90)
                                                         : k - 90;
    keep[149] = 0;
    from_one = shifted(old2new);
    from_one[149] = INT32_MIN;
    ASSERT_TRUE(
        ok(conn_map_patch(both.zero.map.handle, keep.data(), old2new.data(), 150, nullptr, 0)));
    ASSERT_TRUE(
        ok(conn_map_patch(both.one.map.handle, keep.data(), from_one.data(), 150, nullptr, 0)));
    both.expect_shifted([](conn_map* map) { return pairs_in(map).j; });
    both.expect_shifted([](conn_map* map) { return rows_in(conn_map_rows_acquire, map).first; });
    EXPECT_TRUE(
        ok(conn_map_patch(both.zero.map.handle, keep.data(), old2new.data(), 149, nullptr, 0)));
    EXPECT_TRUE(
        fails(conn_map_patch(both.one.map.handle, keep.data(), old2new.data(), 149, nullptr, 0),
              CONN_E_ARGUMENT));
}

TEST(CapiIndexBase, copies_count_from_one) {
    const Both both;
    both.expect_shifted([](conn_map* map) {
        return two_calls<std::int32_t>(
            [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                std::int64_t n_offsets = 0;
                return conn_map_rows_copy(map, nullptr, 0, &n_offsets, out, room, count);
            });
    });
    for (const bool first : {false, true})
        both.expect_shifted([&](conn_map* map) {
            return two_calls<std::int32_t>(
                [&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
                    return conn_map_pairs_copy(map, first ? out : nullptr, first ? nullptr : out,
                                               nullptr, room, count);
                });
        });
}

TEST(CapiIndexBase, single_node_queries_count_from_one) {
    const Context context;
    const Built built(context, 2, two_lists());
    conn_query* query[2] = {};
    for (int base = 0; base < 2; ++base) {
        const conn_map_options domain = counting_from(base);
        ASSERT_TRUE(ok(conn_query_create(context.handle, &query[base])));
        ASSERT_TRUE(ok(conn_query_update(query[base], built.lists.data(), 2, &domain)));
    }
    const double lo[] = {0.2, 0.2}, hi[] = {0.5, 0.6}, x[] = {0.5, 0.5}, normal[] = {1, 1};
    const auto ask = [&](int base, int which) {
        return two_calls<std::int32_t>([&](std::int32_t* out, std::int64_t room, std::int64_t* n) {
            conn_query* const q = query[base];
            const int mode = CONN_GATHER_SCATTER;
            switch (which) {
                case 0: return conn_query_neighbours(q, 40 + base, mode, out, room, n);
                case 1: return conn_query_neighbours_at(q, x, 0.1, nullptr, mode, out, room, n);
                case 2:
                    return conn_query_candidates(q, 40 + base, mode, CONN_CANDIDATES_COARSE, out,
                                                 room, n);
                case 3: return conn_query_near_box(q, lo, hi, mode, out, room, n);
                default: return conn_query_near_plane(q, x, normal, 0.1, mode, out, room, n);
            }
        });
    };
    for (int which = 0; which < 5; ++which) {
        EXPECT_FALSE(ask(0, which).empty());
        EXPECT_EQ(ask(1, which), shifted(ask(0, which))) << which;
    }
    std::int64_t count = 0;
    double shift[3];
    EXPECT_TRUE(fails(conn_query_neighbours(query[1], 0, CONN_GATHER, nullptr, 0, &count),
                      CONN_E_ARGUMENT));
    EXPECT_TRUE(ok(conn_query_periodic_shift(query[1], 150, 1, shift)));
    EXPECT_TRUE(fails(conn_query_periodic_shift(query[1], 151, 1, shift), CONN_E_ARGUMENT));
    for (conn_query*& q : query) conn_query_destroy(&q);
}

TEST(CapiIndexBase, views_from_one_follow_rebuilds_and_old_ones_stay) {
    const Context context;
    const Built built(context, 2, two_lists(), counting_from(1));
    conn_rows_view first = CONN_ROWS_VIEW_INIT, again = CONN_ROWS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_rows_acquire(built.map.handle, CONN_SPACE_HOST, &first)));
    ASSERT_TRUE(ok(conn_map_rows_acquire(built.map.handle, CONN_SPACE_HOST, &again)));
    EXPECT_EQ(first.slots, again.slots) << "one copy a generation";
    EXPECT_TRUE(ok(conn_map_rows_release(&again)));
    const Slots before(first.slots, first.slots + first.n_entries);
    std::vector<NodeSet> sets = two_lists();
    for (double& h : sets[0].h) h *= 1.5;
    ASSERT_TRUE(ok(built.nodes[0]->set(2, sets[0])));
    ASSERT_TRUE(ok(built.rebuild()));
    Slots expected;
    for (const auto& row : brute_force(2, sets).rows)
        for (const std::int32_t j : row) expected.push_back(j + 1);
    EXPECT_EQ(rows_in(conn_map_rows_acquire, built.map.handle).first, expected);
    EXPECT_EQ(Slots(first.slots, first.slots + first.n_entries), before);
    EXPECT_TRUE(ok(conn_map_rows_release(&first)));
}

TEST(CapiIndexBase, the_base_is_zero_or_one_and_stays) {
    const Context context;
    const Map map(context, counting_from(1));
    conn_map* made = nullptr;
    for (const int base : {-1, 2}) {
        const conn_map_options wrong = counting_from(base);
        EXPECT_TRUE(fails(conn_map_create(context.handle, &wrong, &made), CONN_E_ARGUMENT,
                          {"index_base = " + std::to_string(base), "0 or 1"}));
    }
    const conn_map_options zero = counting_from(0), one = counting_from(1);
    EXPECT_TRUE(
        fails(conn_map_set_options(map.handle, &zero), CONN_E_ARGUMENT, {"index_base", "from 1"}));
    EXPECT_TRUE(ok(conn_map_set_options(map.handle, &one)));
    EXPECT_TRUE(ok(conn_map_set_options(map.handle, nullptr)));
}

}  // namespace
}  // namespace connectivity::test
