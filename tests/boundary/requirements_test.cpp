// SPDX-License-Identifier: BSD-3-Clause
// What packages need, collected.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>
#include <support/expect_error.hpp>

namespace connectivity::test {
namespace {

TEST(Requirements, something_is_built_if_and_only_if_anybody_asks) {
    Requirements none;
    EXPECT_FALSE(none.options().rows);
    EXPECT_FALSE(none.options().pairs);
    for (int k = 0; k < n_needs; ++k) {
        const Need need = static_cast<Need>(k);
        Requirements one;
        one.add("sph", {need});
        const MapOptions o = one.options();
        EXPECT_EQ(o.rows, need == Need::rows);
        EXPECT_EQ(o.pairs, need == Need::pairs);
        EXPECT_EQ(o.ghost_rows, need == Need::ghost_rows);
        EXPECT_EQ(o.overlap, need == Need::overlap);
        EXPECT_EQ(o.intersection == IntersectionKind::in_segment, need == Need::intersection);
        EXPECT_EQ(o.intersection == IntersectionKind::all, need == Need::unfiltered_intersection);
        EXPECT_EQ(o.order == ListOrder::key, need == Need::key_order);
        EXPECT_EQ(o.spatial_order, need == Need::spatial_order);
    }
}

TEST(Requirements, who_asked_is_remembered_once) {
    Requirements r;
    r.add("sph", {Need::rows, Need::pairs}).add("damage", {Need::rows}).add("sph", {Need::rows});
    EXPECT_EQ(r.asked_by(Need::rows), "sph, damage");
    EXPECT_EQ(r.asked_by(Need::pairs), "sph");
    EXPECT_EQ(r.asked_by(Need::overlap), "");
    EXPECT_TRUE(fails_with(Status::argument, {"name"}, [&] { r.add("", {Need::rows}); }));
}

TEST(Requirements, what_is_no_product_comes_from_the_caller) {
    MapOptions base;
    base.skin = 0.25;
    base.ghost_rows = true;
    base.method = SearchMethod::cells;
    const MapOptions o = Requirements().add("sph", {Need::pairs}).options(base);
    EXPECT_EQ(o.skin, 0.25);
    EXPECT_EQ(o.method, SearchMethod::cells);
    EXPECT_FALSE(o.ghost_rows);
    EXPECT_FALSE(o.rows);
}

TEST(Requirements, an_update_builds_and_reports_them) {
    Random random(1);
    Box box;
    Boundaries boundaries(3);
    for (int d = 0; d < 3; ++d) add_periodic(boundaries, box, d);
    const Case c = cloud_in_box(box, 50, 0.3, random);
    ConnectivityMap map;
    boundaries.update(map, node_lists(c), Requirements().add("sph", {Need::pairs}));
    EXPECT_FALSE(map.options().rows);
    EXPECT_GT(map.pairs().size(), 0);
    const ReportEntry* const pairs = boundaries.report().find("pairs");
    ASSERT_NE(pairs, nullptr);
    EXPECT_EQ(pairs->asked_by, "sph");
    EXPECT_TRUE(pairs->built);
    EXPECT_EQ(boundaries.report().find("rows"), nullptr);
    EXPECT_GT(boundaries.report().find("ghosts")->bytes, 0);
    EXPECT_GT(boundaries.report().count("ghosts_made"), 0);
}

TEST(Requirements, without_boundaries_an_update_is_a_rebuild) {
    Random random(2);
    const Case c = cloud_in_box(Box{}, 50, 0.3, random);
    Boundaries boundaries(3);
    ConnectivityMap map, plain;
    boundaries.update(map, node_lists(c), MapOptions{});
    rebuild(plain, c);
    EXPECT_EQ(boundaries.ghosts().n_ghosts(), 0);
    EXPECT_EQ(map.layout(), plain.layout());
    EXPECT_EQ(map.pairs().size(), plain.pairs().size());
    EXPECT_EQ(map.generation(), 1u);
}

}  // namespace
}  // namespace connectivity::test
