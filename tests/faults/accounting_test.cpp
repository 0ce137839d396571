// SPDX-License-Identifier: BSD-3-Clause
// The report over all sets of flags: what nobody asked for is not there, and what is held is what
// the allocator gave.

#include <malloc.h>

#include <cmath>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/connectivity_map.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

double bytes_in_use() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Bit k of `flags` asks for product k.
MapOptions options_of(unsigned flags) {
    MapOptions options;
    options.rows = flags & 1;
    options.pairs = flags & 2;
    options.overlap = flags & 4;
    options.intersection = flags & 8 ? IntersectionKind::in_segment : IntersectionKind::none;
    options.order = flags & 16 ? ListOrder::key : ListOrder::slot;
    options.spatial_order = flags & 32;
    options.ghost_rows = flags & 64;
    options.skin = flags & 128 ? 0.01 : 0;
    return options;
}
constexpr unsigned n_flag_sets = 256;

/// Two lists with ghosts, supports that differ.
Case two_lists() {
    Case c = cloud(1200, 3, 0.05);
    c.lists[0].n_internal = 1000;
    c.lists.push_back(c.lists[0]);
    c.lists[1].name = "other";
    Random random(8);
    for (double& x : c.lists[1].x) x = random.uniform();
    for (double& h : c.lists[1].h) h = 0.03 + 0.02 * random.uniform();
    return c;
}

void expect_nothing(const Report& report, const char* product, unsigned flags) {
    const ReportEntry* entry = report.find(product);
    if (entry == nullptr) return;
    EXPECT_EQ(entry->bytes, 0) << product << ", flags " << flags;
    EXPECT_EQ(entry->ms, 0) << product << ", flags " << flags;
    EXPECT_EQ(entry->asked_by, "") << product << ", flags " << flags;
    EXPECT_FALSE(entry->built) << product << ", flags " << flags;
}

TEST(Accounting, what_nobody_asked_for_has_no_bytes_and_took_no_time) {
    const Case c = two_lists();
    const std::vector<NodeList> lists = node_lists(c);
    ConnectivityMap reused;
    for (unsigned flags = 0; flags < n_flag_sets; ++flags) {
        const MapOptions options = options_of(flags);
        ConnectivityMap fresh;
        for (ConnectivityMap* map : {&fresh, &reused}) {
            map->rebuild(lists, options);
            const Report& report = map->report();
            if (!options.rows) expect_nothing(report, "rows", flags);
            if (!options.wants_pairs()) expect_nothing(report, "pairs", flags);
            if (!options.overlap) expect_nothing(report, "overlap", flags);
            if (options.intersection == IntersectionKind::none)
                expect_nothing(report, "intersection", flags);
            if (options.order == ListOrder::slot) expect_nothing(report, "key_order", flags);
            if (!options.is_derived()) expect_nothing(report, "derived", flags);
            if (options.skin == 0) expect_nothing(report, "skin", flags);
            expect_nothing(report, "patch", flags);
            for (const char* product : {"rows", "overlap", "intersection", "key_order"})
                if (const ReportEntry* entry = report.find(product); entry->built) {
                    EXPECT_GT(entry->bytes, 0) << product << ", flags " << flags;
                }
        }
        if (HasFailure()) return;
    }
}

TEST(Accounting, the_sum_of_the_report_is_what_the_allocator_gave) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the address sanitizer has an allocator of its own";
#endif
    start_runtime({.n_threads = 1});
    const Case c = two_lists();
    const std::vector<NodeList> lists = node_lists(c);
    for (unsigned flags = 1; flags < n_flag_sets; ++flags) {
        const double before = bytes_in_use();
        ConnectivityMap map;
        map.rebuild(lists, options_of(flags));
        const double held = bytes_in_use() - before;
        const auto reported = static_cast<double>(map.report().total_bytes());
        // Names, texts and the heads of blocks are not counted.
        EXPECT_NEAR(reported, held, 0.05 * held + 65536) << "flags " << flags << "\n"
                                                         << map.report().text();
        if (HasFailure()) return;
    }
}

TEST(Accounting, other_dimensions_leave_nothing_behind) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the address sanitizer has an allocator of its own";
#endif
    start_runtime({.n_threads = 1});
    for (const unsigned flags : {3u, 23u, 3u}) {
        const double before = bytes_in_use();
        ConnectivityMap map;
        double held = 0;
        for (int dim = 1; dim <= 3; ++dim) {
            const Case c = random_case(7, {dim, false, 900, 800});
            MapOptions options = options_of(flags);
            map.rebuild(node_lists(c), options);
            held = bytes_in_use() - before;
        }
        const auto reported = static_cast<double>(map.report().total_bytes());
        EXPECT_NEAR(reported, held, 0.05 * held + 262144) << "flags " << flags;
    }
}

}  // namespace
}  // namespace connectivity::test
