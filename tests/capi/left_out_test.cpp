// SPDX-License-Identifier: BSD-3-Clause
// What hosts leave out: pairs by a predicate, lists that do not see each other, nodes that are not
// active. Against brute force with the same left out.

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using Keep = std::function<bool(std::int32_t, std::int32_t)>;

/// Brute force without some neighbours; rows of `sets` belong to internal nodes, list by list.
Lists without(const std::vector<NodeSet>& sets, int dim, const Keep& in_row, const Keep& in_pairs) {
    Lists lists = brute_force(dim, sets);
    std::int32_t slot = 0;
    std::size_t r = 0;
    for (const NodeSet& set : sets) {
        const auto n = static_cast<std::int32_t>(set.x.size()) / dim;
        const auto n_rows = set.n_internal < 0 ? n : static_cast<std::int32_t>(set.n_internal);
        for (std::int32_t a = 0; a < n_rows; ++a)
            std::erase_if(lists.rows[r++], [&](std::int32_t j) { return !in_row(slot + a, j); });
        slot += n;
    }
    std::erase_if(lists.pairs, [&](const auto& p) { return !in_pairs(p.first, p.second); });
    return lists;
}
Lists without(const std::vector<NodeSet>& sets, int dim, const Keep& keep) {
    return without(sets, dim, keep, keep);
}

bool is_excluded(std::int32_t i, std::int32_t j) {
    return (std::min(i, j) * 7 + std::max(i, j) * 13) % 3 == 0;
}

/// A predicate of the host that looks at how it is called.
struct Excluding {
    std::atomic<int> n_calls{0}, n_wrong{0};
    static std::int32_t ask(void* data, std::int32_t i, std::int32_t j) {
        auto& self = *static_cast<Excluding*>(data);
        ++self.n_calls;
        if (i >= j || i < 0) ++self.n_wrong;
        conn_set_error("nobody reads this");
        return is_excluded(i, j) ? 5 : 0;
    }
};

/// Rows by blocks, as a rebuild would have them.
struct Rows {
    std::mutex mutex;
    std::vector<std::vector<std::int32_t>> by_slot;
    static std::int32_t take(void* data, std::int32_t, std::int64_t n, const std::int32_t* slots,
                             const std::int64_t* offsets, const std::int32_t* neighbours) {
        auto& self = *static_cast<Rows*>(data);
        const std::lock_guard lock(self.mutex);
        for (std::int64_t r = 0; r < n; ++r)
            self.by_slot[static_cast<std::size_t>(slots[r])].assign(neighbours + offsets[r],
                                                                    neighbours + offsets[r + 1]);
        return 0;
    }
};

class CapiLeftOut : public ::testing::Test {
protected:
    CapiLeftOut() {
        sets[0].n_internal = 150;
        sets[1].n_internal = 70;
        for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(ok(built.nodes[k]->set(2, sets[k])));
        EXPECT_TRUE(ok(built.rebuild()));
    }

    std::vector<std::vector<std::int32_t>> traversed(std::int32_t what) {
        Rows rows;
        rows.by_slot.resize(300);
        EXPECT_TRUE(ok(
            conn_map_traverse(built.map.handle, built.lists.data(), 2, what, Rows::take, &rows)));
        return rows.by_slot;
    }

    void expect_traversals(const Lists& expected) {
        const auto rows = traversed(CONN_ROWS), halves = traversed(CONN_PAIRS);
        Lists found;
        for (std::size_t slot = 0; slot < 300; ++slot) {
            if (slot < 150 || (slot >= 200 && slot < 270)) found.rows.push_back(rows[slot]);
            for (const std::int32_t j : halves[slot])
                found.pairs.emplace_back(static_cast<std::int32_t>(slot), j);
        }
        EXPECT_EQ(found, expected);
    }

    std::vector<NodeSet> sets{random_nodes(2, 200, 1), random_nodes(2, 100, 2)};
    Context context;
    Built built{context, 2, sets};
    conn_map* map = built.map.handle;
};

const Keep not_excluded = [](std::int32_t i, std::int32_t j) { return !is_excluded(i, j); };

TEST_F(CapiLeftOut, excluded_pairs_are_in_no_list_until_the_predicate_is_taken_back) {
    Excluding host;
    ASSERT_TRUE(ok(conn_map_set_exclusion(map, Excluding::ask, &host)));
    EXPECT_EQ(read_lists(map), brute_force(2, sets)) << "the present lists changed";
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_STREQ(conn_last_error(), "");
    const Lists expected = without(sets, 2, not_excluded);
    EXPECT_EQ(read_lists(map), expected);
    const conn_map_options options = CONN_MAP_OPTIONS_INIT;
    ASSERT_TRUE(ok(built.rebuild(options)));
    EXPECT_EQ(read_lists(map), expected) << "options took the predicate away";
    expect_traversals(expected);
    EXPECT_GT(host.n_calls, 0);
    EXPECT_EQ(host.n_wrong, 0);
    ASSERT_TRUE(ok(conn_map_set_exclusion(map, nullptr, nullptr)));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(read_lists(map), brute_force(2, sets));
}

TEST_F(CapiLeftOut, pairs_may_be_removed_from_the_lists_there_are) {
    Excluding host;
    ASSERT_TRUE(ok(conn_map_remove_pairs(map, Excluding::ask, &host, nullptr, 0)));
    EXPECT_EQ(read_lists(map), without(sets, 2, not_excluded));
    EXPECT_EQ(built.map.generation(), 3u);
    EXPECT_EQ(host.n_wrong, 0);
    EXPECT_TRUE(fails(conn_map_remove_pairs(map, nullptr, nullptr, nullptr, 0), CONN_E_NULL,
                      {"predicate"}));
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.overlap = 1;
    ASSERT_TRUE(ok(built.rebuild(options)));
    EXPECT_TRUE(fails(conn_map_remove_pairs(map, Excluding::ask, &host, nullptr, 0),
                      CONN_E_ARGUMENT, {"overlap"}));
}

TEST_F(CapiLeftOut, lists_that_do_not_interact_see_each_other_nowhere) {
    std::uint8_t sees[] = {1, 0, 0, 1};
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.interactions = sees;
    options.n_interactions = 4;
    ASSERT_TRUE(ok(conn_map_set_options(map, &options)));
    std::ranges::fill(sees, std::uint8_t{9});  // nothing of the host is kept
    ASSERT_TRUE(ok(built.rebuild()));
    const Lists expected =
        without(sets, 2, [](std::int32_t i, std::int32_t j) { return (i < 200) == (j < 200); });
    EXPECT_EQ(read_lists(map), expected);
    expect_traversals(expected);
}

TEST_F(CapiLeftOut, a_traversal_in_key_order_has_the_rows_of_ghosts_and_is_by_slot) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    ASSERT_TRUE(ok(conn_map_set_options(map, &options)));
    for (NodeSet& set : sets) set.n_internal = -1;
    Lists found;
    found.rows = traversed(CONN_ROWS);
    const auto halves = traversed(CONN_PAIRS);
    for (std::size_t slot = 0; slot < halves.size(); ++slot)
        for (const std::int32_t j : halves[slot])
            found.pairs.emplace_back(static_cast<std::int32_t>(slot), j);
    EXPECT_EQ(found, brute_force(2, sets));
}

TEST_F(CapiLeftOut, only_active_nodes_have_neighbours_and_pairs) {
    std::vector<std::uint8_t> active(300);
    for (std::size_t k = 0; k < active.size(); ++k) active[k] = k % 5 < 2 ? 1 : 0;
    const auto is_active = [&](std::int32_t slot) {
        return active[static_cast<std::size_t>(slot)] == 1;
    };
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.active = active.data();
    options.n_active = 300;
    ASSERT_TRUE(ok(built.rebuild(options)));
    const auto stored = [](std::int32_t s) { return s < 150 || (s >= 200 && s < 270); };
    EXPECT_EQ(read_lists(map),
              without(
                  sets, 2, [&](std::int32_t i, std::int32_t) { return is_active(i); },
                  [&](std::int32_t i, std::int32_t j) {
                      return (stored(i) && is_active(i)) || (stored(j) && is_active(j));
                  }));
    options.n_active = 299;
    EXPECT_TRUE(fails(built.rebuild(options), CONN_E_ARGUMENT, {"active", "299", "300"}));
}

TEST_F(CapiLeftOut, other_active_nodes_need_a_rebuild_and_the_same_do_not) {
    std::vector<std::uint8_t> active(300, 1);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.skin = 0.01;
    options.active = active.data();
    options.n_active = 300;
    ASSERT_TRUE(ok(built.rebuild(options)));
    const auto needed = [&] {
        std::int32_t answer = -1;
        EXPECT_TRUE(ok(conn_map_set_options(map, &options)));
        EXPECT_TRUE(ok(conn_map_needs_rebuild(map, built.lists.data(), 2, &answer, nullptr)));
        return answer;
    };
    EXPECT_EQ(needed(), 0);
    active[17] = 0;
    EXPECT_EQ(needed(), 1);
    active[17] = 1;
    EXPECT_EQ(needed(), 0);
    options.active = nullptr;
    options.n_active = 0;
    EXPECT_EQ(needed(), 1);
}

TEST_F(CapiLeftOut, options_outside_their_range_are_refused) {
    const Lists before = read_lists(map);
    const auto refused = [this](const std::function<void(conn_map_options&)>& spoil) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        spoil(options);
        return conn_map_set_options(map, &options);
    };
    using Options = conn_map_options;
    static const std::uint8_t flags[] = {1, 0, 2, 1};
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.overlap = 2; }), CONN_E_ARGUMENT, {"overlap = 2"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.intersection = 3; }), CONN_E_ARGUMENT,
                      {"intersection = 3", "CONN_INTERSECTION"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.order = -1; }), CONN_E_ARGUMENT, {"order = -1"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.reserved_2 = 1; }), CONN_E_UNSUPPORTED, {"reserved_2"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.n_active = 3; }), CONN_E_NULL, {"active is NULL", "3"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.interactions = flags; }), CONN_E_ARGUMENT,
                      {"n_interactions = 0"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.active = flags, o.overlap = 1; }), CONN_E_ARGUMENT,
                      {"overlap", "active"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.active = flags, o.n_active = -1; }),
                      CONN_E_ARGUMENT, {"n_active = -1"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.active = flags, o.n_active = 4; }),
                      CONN_E_ARGUMENT, {"active[2] = 2", "0 or 1"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.interactions = flags, o.n_interactions = 4; }),
                      CONN_E_ARGUMENT, {"interactions[2] = 2"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.active = flags, o.n_active = 2, o.overlap = 1; }),
                      CONN_E_ARGUMENT, {"overlap", "active"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.pairs = 0, o.mode = CONN_GATHER, o.intersection = 1; }),
              CONN_E_ARGUMENT, {"intersection", "CONN_GATHER_SCATTER"}));
    ASSERT_TRUE(ok(refused([](Options& o) { o.interactions = flags, o.n_interactions = 2; })));
    EXPECT_TRUE(fails(built.rebuild(), CONN_E_ARGUMENT, {"interactions has 2", "4"}));
    EXPECT_EQ(read_lists(map), before);
}

TEST(CapiActive, an_array_of_none_is_legal_for_lists_without_nodes_and_for_no_others) {
    const Context context;
    const std::uint8_t none[] = {0};
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.active = none;
    const Map map(context, options);
    const Nodes empty(context, 3, NodeSet{}), some(context, 3, random_nodes(3, 20, 1));
    conn_estimate estimate = CONN_ESTIMATE_INIT;
    EXPECT_TRUE(ok(map.rebuild({empty.handle})));
    EXPECT_TRUE(ok(conn_map_estimate(map.handle, &empty.handle, 1, &estimate)));
    const std::vector<std::string> words{"n_active = 0", "20"};
    EXPECT_TRUE(fails(map.rebuild({empty.handle, some.handle}), CONN_E_ARGUMENT, words));
    EXPECT_TRUE(
        fails(conn_map_estimate(map.handle, &some.handle, 1, &estimate), CONN_E_ARGUMENT, words));
    EXPECT_EQ(map.generation(), 1u);
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, nullptr)));
    EXPECT_TRUE(ok(map.rebuild({some.handle})));
}

/// Calls the library where it must not.
struct Intruder {
    conn_map* map;
    std::atomic<int> n_calls{0}, n_refused{0};
    static Intruder& intrude(void* data) {
        auto& self = *static_cast<Intruder*>(data);
        std::uint64_t generation = 0;
        ++self.n_calls;
        if (conn_map_generation(self.map, &generation) == CONN_E_CALLBACK) ++self.n_refused;
        return self;
    }
    static std::int32_t predicate(void* data, std::int32_t, std::int32_t) {
        intrude(data);
        return 0;
    }
    static double function(void* data, std::int32_t, std::int32_t) {
        intrude(data);
        return 0.5;
    }
};

TEST_F(CapiLeftOut, a_callback_that_calls_the_library_is_refused_and_nothing_hangs) {
    Intruder host{map};
    ASSERT_TRUE(ok(conn_map_set_coupling_function(map, Intruder::function, &host)));
    ASSERT_TRUE(ok(conn_map_remove_pairs(map, Intruder::predicate, &host, nullptr, 0)));
    ASSERT_TRUE(ok(conn_map_set_exclusion(map, Intruder::predicate, &host)));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_GT(host.n_calls, 0);
    EXPECT_EQ(host.n_refused, host.n_calls);
    EXPECT_EQ(read_lists(map), brute_force(2, sets));
}

}  // namespace
}  // namespace connectivity::test
