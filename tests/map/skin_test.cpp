// SPDX-License-Identifier: BSD-3-Clause
// What a skin does to lists, when a rebuild is asked for, and what is refused.

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random_case.hpp>
#include <support/skin.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two nodes just out of reach of each other at the start, and what becomes of them.
class TwoNodes : public testing::Test {
protected:
    static constexpr double skin = 0.25, h = 0.125, K = 2;

    static Case at_distance(double r, bool periodic) {
        Case c = uniform_case(3, {0.01, 0.5, 0.5, 0.01 + r, 0.5, 0.5}, h, K);
        if (periodic) {  // the short way is across the boundary
            c.lists[0].x[3] = 0.01 - r + 2;
            c.domain.periodic = {true, false, true};
            c.domain.hi = {2, 1, 2};
        }
        return c;
    }

    /// Whether the drift from one to the other is within the skin; the lists have to be complete
    /// then.
    static bool is_reused(const Case& before, const Case& after) {
        ConnectivityMap map;
        build(map, before, skin);
        const bool reused = !map.needs_rebuild(node_lists(after));
        EXPECT_EQ(reused ? missing(map, after) : 0, 0);
        return reused;
    }
};

TEST_F(TwoNodes, that_approach_each_other_may_each_use_half_the_skin) {
    for (const bool periodic : {false, true})
        for (const double part : {1 - 1e-6, 1 + 1e-6}) {
            const Case before = at_distance(K * h + skin * (1 - 1e-9), periodic);
            Case after = before;
            const double step = 0.5 * skin * part * (periodic ? -1 : 1);
            after.lists[0].x[0] += step;
            after.lists[0].x[3] -= step;
            EXPECT_EQ(is_reused(before, after), part < 1) << periodic;
        }
}

TEST_F(TwoNodes, whose_supports_grow_may_use_the_skin) {
    for (const double part : {1 - 1e-6, 1 + 1e-6})
        for (const double start : {h, 0.0}) {
            Case before = at_distance(K * start + skin * (1 - 1e-6), false), after = before;
            for (double& value : before.lists[0].h) value = start;
            after.lists[0].h = {start, start + skin * part / K};
            EXPECT_EQ(is_reused(before, after), part < 1);
        }
}

TEST_F(TwoNodes, that_move_and_grow_share_the_skin) {
    for (const double part : {1 - 1e-6, 1 + 1e-6}) {
        const Case before = at_distance(K * h + skin * (1 - 1e-9), false);
        Case after = before;
        after.lists[0].x[0] += 0.25 * skin * part;
        after.lists[0].x[3] -= 0.25 * skin * part;
        after.lists[0].h[0] += 0.5 * skin * part / K;
        EXPECT_EQ(is_reused(before, after), part < 1);
        after.lists[0].h[0] = 0;  // a support that shrinks gives nothing back
        after.lists[0].h[1] = h;
        EXPECT_TRUE(is_reused(before, after));
    }
}

TEST_F(TwoNodes, that_cross_the_boundary_have_hardly_moved) {
    Case before = at_distance(0.4, true), after = before;
    after.lists[0].x[0] += 2 - 0.02;  // the image across the lower face
    EXPECT_TRUE(is_reused(before, after));
    after.lists[0].x[0] += 2e9;  // the same node, a billion boxes away
    EXPECT_TRUE(is_reused(before, after));
    after.lists[0].x[1] += 2;  // the open axis
    EXPECT_FALSE(is_reused(before, after));
}

TEST(Skin, the_lists_hold_nothing_beyond_support_and_skin) {
    const Case c = cloud(1500, 3, 0.05);
    Case wide = c;
    for (double& h : wide.lists[0].h) h += 0.02 / 2;
    ConnectivityMap map;
    for (const SearchMethod method : all_methods) {
        build(map, c, 0.02, method);
        EXPECT_TRUE(equals(map, brute_force(wide)));
    }
}

TEST(Skin, of_zero_keeps_nothing_and_leaves_the_exact_lists) {
    const Case c = cloud(500, 3);
    ConnectivityMap map;
    EXPECT_TRUE(map.needs_rebuild(node_lists(c))) << "never built";
    build(map, c, 0.1);
    EXPECT_FALSE(map.needs_rebuild(node_lists(c)));
    EXPECT_EQ(map.drift(node_lists(c)), 0);
    const auto& entry = *map.report().find("skin");
    EXPECT_EQ(entry.bytes, static_cast<std::int64_t>(4 * 500 * sizeof(double)));
    EXPECT_EQ(entry.asked_by, "caller");
    build(map, c, 0);
    EXPECT_TRUE(equals(map, brute_force(c)));
    EXPECT_TRUE(map.needs_rebuild(node_lists(c)));
    EXPECT_EQ(map.drift(node_lists(c)), infinity);
    EXPECT_EQ(map.report().find("skin")->bytes, 0);
    EXPECT_EQ(map.report().find("skin")->ms, 0);
    EXPECT_FALSE(map.report().find("skin")->built);
}

TEST(Skin, other_shapes_need_a_rebuild) {
    const Case c = cloud(50, 3);
    ConnectivityMap map;
    build(map, c, 10);
    const auto needs = [&](const std::function<void(Case&)>& change) {
        Case other = c;
        change(other);
        return map.needs_rebuild(node_lists(other));
    };
    EXPECT_FALSE(needs([](Case&) {}));
    EXPECT_TRUE(needs([](Case& o) { o.lists[0].n_internal = 49; }));
    EXPECT_TRUE(needs([](Case& o) { o.lists.push_back(o.lists[0]); }));
    EXPECT_TRUE(needs([](Case& o) { o.lists[0].extent = 1.5; }));
    EXPECT_TRUE(needs([](Case& o) { o = cloud(51, 3); }));
    EXPECT_TRUE(needs([](Case& o) { o = cloud(49, 3); }));
    EXPECT_TRUE(needs([](Case& o) { o = uniform_case(2, std::vector<double>(100, 0.5), 0.1); }));
    EXPECT_TRUE(needs([](Case& o) {
        o.lists[0].tensor = true;
        for (int k = 0; k < 50; ++k) o.lists[0].H.insert(o.lists[0].H.end(), {10, 0, 0, 10, 0, 10});
    }));
    EXPECT_TRUE(map.needs_rebuild({}));
}

TEST(Skin, bad_values_need_a_rebuild_which_names_them) {
    const Case c = cloud(50, 3);
    Case tensors = c;
    tensors.lists[0].tensor = true;
    for (int k = 0; k < 50; ++k)
        tensors.lists[0].H.insert(tensors.lists[0].H.end(), {10, 1, 0, 10, 0, 10});
    for (const double bad : {nan, infinity, -infinity}) {
        ConnectivityMap map;
        build(map, c, 1e6);
        Case other = c;
        other.lists[0].x[77] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        EXPECT_TRUE(fails_with(Status::nonfinite, {"node 25"}, [&] { build(map, other, 1e6); }));
        EXPECT_EQ(map.drift(node_lists(c)), 0) << "the failed rebuild left its mark";
        other = c;
        other.lists[0].h[7] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        other.lists[0].h[7] = -1e-3;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        build(map, tensors, 1e6);
        other = tensors;
        other.lists[0].H[6 * 7] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
    }
}

TEST(Skin, outside_its_range_is_refused) {
    ConnectivityMap map;
    for (const double bad : {-1.0, -1e-300, 1e-101, 1e101, nan, infinity, -infinity})
        EXPECT_TRUE(
            fails_with(Status::argument, {"skin = "}, [&] { build(map, cloud(20, 1), bad); }));
}

TEST(Skin, counts_towards_half_a_periodic_box) {
    Case c = cloud(50, 3, 0.2);
    c.domain.periodic = {true, true, true};
    c.domain.hi = {1, 1, 1};
    ConnectivityMap map;
    for (const SearchMethod method : all_methods) {  // half the box, and a few roundings
        build(map, c, 0.1, method);
        EXPECT_EQ(missing(map, c), 0);
    }
    EXPECT_TRUE(fails_with(Status::half_box, {"node 0", "0.51"}, [&] { build(map, c, 0.11); }));
}

TEST(Skin, needs_tensors_that_can_be_widened) {
    const Case good = tensor_case(2, {0, 0, 1, 1}, {1e6, 0, 1e-6, 1, 0, 1});
    ConnectivityMap map;
    build(map, good, 0.1);
    const Case bad = tensor_case(2, {0, 0, 1, 1}, {1, 0, 1, 1e10, 0, 1e-10});
    build(map, bad, 0);
    EXPECT_TRUE(fails_with(Status::not_spd, {"node 1", "condition number", "skin"},
                           [&] { build(map, bad, 0.1); }));
}

TEST(Skin, what_it_saved_is_counted) {
    const Case c = cloud(50, 3);
    Case moved = c;
    moved.lists[0].x[0] += 0.25;
    ConnectivityMap map;
    build(map, c, 1);
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(map.needs_rebuild(node_lists(moved)));
    moved.lists[0].x[0] += 10;
    EXPECT_TRUE(map.needs_rebuild(node_lists(moved)));
    build(map, c, 1);
    EXPECT_EQ(map.reuse().rebuilds, 2);
    EXPECT_EQ(map.reuse().reuses, 3);
    EXPECT_DOUBLE_EQ(map.reuse().max_drift, 0.5);
    EXPECT_EQ(map.report().count("rebuilds"), 2);
    EXPECT_EQ(map.report().count("reuses"), 3);
    EXPECT_EQ(map.report().count("max_drift_ppm"), 500000);
}

}  // namespace
}  // namespace connectivity::test
