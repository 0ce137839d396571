// SPDX-License-Identifier: BSD-3-Clause
// Sizes before a build: exact where all nodes are counted, within a few standard errors where a
// sample is; the bytes are those that the build then reports.

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/estimate.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <connectivity/map/connectivity_map.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>
#include <support/workloads.hpp>

namespace connectivity::test {
namespace {

NodeList list_of(const Workload& workload) {
    const View<double> x = allocate<double>("x", std::ssize(workload.x)),
                       h = allocate<double>("h", workload.n);
    std::copy(workload.x.begin(), workload.x.end(), x.data());
    for (Offset k = 0; k < workload.n; ++k) h(k) = workload.R[static_cast<std::size_t>(k)] / 2;
    return NodeList::with_h("cloud", workload.dim, workload.n, x, h, 2);
}

std::int64_t reported(const ConnectivityMap& map, const char* product) {
    return map.report().find(product)->bytes;
}

class Estimates : public ::testing::TestWithParam<const char*> {};

/// The sample is always the same: a law about chance that either holds here or not.
TEST_P(Estimates, samples_are_within_three_standard_errors_of_the_build) {
    const NodeList lists[] = {list_of(make_workload(GetParam()))};
    ConnectivityMap map;
    map.rebuild(lists, {});
    const auto n_entries = static_cast<double>(map.rows().size()),
               n_pairs = static_cast<double>(map.pairs().size());
    for (const Offset n_sampled : {500, 4096, 20000}) {
        const MapEstimate found = estimate(lists, {}, {0, n_sampled});
        const double error = found.relative_error;
        EXPECT_GT(error, 0);
        EXPECT_LT(error, 1.5 / std::sqrt(static_cast<double>(n_sampled)));
        EXPECT_NEAR(static_cast<double>(found.n_entries), n_entries, 3 * error * n_entries);
        EXPECT_NEAR(static_cast<double>(found.n_pairs), n_pairs, 3 * error * n_pairs);
        EXPECT_NEAR(static_cast<double>(found.n_sampled), static_cast<double>(n_sampled),
                    4 * std::sqrt(static_cast<double>(n_sampled)));
    }
}

TEST_P(Estimates, bytes_are_those_of_the_report_and_the_peak_is_above_what_is_held) {
    const NodeList lists[] = {list_of(make_workload(GetParam()))};
    const MapEstimate found = estimate(lists, {});
    ConnectivityMap map;
    map.rebuild(lists, {});
    const auto held = static_cast<double>(reported(map, "rows") + reported(map, "pairs"));
    EXPECT_NEAR(static_cast<double>(found.bytes), held, 0.05 * held);
    EXPECT_GE(found.peak_bytes, map.report().total_bytes());
    const Offset scratch = n_workers() * (Offset{4} << 20);
    EXPECT_LE(found.peak_bytes, 2 * map.report().total_bytes() + scratch);
}

INSTANTIATE_TEST_SUITE_P(Workloads, Estimates, ::testing::Values("W1@1e5", "W3@1e5", "W7@1e5"),
                         [](const auto& name) { return std::string(name.param).substr(0, 2); });

/// The nodes of a workload in two lists, the second one with tensors if asked, and with ghosts.
std::vector<NodeList> two_lists(const Workload& all, bool tensors, bool ghosts) {
    std::vector<NodeList> lists;
    const Offset half = all.n / 2;
    for (const Offset first : {Offset{0}, half}) {
        const Offset n = first == 0 ? half : all.n - half;
        const View<double> x = allocate<double>("x", 3 * n), h = allocate<double>("h", n),
                           H = allocate_zeroed<double>("H", 6 * n);
        std::copy_n(all.x.begin() + 3 * first, 3 * n, x.data());
        for (Offset k = 0; k < n; ++k) {
            h(k) = all.R[static_cast<std::size_t>(first + k)] / 2;
            for (const int diagonal : {0, 3, 5}) H(6 * k + diagonal) = 1 / h(k);
        }
        const Offset n_internal = ghosts ? n - n / 5 : n;
        if (tensors && first > 0)
            lists.push_back(NodeList::with_H("tensors", 3, n_internal, x, H, 2));
        else
            lists.push_back(NodeList::with_h("cloud", 3, n_internal, x, h, 2));
    }
    return lists;
}

struct PeakCase {
    const char* name;
    bool two = false, tensors = false, ghosts = false, half_active = false, few_kinds = false,
         excluded = false;
    MapOptions options = {};

    friend void PrintTo(const PeakCase& c, std::ostream* out) { *out << c.name; }
};

MapOptions with(ListOrder order, bool rows = true, bool pairs = true) {
    MapOptions options;
    options.order = order, options.rows = rows, options.pairs = pairs;
    return options;
}

MapOptions with_ghost_rows() {
    MapOptions options;
    options.ghost_rows = true;
    return options;
}

class Peaks : public ::testing::TestWithParam<PeakCase> {};

TEST_P(Peaks, are_at_least_what_a_first_build_holds_and_at_most_twice_it) {
    const PeakCase& c = GetParam();
    start_runtime();  // Views of the workload are dropped before the first rebuild
    const Workload workload = make_workload("W1@1e5");
    const std::vector<NodeList> lists =
        c.two ? two_lists(workload, c.tensors, c.ghosts) : std::vector{list_of(workload)};
    MapOptions options = c.options;
    if (c.half_active) {
        const auto active = allocate<std::uint8_t>("active", workload.n);
        for (std::size_t k = 0; k < active.size(); ++k) active(k) = k % 2;
        options.active = active;
    }
    if (c.few_kinds) options.interactions = {1, 0, 0, 1};
    if (c.excluded)
        options.exclude =
            std::make_shared<const PairPredicate>([](Slot i, Slot j) { return (i + j) % 8 != 0; });
    const MapEstimate found = estimate(lists, options);
    ConnectivityMap map;
    map.rebuild(lists, options);
    EXPECT_FALSE(found.is_lower_bound);
    EXPECT_GE(found.peak_bytes, map.report().total_bytes());
    const Offset scratch = n_workers() * (Offset{4} << 20);
    EXPECT_LE(found.peak_bytes, 2 * map.report().total_bytes() + scratch);
}

INSTANTIATE_TEST_SUITE_P(
    Options, Peaks,
    ::testing::Values(
        PeakCase{.name = "rows", .options = with(ListOrder::slot, true, false)},
        PeakCase{.name = "pairs", .options = with(ListOrder::slot, false, true)},
        PeakCase{.name = "ghosts", .two = true, .ghosts = true},
        PeakCase{.name = "ghost_rows", .two = true, .ghosts = true, .options = with_ghost_rows()},
        PeakCase{.name = "tensors", .two = true, .tensors = true},
        PeakCase{.name = "active", .half_active = true},
        PeakCase{.name = "excluded", .excluded = true},
        PeakCase{.name = "excluded_rows",
                 .excluded = true,
                 .options = with(ListOrder::slot, true, false)},
        PeakCase{.name = "excluded_pairs",
                 .excluded = true,
                 .options = with(ListOrder::slot, false, true)},
        PeakCase{.name = "few_kinds", .two = true, .few_kinds = true},
        PeakCase{.name = "excluded_ghost_rows",
                 .two = true,
                 .ghosts = true,
                 .excluded = true,
                 .options = with_ghost_rows()},
        PeakCase{.name = "key_order", .options = with(ListOrder::key)},
        PeakCase{.name = "pairs_in_key_order", .options = with(ListOrder::key, false, true)},
        PeakCase{
            .name = "active_in_key_order", .half_active = true, .options = with(ListOrder::key)},
        PeakCase{.name = "everything_in_key_order",
                 .two = true,
                 .tensors = true,
                 .ghosts = true,
                 .half_active = true,
                 .few_kinds = true,
                 .excluded = true,
                 .options = with(ListOrder::key)}),
    [](const auto& c) { return std::string(c.param.name); });

TEST(Estimate, says_that_overlap_and_intersections_are_not_in_it) {
    const NodeList lists[] = {list_of(make_workload("W1@1e4"))};
    MapOptions options;
    EXPECT_FALSE(estimate(lists, options).is_lower_bound);
    options.overlap = true;
    EXPECT_TRUE(estimate(lists, options).is_lower_bound);
    options.overlap = false;
    options.intersection = IntersectionKind::all;
    EXPECT_TRUE(estimate(lists, options).is_lower_bound);
}

TEST(Estimate, of_all_nodes_is_exact_in_every_kind_of_case) {
    int n_pairs = 0;
    for (std::uint64_t seed = 0; seed < 240; ++seed) {
        Random random(seed);
        const Case c = random_case(seed, {1 + static_cast<int>(seed % 3), seed % 2 == 0});
        const std::vector<NodeList> lists = node_lists(c);
        MapOptions options = map_options(c);
        if (random.chance(0.3)) options.skin = 0.01;
        if (random.chance(0.3)) {
            const auto active = allocate<std::uint8_t>("active", c.n_slots());
            for (std::size_t k = 0; k < active.size(); ++k) active(k) = random.chance(0.5) ? 1 : 0;
            options.active = active;
        }
        if (random.chance(0.3))
            options.exclude = std::make_shared<const PairPredicate>(
                [](Slot i, Slot j) { return (i + j) % 3 == 0; });
        if (random.chance(0.3)) options.order = ListOrder::key;
        if (random.chance(0.3)) options.ghost_rows = true;
        if (random.chance(0.3)) options.spatial_order = true;
        if (lists.size() > 1 && random.chance(0.3)) {
            options.interactions.assign(lists.size() * lists.size(), 1);
            options.interactions[1] = options.interactions[lists.size()] = 0;
        }
        ConnectivityMap map;
        try {
            map.rebuild(lists, options);
        } catch (const Error& error) {  // a skin that no half box has room for
            EXPECT_EQ(error.status(), Status::half_box);
            continue;
        }
        const MapEstimate found = estimate(lists, options);
        EXPECT_EQ(found.relative_error, 0) << c.text;
        EXPECT_EQ(found.n_entries, map.rows().size()) << c.text;
        EXPECT_EQ(found.n_pairs, options.pairs ? map.pairs().size() : 0) << c.text;
        EXPECT_TRUE(found.is_lower_bound || found.peak_bytes >= map.report().total_bytes())
            << c.text;
        n_pairs += found.n_pairs > 0 ? 1 : 0;
    }
    EXPECT_GT(n_pairs, 50);
}

TEST(Estimate, bytes_of_a_first_build_are_exact_with_orders_too) {
    const NodeList lists[] = {list_of(make_workload("W1@1e4"))};
    for (const ListOrder order : {ListOrder::slot, ListOrder::key}) {
        MapOptions options;
        options.order = order;
        const MapEstimate found = estimate(lists, options);
        ConnectivityMap map;
        map.rebuild(lists, options);
        EXPECT_EQ(found.n_entries, map.rows().size());
        std::int64_t held = reported(map, "rows") + reported(map, "pairs");
        if (order == ListOrder::key) held += 16 * lists[0].n();  // without the sort's memory
        EXPECT_EQ(found.bytes, held);
    }
}

TEST(Estimate, bad_requests_and_nodes_fail_as_a_rebuild_does) {
    const NodeList lists[] = {list_of(make_workload("W1@1e4"))};
    MapOptions options;
    options.mode = SearchMode::gather;
    EXPECT_TRUE(
        fails_with(Status::argument, {"pairs exist only"}, [&] { estimate(lists, options); }));
    EXPECT_TRUE(fails_with(Status::argument, {"0 node lists"}, [&] { estimate({}, {}); }));
    Workload broken = make_workload("W1@1e4");
    broken.x[5] = std::nan("");
    const NodeList bad[] = {list_of(broken)};
    EXPECT_TRUE(fails_with(Status::nonfinite, {"node 1"}, [&] { estimate(bad, {}); }));
}

}  // namespace
}  // namespace connectivity::test
