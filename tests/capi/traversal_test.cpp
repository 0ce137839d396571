// SPDX-License-Identifier: BSD-3-Clause
// Storage-free traversal through the C interface: blocks of rows, stopping, and what a callback may
// not do.

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr std::int64_t most_neighbours = 4096;  // of a block with more than one row

/// What a callback saw, and what it answers. Callbacks come from several threads at once.
struct Host {
    std::mutex mutex;
    std::vector<int> calls;                       ///< by slot
    std::vector<std::vector<std::int32_t>> rows;  ///< by slot
    int n_blocks = 0, n_workers = 0;
    bool blocks_are_well_formed = true;
    std::atomic<int> running[64] = {};  ///< calls under way, by worker
    int stop_after = -1;                ///< blocks; -1: never
    const char* reason = nullptr;

    explicit Host(const Context& context, std::size_t n_slots) : calls(n_slots), rows(n_slots) {
        EXPECT_TRUE(ok(conn_context_threads(context.handle, &n_workers)));
    }

    std::int32_t take(std::int32_t worker, std::int64_t n, const std::int32_t* slots,
                      const std::int64_t* offsets, const std::int32_t* neighbours) {
        const bool is_alone = running[worker % 64]++ == 0;
        const std::lock_guard lock(mutex);
        blocks_are_well_formed = blocks_are_well_formed && is_alone && worker >= 0 &&
                                 worker < n_workers && n > 0 && offsets[0] == 0 &&
                                 (n == 1 || offsets[n] <= most_neighbours);
        for (std::int64_t r = 0; r < n; ++r) {
            const auto at = static_cast<std::size_t>(slots[r]);
            ++calls.at(at);
            rows[at].assign(neighbours + offsets[r], neighbours + offsets[r + 1]);
        }
        ++n_blocks;
        --running[worker % 64];
        if (stop_after < 0 || n_blocks <= stop_after) return 0;
        if (reason != nullptr) conn_set_error(reason);
        return 7;
    }

    static std::int32_t callback(void* host, std::int32_t worker, std::int64_t n_rows,
                                 const std::int32_t* slots, const std::int64_t* offsets,
                                 const std::int32_t* neighbours) {
        return static_cast<Host*>(host)->take(worker, n_rows, slots, offsets, neighbours);
    }
};

std::size_t n_slots_of(int dim, const std::vector<NodeSet>& sets) {
    std::size_t n = 0;
    for (const NodeSet& set : sets) n += set.x.size() / static_cast<std::size_t>(dim);
    return n;
}

/// Whether each slot came as often as it should, with what brute force finds.
void expect_lists(const Host& rows, const Host& halves, int dim, const std::vector<NodeSet>& sets) {
    const Lists expected = brute_force(dim, sets);
    Lists found;
    std::size_t slot = 0;
    for (const NodeSet& set : sets) {
        const std::size_t n = set.x.size() / static_cast<std::size_t>(dim);
        for (std::size_t a = 0; a < n; ++a, ++slot) {
            const bool stored = set.n_internal < 0 || a < static_cast<std::size_t>(set.n_internal);
            EXPECT_EQ(rows.calls[slot], stored ? 1 : 0) << slot;
            EXPECT_EQ(halves.calls[slot], 1) << slot;
            if (stored) found.rows.push_back(rows.rows[slot]);
            for (const std::int32_t j : halves.rows[slot])
                found.pairs.emplace_back(static_cast<std::int32_t>(slot), j);
        }
    }
    EXPECT_TRUE(found == expected);
    EXPECT_TRUE(rows.blocks_are_well_formed && halves.blocks_are_well_formed);
}

TEST(CapiTraversal, each_row_and_each_pair_comes_once_in_every_method) {
    const Context context;
    for (const int dim : {1, 2, 3})
        for (int method = CONN_METHOD_AUTOMATIC; method <= CONN_METHOD_DEVICE; ++method) {
            std::vector<NodeSet> sets = {random_nodes(dim, 700, 1), random_nodes(dim, 0, 2),
                                         random_nodes(dim, 300, 3, true)};
            sets[0].n_internal = 500;  // ghosts
            const Nodes a(context, dim, sets[0]), b(context, dim, sets[1]),
                c(context, dim, sets[2]);
            conn_map_options options = CONN_MAP_OPTIONS_INIT;
            options.method = method;
            const Map map(context, options);
            conn_nodes* const lists[] = {a.handle, b.handle, c.handle};
            Host rows(context, n_slots_of(dim, sets)), halves(context, n_slots_of(dim, sets));
            ASSERT_TRUE(
                ok(conn_map_traverse(map.handle, lists, 3, CONN_ROWS, Host::callback, &rows)));
            ASSERT_TRUE(
                ok(conn_map_traverse(map.handle, lists, 3, CONN_PAIRS, Host::callback, &halves)));
            expect_lists(rows, halves, dim, sets);
            EXPECT_EQ(map.generation(), 0u);
        }
}

class CapiTraversalOfOne : public ::testing::Test {
protected:
    conn_status traverse(std::int32_t what, conn_rows_callback callback, void* data) {
        conn_nodes* const lists[] = {nodes.handle};
        return conn_map_traverse(map.handle, lists, 1, what, callback, data);
    }

    const NodeSet set = random_nodes(3, 4000, 1);
    Context context;
    Nodes nodes{context, 3, set};
    Map map{context};
};

TEST_F(CapiTraversalOfOne, a_row_longer_than_a_block_comes_whole_and_alone) {
    NodeSet dense = random_nodes(3, 5000, 2);
    dense.h.assign(5000, 0.0);
    dense.h[17] = 10;  // everybody is its neighbour
    ASSERT_TRUE(ok(nodes.set(3, dense)));
    Host host(context, 5000);
    ASSERT_TRUE(ok(traverse(CONN_ROWS, Host::callback, &host)));
    EXPECT_TRUE(host.blocks_are_well_formed);
    EXPECT_EQ(host.rows[17].size(), 4999u);
    EXPECT_TRUE(std::ranges::all_of(host.calls, [](int n) { return n == 1; }));
}

TEST_F(CapiTraversalOfOne, held_views_and_the_generation_stay_as_they_were) {
    ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
    conn_rows_view view = CONN_ROWS_VIEW_INIT, again = CONN_ROWS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &view)));
    const NodeSet other = random_nodes(3, 2000, 9);
    ASSERT_TRUE(ok(nodes.set(3, other)));
    Host host(context, 2000);
    ASSERT_TRUE(ok(traverse(CONN_PAIRS, Host::callback, &host)));
    EXPECT_EQ(map.generation(), 1u);
    ASSERT_TRUE(ok(conn_map_rows_acquire(map.handle, CONN_SPACE_HOST, &again)));
    EXPECT_EQ(again.slots, view.slots);
    EXPECT_EQ(again.n_entries, view.n_entries);
    EXPECT_EQ(read_lists(map.handle), brute_force(3, {set}));
    EXPECT_TRUE(ok(conn_map_rows_release(&view)) && ok(conn_map_rows_release(&again)));
}

TEST_F(CapiTraversalOfOne, stops_where_the_callback_says_so_and_the_map_goes_on) {
    Host all(context, 4000);
    ASSERT_TRUE(ok(traverse(CONN_PAIRS, Host::callback, &all)));
    ASSERT_GT(all.n_blocks, 10);
    for (const char* reason : {static_cast<const char*>(nullptr), "the host's disk is full"}) {
        Host host(context, 4000);
        host.stop_after = 2, host.reason = reason;
        EXPECT_TRUE(fails(traverse(CONN_PAIRS, Host::callback, &host), CONN_E_CALLBACK,
                          {"conn_map_traverse", "returned 7", reason != nullptr ? reason : ""}));
        EXPECT_LE(host.n_blocks, 3 + host.n_workers);
        Host after(context, 4000), rows(context, 4000);
        EXPECT_TRUE(ok(traverse(CONN_PAIRS, Host::callback, &after)));
        EXPECT_TRUE(ok(traverse(CONN_ROWS, Host::callback, &rows)));
        EXPECT_STREQ(conn_last_error(), "");
        expect_lists(rows, after, 3, {set});
    }
}

/// Calls back into the library; every call must be refused.
struct Intruder {
    conn_context* context;
    conn_map* map;
    conn_nodes* nodes;
    std::atomic<int> n_refused{0}, n_calls{0};

    static std::int32_t callback(void* data, std::int32_t, std::int64_t, const std::int32_t*,
                                 const std::int64_t*, const std::int32_t*) {
        auto& own = *static_cast<Intruder*>(data);
        std::uint64_t generation = 0;
        std::int32_t threads = 0;
        conn_map* map = own.map;
        conn_rows_view view = CONN_ROWS_VIEW_INIT;
        const conn_status refused[] = {
            conn_map_rebuild(own.map, &own.nodes, 1),
            conn_map_generation(own.map, &generation),
            conn_map_traverse(own.map, &own.nodes, 1, CONN_ROWS, callback, data),
            conn_map_rows_acquire(own.map, CONN_SPACE_HOST, &view),
            conn_map_destroy(&map),
            conn_context_threads(own.context, &threads),
            conn_shutdown()};
        ++own.n_calls;
        own.n_refused += static_cast<int>(std::ranges::count(refused, CONN_E_CALLBACK));
        const bool says_why = std::strstr(conn_last_error(), "callback") != nullptr;
        return conn_version() == CONN_VERSION && says_why ? 0 : 1;
    }
};

TEST_F(CapiTraversalOfOne, a_callback_that_calls_the_library_is_refused_and_nothing_hangs) {
    Intruder intruder{context.handle, map.handle, nodes.handle};
    EXPECT_TRUE(ok(traverse(CONN_ROWS, Intruder::callback, &intruder)));
    EXPECT_GT(intruder.n_calls, 0);
    EXPECT_EQ(intruder.n_refused, 7 * intruder.n_calls);
    ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
    EXPECT_EQ(read_lists(map.handle), brute_force(3, {set}));
}

TEST_F(CapiTraversalOfOne, bad_arguments_are_refused) {
    Host host(context, 4000);
    const auto never = [](void*, std::int32_t, std::int64_t, const std::int32_t*,
                          const std::int64_t*, const std::int32_t*) {
        ADD_FAILURE() << "called";
        return 0;
    };
    EXPECT_TRUE(fails(traverse(0, never, nullptr), CONN_E_ARGUMENT, {"what = 0", "CONN_PAIRS"}));
    EXPECT_TRUE(fails(traverse(3, never, nullptr), CONN_E_ARGUMENT, {"what = 3"}));
    EXPECT_TRUE(fails(traverse(CONN_ROWS, nullptr, nullptr), CONN_E_NULL, {"callback"}));
    conn_nodes* const lists[] = {nodes.handle, nullptr};
    EXPECT_TRUE(fails(conn_map_traverse(nullptr, lists, 1, CONN_ROWS, never, nullptr), CONN_E_NULL,
                      {"map"}));
    EXPECT_TRUE(fails(conn_map_traverse(map.handle, lists, 2, CONN_ROWS, never, nullptr),
                      CONN_E_NULL, {"lists[1]"}));
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.mode = CONN_GATHER, options.pairs = 0;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_TRUE(fails(traverse(CONN_PAIRS, never, nullptr), CONN_E_ARGUMENT, {"gather_scatter"}));
    EXPECT_TRUE(ok(traverse(CONN_ROWS, Host::callback, &host)));
    NodeSet bad = set;
    bad.x[5] = 1 / 0.0;
    ASSERT_TRUE(ok(nodes.set(3, bad)));
    EXPECT_TRUE(fails(traverse(CONN_ROWS, never, nullptr), CONN_E_NONFINITE, {"node 1"}));
}

TEST(CapiSetError, keeps_the_text_of_this_thread_cut_to_2047_bytes) {
    conn_set_error("mine");
    EXPECT_STREQ(conn_last_error(), "mine");
    conn_set_error(conn_last_error() + 2);
    EXPECT_STREQ(conn_last_error(), "ne");
    conn_set_error(std::string(5000, 'x').c_str());
    EXPECT_EQ(std::string(conn_last_error()), std::string(2047, 'x'));
    conn_set_error(nullptr);
    EXPECT_STREQ(conn_last_error(), "");
}

}  // namespace
}  // namespace connectivity::test
