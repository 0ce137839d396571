// SPDX-License-Identifier: BSD-3-Clause
// Memory that cannot be had, at every allocation of every call: the old lists stay, equal and
// readable, and the next call is right.

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/pairwise_field.hpp>
#include <support/brute_force.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

#include "fail_each_allocation.hpp"

namespace connectivity::test {
namespace {

class Faults : public ::testing::Test {
protected:
    void SetUp() override {
        if (!can_fail) GTEST_SKIP() << "the sanitizer has a malloc of its own";
        // The OpenMP runtime ends the process where it lacks memory; one thread takes none.
        start_runtime({.n_threads = 1});
    }

    static Case small_case(std::uint64_t seed) {
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 0, 90, 20});
        c.mode = SearchMode::gather_scatter;
        return c;
    }

    /// Every allocation of a rebuild with these options, over a map that holds something else.
    void fail_rebuilds(const Case& c, const MapOptions& options) {
        const Case old = cloud(70, 5, 0.2);
        const Expected before = brute_force(old);
        ConnectivityMap map;
        rebuild(map, old);
        const std::vector<NodeList> lists = node_lists(c), old_lists = node_lists(old);
        const MapOptions old_options = map_options(old);
        const Generation generation = map.generation();
        int n_checked = 0;
        const long n = fail_each_allocation([&] { map.rebuild(lists, options); },
                                            [&] {
                                                ASSERT_EQ(map.generation(), generation);
                                                ASSERT_TRUE(equals(map, before));
                                                ++n_checked;
                                            });
        EXPECT_GT(n, 10);
        EXPECT_EQ(n_checked, n);
        map.rebuild(old_lists, old_options);
        EXPECT_TRUE(equals(map, before));
    }
};

TEST_F(Faults, a_rebuild_that_lacks_memory_leaves_the_lists) {
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        for (const SearchMethod method :
             {SearchMethod::brute, SearchMethod::cells, SearchMethod::groups}) {
            const Case c = small_case(seed);
            MapOptions options = map_options(c, method);
            options.spatial_order = seed % 2 == 0;
            fail_rebuilds(c, options);
        }
}

TEST_F(Faults, so_does_one_with_overlap_intersections_key_order_or_pairs_left_out) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const Case c = small_case(seed);
        MapOptions options = map_options(c);
        options.overlap = seed % 2 == 0;
        options.intersection = seed % 3 == 0   ? IntersectionKind::all
                               : seed % 3 == 1 ? IntersectionKind::in_segment
                                               : IntersectionKind::none;
        options.order = seed % 4 < 2 ? ListOrder::key : ListOrder::slot;
        if (seed % 5 == 0)
            options.exclude = std::make_shared<const PairPredicate>(
                [](Slot i, Slot j) { return (i + j) % 3 == 0; });
        fail_rebuilds(c, options);
    }
}

TEST_F(Faults, a_rebuild_with_a_skin_keeps_the_old_reference) {
    const Case c = small_case(1);
    MapOptions options = map_options(c);
    options.skin = 0.01;
    fail_rebuilds(c, options);
}

TEST_F(Faults, a_patch_that_lacks_memory_leaves_lists_fields_and_coupling) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const Case c = small_case(seed);
        const Expected before = brute_force(c);
        ConnectivityMap map;
        rebuild(map, c);
        map.pairs().set_coupling([](Slot i, Slot) { return 1.0 / (1 + i); });
        PairwiseField<double> field(map.pairs());
        const auto pairs = map.pairs().view();
        for (Offset k = 0; k < pairs.size(); ++k) field(k) = static_cast<double>(k);
        // Every third node goes; the others keep their order.
        std::vector<Slot> keep, old2new;
        for (std::size_t l = 0; l < c.lists.size(); ++l)
            for (Slot a = 0, next = 0; a < c.n(l); ++a) {
                keep.push_back(a % 3 != 0);
                old2new.push_back(keep.back() ? next++ : 0);
            }
        PairFieldBase* const fields[] = {&field};
        const long n =
            fail_each_allocation([&] { map.patch(keep, old2new, fields); },
                                 [&] {
                                     ASSERT_TRUE(equals(map, before)) << c.text;
                                     ASSERT_TRUE(field.is_current(map.pairs()));
                                     for (Offset k = 0; k < field.size(); ++k) {
                                         ASSERT_EQ(field(k), static_cast<double>(k));
                                         ASSERT_EQ(map.pairs().coupling(k), 1.0 / (1 + pairs[k].i));
                                     }
                                 });
        EXPECT_GT(n, 5);
        EXPECT_TRUE(field.is_current(map.pairs()));
        EXPECT_EQ(map.layout().n_slots(), std::count(keep.begin(), keep.end(), 1));
        rebuild(map, c);
        EXPECT_TRUE(equals(map, before));
    }
}

}  // namespace
}  // namespace connectivity::test
