// SPDX-License-Identifier: BSD-3-Clause
// validate: passes for every map that is right, and names the law that a wrong one breaks.

#include <gtest/gtest.h>

#include <connectivity/map/validate.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

::testing::AssertionResult passes(const ConnectivityMap& map, const Case& c) {
    std::string text;
    return all_passed(validate(map, node_lists(c)), &text) ? ::testing::AssertionSuccess()
                                                           : ::testing::AssertionFailure() << text;
}

MapOptions options_of_kind(const Case& c, std::uint64_t kind) {
    MapOptions options = map_options(c);
    options.order = kind & 1 ? ListOrder::key : ListOrder::slot;
    if (c.mode == SearchMode::gather_scatter) {
        options.overlap = (kind & 2) != 0;
        options.intersection = (kind & 4) != 0   ? IntersectionKind::all
                               : (kind & 8) != 0 ? IntersectionKind::in_segment
                                                 : IntersectionKind::none;
        if (kind & 16)
            options.exclude = std::make_shared<const PairPredicate>(
                [](Slot i, Slot j) { return (i + j) % 4 == 0; });
    }
    return options;
}

TEST(Validate, every_map_that_is_built_passes) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 320; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 70});
        map.rebuild(node_lists(c), options_of_kind(c, seed / 3));
        ASSERT_TRUE(passes(map, c)) << c.text;
    }
}

TEST(Validate, what_a_patch_leaves_passes) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 70});
        c.lists.resize(1);
        map.rebuild(node_lists(c), options_of_kind(c, seed % 2));
        // The last nodes go, so that the case is cut short.
        const auto n = static_cast<std::size_t>(c.n(0)), left = n / 2;
        std::vector<Slot> keep(n, 0), ids(n, -1);
        for (std::size_t k = 0; k < left; ++k) keep[k] = 1, ids[k] = static_cast<Slot>(k);
        map.patch(keep, ids);
        ListData& list = c.lists[0];
        list.n_internal = std::min(list.n_internal, static_cast<Offset>(left));
        list.x.resize(left * static_cast<std::size_t>(c.dim));
        if (!list.h.empty()) list.h.resize(left);
        list.H.resize(list.tensor ? left * static_cast<std::size_t>(n_symmetric(c.dim)) : 0);
        ASSERT_TRUE(passes(map, c)) << c.text;
    }
}

/// Names of the checks that fail.
std::vector<std::string> broken(const ConnectivityMap& map, const Case& c) {
    std::vector<std::string> names;
    for (const MapCheck& check : validate(map, node_lists(c)))
        if (!check.passed) {
            names.push_back(check.name);
            EXPECT_FALSE(check.first.empty());
        }
    return names;
}

bool names_one_of(const std::vector<std::string>& names, const std::string& wanted) {
    return std::find(names.begin(), names.end(), wanted) != names.end();
}

/// A map whose lists the test spoils through their own memory.
class Spoiled : public ::testing::Test {
protected:
    void build(std::uint64_t kind) { map.rebuild(node_lists(c), options_of_kind(c, kind)); }
    static Slot& at(const ConstView<Slot>& view, Offset k) {
        return const_cast<Slot&>(view(static_cast<std::size_t>(k)));
    }
    Case c = cloud(60, 9, 0.2);
    ConnectivityMap map;
};

TEST_F(Spoiled, rows_out_of_order_are_named) {
    build(0);
    std::swap(at(map.rows().slots, 0), at(map.rows().slots, 1));
    EXPECT_TRUE(names_one_of(broken(map, c), "rows_ascend_without_self"));
}

TEST_F(Spoiled, a_row_with_a_stranger_is_named) {
    build(0);
    // The first entry becomes a lower slot that is no neighbour.
    for (Offset row = 1; row < map.rows().n_rows(); ++row) {
        const Offset begin = map.rows().offsets(row);
        if (map.rows()[row].size() == 0 || map.rows().slots(begin) == 0 || row == 0) continue;
        at(map.rows().slots, begin) = 0;
        break;
    }
    const auto names = broken(map, c);
    EXPECT_TRUE(names_one_of(names, "rows_hold_neighbours_only"));
    EXPECT_TRUE(names_one_of(names, "rows_miss_nobody"));
}

TEST_F(Spoiled, pairs_that_are_none_are_named) {
    build(0);
    const auto pairs = map.pairs().view();
    for (Slot i = 0; i < 59; ++i)
        if (pairs.offsets(i + 1) > pairs.offsets(i) && pairs.find(i, 59) < 0) {
            at(pairs.j, pairs.offsets(i + 1) - 1) = 59;
            break;
        }
    const auto names = broken(map, c);
    EXPECT_TRUE(names_one_of(names, "pairs_are_neighbours_with_a_stored_row"));
    EXPECT_TRUE(names_one_of(names, "pairs_are_all_of_the_rows"));
}

TEST_F(Spoiled, overlap_that_is_not_mutual_is_named) {
    build(2);
    const RowsView<> overlap = map.overlap();
    for (Offset row = 0; row < 60; ++row)
        if (const auto entries = overlap[row];
            entries.size() > 0 && entries.size() < 59 && *entries.begin() > 1) {
            at(overlap.slots, overlap.offsets(row)) = 0;
            break;
        }
    EXPECT_TRUE(names_one_of(broken(map, c), "overlap_is_symmetric"));
}

TEST_F(Spoiled, an_intersection_without_its_ends_is_named) {
    build(4);
    const IntersectionView<> common = map.intersection();
    at(common.slots, 0) = common.slots(0) == 0 ? -1 : 0;
    EXPECT_TRUE(names_one_of(broken(map, c), "intersections_hold_both_ends_and_common_neighbours"));
}

TEST_F(Spoiled, keys_out_of_order_are_named) {
    build(1);
    std::swap(at(map.key_order().slots, 3), at(map.key_order().slots, 4));
    EXPECT_TRUE(names_one_of(broken(map, c), "ranks_and_slots_undo_each_other"));
}

TEST_F(Spoiled, nodes_that_moved_away_are_noticed) {
    build(0);
    c.lists[0].x[0] += 10;
    EXPECT_TRUE(names_one_of(broken(map, c), "rows_hold_neighbours_only"));
}

TEST(Validate, other_lists_are_refused) {
    const Case c = cloud(20, 1), other = cloud(21, 1);
    ConnectivityMap map;
    EXPECT_TRUE(fails_with(Status::not_built, {"validate"}, [&] { validate(map, node_lists(c)); }));
    rebuild(map, c);
    EXPECT_TRUE(
        fails_with(Status::argument, {"differ"}, [&] { validate(map, node_lists(other)); }));
}

}  // namespace
}  // namespace connectivity::test
