// SPDX-License-Identifier: BSD-3-Clause
// Storage-free traversal: every row, or every half row, exactly once, and nothing else changes.

#include <atomic>
#include <chrono>
#include <limits>
#include <new>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <connectivity/base/parallel.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/hash.hpp>
#include <support/process.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// What a traversal handed over, by slot.
struct Seen {
    explicit Seen(Offset n_slots)
        : calls(static_cast<std::size_t>(n_slots)), row(static_cast<std::size_t>(n_slots)) {}

    auto keep() {
        return [this](int worker, Slot slot, std::span<const Slot> neighbours) {
            workers_are_numbered = workers_are_numbered && worker >= 0 && worker < n_workers();
            const auto at = static_cast<std::size_t>(slot);
            ++calls[at];
            row[at].assign(neighbours.begin(), neighbours.end());
        };
    }

    std::vector<std::atomic<int>> calls;
    std::vector<std::vector<Slot>> row;
    std::atomic<bool> workers_are_numbered{true};
};

using Range = std::pair<Offset, Offset>;

::testing::AssertionResult same(const Seen& seen, Offset slot, const std::vector<Slot>& values,
                                const Range& range) {
    const auto at = static_cast<std::size_t>(slot);
    if (seen.calls[at] != 1)
        return ::testing::AssertionFailure()
               << "slot " << slot << " came " << seen.calls[at] << " times";
    if (!std::equal(values.begin() + range.first, values.begin() + range.second,
                    seen.row[at].begin(), seen.row[at].end()))
        return ::testing::AssertionFailure()
               << "slot " << slot << " has " << seen.row[at].size() << " neighbours of "
               << range.second - range.first << ", or others";
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult are_rows(const Seen& seen, const Expected& expected) {
    const std::size_t n_lists = expected.list_offset.size() - 1;
    if (!seen.workers_are_numbered) return ::testing::AssertionFailure() << "worker out of range";
    for (std::size_t l = 0; l < n_lists; ++l) {
        const Offset first = expected.list_offset[l],
                     n_stored = expected.row_offset[l + 1] - expected.row_offset[l];
        for (Offset k = 0; k < expected.list_offset[l + 1] - first; ++k) {
            if (k >= n_stored && seen.calls[static_cast<std::size_t>(first + k)] != 0)
                return ::testing::AssertionFailure() << "slot " << first + k << " has no row";
            if (k >= n_stored) continue;
            const auto row = static_cast<std::size_t>(expected.row_offset[l] + k);
            const auto result = same(
                seen, first + k, expected.row_slots,
                {expected.row_offsets[row * n_lists], expected.row_offsets[(row + 1) * n_lists]});
            if (!result) return result;
        }
    }
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult are_half_rows(const Seen& seen, const Expected& expected) {
    if (!seen.workers_are_numbered) return ::testing::AssertionFailure() << "worker out of range";
    for (std::size_t slot = 0; slot + 1 < expected.pair_offsets.size(); ++slot) {
        const auto result = same(seen, static_cast<Offset>(slot), expected.pair_j,
                                 {expected.pair_offsets[slot], expected.pair_offsets[slot + 1]});
        if (!result) return result;
    }
    return ::testing::AssertionSuccess();
}

class TraversalCases : public ::testing::TestWithParam<std::tuple<int, bool>> {
protected:
    /// One map for all cases, so that scratch memory of every traversal serves the next one.
    void check(std::uint64_t first, std::uint64_t n_cases, int min_nodes, int max_nodes) {
        const auto [dim, periodic] = GetParam();
        for (std::uint64_t seed = first; seed < first + n_cases; ++seed) {
            const Case c = random_case(seed, {dim, periodic, max_nodes, min_nodes});
            const Expected expected = brute_force(c);
            const std::vector<NodeList> lists = node_lists(c);
            for (const SearchMethod method : all_methods) {
                const MapOptions options = map_options(c, method);
                Seen rows(c.n_slots()), halves(c.n_slots());
                map_.for_each_row(lists, options, rows.keep());
                ASSERT_TRUE(are_rows(rows, expected)) << name_of(method) << ", " << c.text;
                if (expected.pair_offsets.empty()) continue;
                map_.for_each_half_row(lists, options, halves.keep());
                ASSERT_TRUE(are_half_rows(halves, expected)) << name_of(method) << ", " << c.text;
            }
        }
    }

private:
    ConnectivityMap map_;
};

TEST_P(TraversalCases, each_row_and_each_half_row_comes_once_as_brute_force_finds_it) {
    check(0, 300, 0, 200);
    check(5000, 4, 600, 2500);
}

std::string name_of_kind(const ::testing::TestParamInfo<std::tuple<int, bool>>& info) {
    const auto [dim, periodic] = info.param;
    return std::to_string(dim) + "d_" + (periodic ? "periodic" : "open");
}

INSTANTIATE_TEST_SUITE_P(All, TraversalCases,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Bool()),
                         name_of_kind);

class Traversal : public ::testing::Test {
protected:
    const Case nodes = cloud(3000, 1);
    const std::vector<NodeList> lists = node_lists(nodes);
    ConnectivityMap map;
};

TEST_F(Traversal, private_sums_of_the_workers_count_each_pair_once) {
    const Expected expected = brute_force(nodes);
    for (const SearchMethod method : all_methods) {
        std::vector<Offset> sum(static_cast<std::size_t>(n_workers()) * 8);  // a line each
        map.for_each_half_row(
            lists, map_options(nodes, method), [&](int worker, Slot, std::span<const Slot> after) {
                sum[static_cast<std::size_t>(worker) * 8] += static_cast<Offset>(after.size());
            });
        Offset n_pairs = 0;
        for (const Offset part : sum) n_pairs += part;
        EXPECT_EQ(n_pairs, static_cast<Offset>(expected.pair_j.size())) << name_of(method);
    }
}

TEST_F(Traversal, with_a_skin_reaches_as_far_as_the_widened_supports) {
    MapOptions options = map_options(nodes);
    options.skin = 0.02;
    Case widened = nodes;
    for (double& h : widened.lists[0].h) h += options.skin / widened.kernel_extent();
    Seen rows(nodes.n_slots());
    map.for_each_row(lists, options, rows.keep());
    EXPECT_TRUE(are_rows(rows, brute_force(widened)));
}

TEST_F(Traversal, between_two_rebuilds_leaves_the_map_as_it_was) {
    MapOptions options = map_options(nodes);
    options.skin = 0.01, options.spatial_order = true;
    map.rebuild(lists, options);
    const auto rows = map.rows();
    const auto pairs = map.pairs().view();
    const auto fingerprint = [&] {
        Fnv1a hash;
        hash.add_view(rows.offsets), hash.add_view(rows.slots);
        hash.add_view(pairs.offsets), hash.add_view(pairs.j);
        hash.add_view(map.spatial_order());
        return hash.value();
    };
    const std::uint64_t before = fingerprint();
    const Case other = random_case(3, {3, true, 900, 800});
    Seen seen(other.n_slots());
    MapOptions of_other = map_options(other);
    of_other.pairs = true;  // what is asked for says nothing here
    map.for_each_row(node_lists(other), of_other, seen.keep());
    EXPECT_TRUE(are_rows(seen, brute_force(other)));
    EXPECT_EQ(fingerprint(), before);
    EXPECT_EQ(map.generation(), 1u);
    EXPECT_EQ(map.rows().data(), rows.data());
    EXPECT_EQ(map.pairs().view().data(), pairs.data());
    EXPECT_EQ(map.options(), options);
    EXPECT_EQ(map.layout().n_slots(), nodes.n_slots());
    EXPECT_EQ(map.drift(lists), 0);
    EXPECT_EQ(map.reuse().rebuilds, 1);
    map.rebuild(lists, map_options(nodes));
    EXPECT_TRUE(equals(map, brute_force(nodes)));
}

TEST_F(Traversal, of_bad_input_fails_as_a_rebuild_does) {
    const auto never = [](int, Slot, std::span<const Slot>) { FAIL() << "called"; };
    const auto fails = [&](Status status, const std::vector<std::string>& words, const Case& c,
                           const MapOptions& options) {
        return fails_with(status, words,
                          [&] { map.for_each_row(node_lists(c), options, never); }) &&
               fails_with(status, words,
                          [&] { map.for_each_half_row(node_lists(c), options, never); });
    };
    MapOptions options;
    Case bad = nodes;
    bad.lists[0].x[7] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(fails(Status::nonfinite, {"node 2"}, bad, options));
    bad = nodes;
    bad.lists[0].h[9] = -1;
    EXPECT_TRUE(fails(Status::support, {"node 9"}, bad, options));
    options.skin = -1;
    EXPECT_TRUE(fails(Status::argument, {"skin"}, nodes, options));
    options = {};
    options.domain = {{true, true, true}, {0, 0, 0}, {1, -1, 1}};
    EXPECT_TRUE(fails(Status::box, {}, nodes, options));
    options.domain.hi = {0.1, 0.1, 0.1};
    EXPECT_TRUE(fails(Status::half_box, {}, nodes, options));
    options = {};
    options.mode = SearchMode::gather;
    EXPECT_TRUE(fails_with(Status::argument, {"for_each_half_row", "gather_scatter"},
                           [&] { map.for_each_half_row(lists, options, never); }));
    EXPECT_TRUE(fails_with(Status::argument, {"for_each_row", "0 node lists"},
                           [&] { map.for_each_row({}, options, never); }));
}

TEST_F(Traversal, stops_at_an_exception_which_comes_out_and_the_map_goes_on) {
    rebuild(map, nodes);
    const Expected expected = brute_force(nodes);
    const Case many = cloud(60000, 2, 0.02);
    const std::vector<NodeList> many_lists = node_lists(many);
    for (const SearchMethod method : all_methods) {
        const bool is_slow = method == SearchMethod::brute;
        const std::vector<NodeList>& of = is_slow ? lists : many_lists;
        std::atomic<int> calls{0};
        const auto throws = [&](int, Slot slot, std::span<const Slot>) {
            const int call = ++calls;
            if (call == 100) throw std::out_of_range("slot " + std::to_string(slot));
            // The thread that throws may have lost its core: the others leave it time.
            if (call > 100) std::this_thread::sleep_for(std::chrono::microseconds(100));
        };
        EXPECT_THROW(map.for_each_row(of, map_options(nodes, method), throws), std::out_of_range);
        EXPECT_GE(calls, 100);
        EXPECT_LT(calls, of[0].n() / 2) << name_of(method);
        EXPECT_TRUE(equals(map, expected)) << name_of(method);
        // Memory that f ran out of is f's error, not the library's.
        const auto always = [](int, Slot, std::span<const Slot>) { throw std::bad_alloc(); };
        EXPECT_THROW(map.for_each_half_row(of, map_options(nodes, method), always), std::bad_alloc);
        Seen rows(nodes.n_slots());
        map.for_each_row(lists, map_options(nodes, method), rows.keep());
        EXPECT_TRUE(are_rows(rows, expected)) << name_of(method);
    }
    EXPECT_EQ(map.generation(), 1u);
}

TEST_F(Traversal, is_reported_with_no_bytes) {
    const auto nothing = [](int, Slot, std::span<const Slot>) {};
    map.for_each_row(lists, map_options(nodes, SearchMethod::groups), nothing);
    const ReportEntry* entry = map.report().find("traversal");
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->asked_by, "caller");
    EXPECT_TRUE(entry->built);
    EXPECT_FALSE(entry->reused) << "the order was new";
    EXPECT_EQ(entry->bytes, 0);
    EXPECT_GT(entry->ms, 0);
    EXPECT_GT(map.report().find("order")->bytes, 0);
    EXPECT_GT(map.report().find("scratch")->bytes, 0);
    map.for_each_half_row(lists, map_options(nodes, SearchMethod::groups), nothing);
    EXPECT_TRUE(map.report().find("traversal")->reused) << "the order was kept";
    rebuild(map, nodes);
    EXPECT_EQ(map.report().find("traversal"), nullptr) << "a report tells of one build";
}

TEST(TraversalMemory, does_not_hold_the_lists) {
    const int n = 400000;
    const Case c = cloud(n, 5, 0.0154);  // about 50 neighbours
    const std::vector<NodeList> lists = node_lists(c);
    ConnectivityMap map;
    reset_peak();
    const std::int64_t before = resident_bytes();
    std::atomic<Offset> entries{0};
    map.for_each_row(lists, {}, [&](int, Slot, std::span<const Slot> neighbours) {
        entries.fetch_add(static_cast<Offset>(neighbours.size()), std::memory_order_relaxed);
    });
    const std::int64_t grown = peak_resident_bytes() - before,
                       of_rows = entries * Offset{sizeof(Slot)} + 8 * Offset{n};
    EXPECT_GT(entries, Offset{40} * n);
    const std::int64_t held = map.report().total_bytes();
    EXPECT_LT(held, of_rows / 2);
    if (resident_bytes() == 0) GTEST_SKIP() << "this system does not tell the memory in use";
    EXPECT_TRUE(sanitized || grown < of_rows * 2 / 3)
        << grown << " bytes beside rows of " << of_rows;
}

}  // namespace
}  // namespace connectivity::test
