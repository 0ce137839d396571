// SPDX-License-Identifier: BSD-3-Clause
// Host threads with handles of their own, all at once; what they find is compared with brute force.
// ThreadSanitizer runs this, too: sh cmake/test.sh --sanitize=thread.

#include <atomic>
#include <barrier>
#include <functional>
#include <mutex>
#include <numeric>
#include <thread>

#include <capi/capi_support.hpp>

namespace connectivity::test {
namespace {

/// body(t) in n threads that begin together.
void in_threads(int n, const std::function<void(int)>& body) {
    std::barrier start(n);
    std::vector<std::thread> threads;
    for (int t = 0; t < n; ++t)
        threads.emplace_back([&, t] {
            start.arrive_and_wait();
            body(t);
        });
    for (std::thread& thread : threads) thread.join();
}

NodeSet without(const NodeSet& set, std::size_t dim, std::size_t every) {
    NodeSet less = set;
    less.x.clear(), less.h.clear();
    for (std::size_t a = 0; a < set.h.size(); ++a) {
        if (a % every == 0) continue;
        less.h.push_back(set.h[a]);
        for (std::size_t d = 0; d < dim; ++d) less.x.push_back(set.x[a * dim + d]);
    }
    return less;
}

/// Slots of i's and j's row together, ascending.
std::vector<std::int32_t> either(const Lists& lists, std::int32_t i, std::int32_t j) {
    const auto &a = lists.rows[static_cast<std::size_t>(i)],
               &b = lists.rows[static_cast<std::size_t>(j)];
    std::vector<std::int32_t> both;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
}

/// One host: everything a step of it asks of the library, with its own numbers.
class Host {
public:
    explicit Host(int t) : dim_(1 + t % 3), set_(random_nodes(dim_, n_nodes, 40 + t)) {}

    void step() {
        for (double& x : set_.x) x += 1e-3 * static_cast<double>(&x - set_.x.data());
        ASSERT_TRUE(ok(built_.nodes[0]->set(dim_, set_)));
        std::int32_t needed = 0;
        ASSERT_TRUE(ok(conn_map_needs_rebuild(map(), built_.lists.data(), 1, &needed, nullptr)));
        EXPECT_EQ(needed, 1);
        ASSERT_TRUE(ok(built_.rebuild()));
        expected_ = brute_force(dim_, {set_});
        EXPECT_EQ(read_lists(map()), expected_);
        sum();
        ask();
        traverse();
        patch();
    }

private:
    static constexpr int n_nodes = 90;
    conn_map* map() const { return built_.map.handle; }

    /// A field that is 1 for every pair sums up to the number of neighbours.
    void sum() {
        conn_pair_field* field = nullptr;
        ASSERT_TRUE(ok(conn_pair_field_create(map(), 1, &field)));
        double* data = nullptr;
        std::int64_t n_pairs = 0;
        std::int32_t n = 0;
        ASSERT_TRUE(ok(conn_pair_field_data(field, map(), &data, &n_pairs, &n)));
        std::fill_n(data, n_pairs, 1.0);
        for (const int how : {CONN_SUM_DETERMINISTIC, CONN_SUM_ATOMIC}) {
            std::vector<double> out(n_nodes), expected;
            for (const auto& row : expected_.rows)
                expected.push_back(static_cast<double>(row.size()));
            EXPECT_TRUE(
                ok(conn_pair_field_sum(field, map(), CONN_SYMMETRIC, how, out.data(), n_nodes)));
            EXPECT_EQ(out, expected);
        }
        EXPECT_TRUE(ok(conn_pair_field_destroy(&field)));
    }
    void ask() {
        const auto all = two_calls<std::int32_t>(
            [&](std::int32_t* slots, std::int64_t room, std::int64_t* count) {
                return conn_map_all_neighbours(map(), 3, 4, slots, room, count);
            });
        EXPECT_EQ(all, either(expected_, 3, 4));
    }
    void traverse() {
        struct Seen {
            std::mutex mutex;
            std::vector<std::vector<std::int32_t>> rows{n_nodes};
        } seen;
        const conn_rows_callback keep = [](void* to, std::int32_t, std::int64_t n,
                                           const std::int32_t* slots, const std::int64_t* offsets,
                                           const std::int32_t* neighbours) {
            auto& all = *static_cast<Seen*>(to);
            const std::lock_guard lock(all.mutex);
            for (std::int64_t r = 0; r < n; ++r)
                all.rows[static_cast<std::size_t>(slots[r])].assign(neighbours + offsets[r],
                                                                    neighbours + offsets[r + 1]);
            return 0;
        };
        EXPECT_TRUE(ok(conn_map_traverse(map(), built_.lists.data(), 1, CONN_ROWS, keep, &seen)));
        EXPECT_EQ(seen.rows, expected_.rows);
    }
    /// Drops every 7th node, and takes it back with the next rebuild.
    void patch() {
        std::vector<std::int32_t> keep(n_nodes, 1), old2new(n_nodes);
        std::int32_t next = 0;
        for (std::size_t a = 0; a < n_nodes; ++a)
            if (a % 7 == 0)
                keep[a] = 0;
            else
                old2new[a] = next++;
        ASSERT_TRUE(ok(conn_map_patch(map(), keep.data(), old2new.data(), n_nodes, nullptr, 0)));
        EXPECT_EQ(read_lists(map()),
                  brute_force(dim_, {without(set_, static_cast<std::size_t>(dim_), 7)}));
    }

    int dim_;
    NodeSet set_;
    Context context_;
    Built built_{context_, dim_, {set_}};
    Lists expected_;
};

TEST(HostThreads, four_with_their_own_handles_find_what_brute_force_finds) {
    in_threads(4, [](int t) {
        Host host(t);
        for (int k = 0; k < 4; ++k) host.step();
    });
}

TEST(HostThreads, eight_may_start_the_library_at_once) {
    in_threads(8, [](int t) {
        const Context context;
        const NodeSet set = random_nodes(2, 40, static_cast<std::uint64_t>(t));
        EXPECT_EQ(lists_of(context, 2, {set}), brute_force(2, {set}));
    });
}

/// Forbidden by the header, as threads see each other's work half-way through their own; but calls
/// wait for each other inside, so no call breaks anything.
TEST(HostThreads, threads_that_share_a_handle_against_the_rules_break_nothing) {
    const Context context;
    const NodeSet sets[] = {random_nodes(2, 80, 1), random_nodes(2, 60, 2)};
    const Nodes nodes[] = {{context, 2, sets[0]}, {context, 2, sets[1]}};
    const Map map(context);
    ASSERT_TRUE(ok(map.rebuild({nodes[0].handle})));
    in_threads(4, [&](int t) {
        for (int k = 0; k < 30; ++k) {
            EXPECT_TRUE(ok(map.rebuild({nodes[(t + k) % 2].handle})));
            conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
            EXPECT_TRUE(ok(conn_map_pairs_acquire(map.handle, CONN_SPACE_HOST, 0, &pairs)));
            const std::size_t which = pairs.n_slots == 80 ? 0 : 1;
            EXPECT_EQ(pairs_of(pairs), brute_force(2, {sets[which]}).pairs);
            const std::vector<std::int32_t> keep(80, 1);
            std::vector<std::int32_t> old2new(80);
            std::iota(old2new.begin(), old2new.end(), 0);
            const conn_status patched =
                conn_map_patch(map.handle, keep.data(), old2new.data(), 80, nullptr, 0);
            EXPECT_TRUE(patched == CONN_OK || patched == CONN_E_ARGUMENT) << conn_last_error();
            EXPECT_EQ(pairs_of(pairs), brute_force(2, {sets[which]}).pairs);
            EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
        }
    });
    ASSERT_TRUE(ok(map.rebuild({nodes[0].handle})));
    EXPECT_EQ(read_lists(map.handle), brute_force(2, {sets[0]}));
}

TEST(HostThreads, of_threads_that_destroy_one_handle_a_single_one_does) {
    const Context context;
    for (int k = 0; k < 20; ++k) {
        conn_map* shared = nullptr;
        ASSERT_TRUE(ok(conn_map_create(context.handle, nullptr, &shared)));
        std::atomic<int> n_destroyed{0}, n_refused{0};
        in_threads(4, [&](int) {
            conn_map* mine = shared;
            std::uint64_t generation = 1;
            const conn_status asked = conn_map_generation(mine, &generation);
            EXPECT_TRUE(asked == CONN_OK || asked == CONN_E_HANDLE);
            const conn_status status = conn_map_destroy(&mine);
            if (status == CONN_OK) ++n_destroyed;
            if (status == CONN_E_HANDLE) ++n_refused;
        });
        EXPECT_EQ(n_destroyed, 1);
        EXPECT_EQ(n_refused, 3);
    }
}

TEST(HostThreads, errors_of_one_do_not_reach_the_others) {
    const Context context;
    std::atomic<int> n_working{2};
    in_threads(3, [&](int t) {
        const NodeSet set = random_nodes(3, 60, 7);
        const Built built(context, 3, {set});
        if (t < 2) {
            const Lists expected = brute_force(3, {set});
            for (int k = 0; k < 10; ++k) {
                EXPECT_TRUE(ok(built.rebuild()));
                EXPECT_STREQ(conn_last_error(), "");
                EXPECT_EQ(read_lists(built.map.handle), expected);
            }
            --n_working;
            return;
        }
        for (std::int32_t k = 1; n_working > 0 || k < 100; ++k)
            EXPECT_TRUE(fails(conn_map_rebuild(built.map.handle, nullptr, k), CONN_E_NULL));
        EXPECT_TRUE(
            fails(conn_map_rebuild(built.map.handle, nullptr, -7), CONN_E_ARGUMENT, {"-7"}));
    });
}

TEST(HostThreads, callbacks_of_several_traversals_at_once_get_every_row_once) {
    const Context context;
    in_threads(2, [&](int t) {
        const NodeSet set = random_nodes(3, 1500, static_cast<std::uint64_t>(t));
        const Nodes nodes(context, 3, set);
        const Map map(context);
        struct Totals {
            std::atomic<std::int64_t> rows{0}, slots{0}, neighbours{0};
        } totals;
        const conn_rows_callback add = [](void* to, std::int32_t, std::int64_t n,
                                          const std::int32_t* slots, const std::int64_t* offsets,
                                          const std::int32_t*) {
            auto& sum = *static_cast<Totals*>(to);
            sum.rows += n;
            sum.slots += std::accumulate(slots, slots + n, std::int64_t{0});
            sum.neighbours += offsets[n];
            return 0;
        };
        ASSERT_TRUE(ok(conn_map_traverse(map.handle, &nodes.handle, 1, CONN_ROWS, add, &totals)));
        std::int64_t n_neighbours = 0;
        for (const auto& row : brute_force(3, {set}).rows) n_neighbours += std::ssize(row);
        EXPECT_EQ(totals.rows, 1500);
        EXPECT_EQ(totals.slots, 1500 * 1499 / 2);
        EXPECT_EQ(totals.neighbours, n_neighbours);
    });
}

}  // namespace
}  // namespace connectivity::test
