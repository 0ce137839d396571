// SPDX-License-Identifier: BSD-3-Clause
// Sizes before a build: exact where all nodes are counted, within a few standard errors where a
// sample is; the bytes are those that the build then reports.

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
    EXPECT_LE(found.peak_bytes, 3 * map.report().total_bytes());
}

INSTANTIATE_TEST_SUITE_P(Workloads, Estimates, ::testing::Values("W1@1e5", "W3@1e5", "W7@1e5"),
                         [](const auto& name) { return std::string(name.param).substr(0, 2); });

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
