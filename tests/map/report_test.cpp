// SPDX-License-Identifier: BSD-3-Clause
// The report tells what is held, what was kept from the build before, and who asked.

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

class MapReport : public testing::Test {
protected:
    const ReportEntry& build(SearchMethod method, bool order, bool pairs = true) {
        MapOptions options = map_options(nodes, method);
        options.spatial_order = order;
        options.pairs = pairs;
        map.rebuild(node_lists(nodes), options);
        return entry("order");
    }
    const ReportEntry& entry(const char* product) { return *map.report().find(product); }

    const Case nodes = cloud(3000, 1);
    ConnectivityMap map;
};

TEST_F(MapReport, an_order_is_new_once_and_kept_after) {
    for (const bool asked : {false, true}) {
        map = ConnectivityMap();
        EXPECT_FALSE(build(SearchMethod::groups, asked).reused);
        EXPECT_TRUE(build(SearchMethod::groups, asked).reused);
        EXPECT_TRUE(entry("order").built);
        EXPECT_EQ(entry("order").asked_by, asked ? "caller" : "search");
    }
}

TEST_F(MapReport, scratch_memory_counts_as_reused_when_none_was_taken) {
    std::int64_t held = 0;
    int n_reused = 0;
    for (int k = 0; k < 20; ++k) {  // threads share the work anew in every build, and may need more
        build(SearchMethod::groups, false);
        EXPECT_EQ(entry("scratch").reused, entry("scratch").bytes == held);
        held = entry("scratch").bytes;
        n_reused += entry("scratch").reused;
    }
    EXPECT_GT(n_reused, 0);
    EXPECT_LT(n_reused, 20);
}

TEST_F(MapReport, what_another_method_left_behind_is_still_counted) {
    build(SearchMethod::groups, false);
    const std::int64_t order = entry("order").bytes, scratch = entry("scratch").bytes;
    EXPECT_GT(order, 0);
    for (const SearchMethod method : {SearchMethod::brute, SearchMethod::cells}) {
        build(method, false);
        EXPECT_EQ(entry("order").bytes, order);
        EXPECT_EQ(entry("scratch").bytes, scratch);
        EXPECT_FALSE(entry("order").built);
        EXPECT_EQ(entry("order").asked_by, "");
    }
}

TEST_F(MapReport, expanded_pairs_are_held_until_pairs_are_no_longer_asked_for) {
    build(SearchMethod::groups, false);
    const std::int64_t half_rows = entry("pairs").bytes;
    (void)map.pairs().expanded_view();
    build(SearchMethod::groups, false);
    // The second build takes new offsets beside the old ones.
    EXPECT_GE(entry("pairs").bytes - half_rows, 4 * map.pairs().size());
    build(SearchMethod::groups, false, false);
    EXPECT_EQ(entry("pairs").bytes, 0);
}

}  // namespace
}  // namespace connectivity::test
