// SPDX-License-Identifier: BSD-3-Clause
// Culling against brute force: who is named, who stays, and what the map then is.

#include <set>

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>
#include <support/brute_force.hpp>
#include <support/expect_error.hpp>

namespace connectivity::test {
namespace {

struct Scene {
    Case nodes;
    Boundaries boundaries{3};

    explicit Scene(std::uint64_t seed) {
        Random random(seed);
        Box box;
        box.dim = 1 + static_cast<int>(seed % 3);
        boundaries = Boundaries(box.dim);
        for (int d = 0; d < box.dim; ++d)
            random.chance(0.5) ? add_periodic(boundaries, box, d) : add_walls(boundaries, box, d);
        nodes = cloud_in_box(box, 1 + random.below(30), 0.5, random);
    }
};

/// Controls of ghost g, itself first, down to an internal node.
std::vector<Offset> chain(const GhostLists& ghosts, int list, Offset g) {
    std::vector<Offset> nodes{g};
    for (int way = ghosts.n_ways() - 1; way >= 0; --way) {
        const GhostBlock& block = ghosts.block(way, list);
        if (g < block.first || g >= block.first + block.n) continue;
        g = block.controls()(g - block.first);
        nodes.push_back(g);
    }
    return nodes;
}

/// Nodes of each list that stay: internal, or needed by rows made by brute force.
std::vector<std::set<Offset>> wanted(const Case& made, const GhostLists& ghosts, CullRule rule) {
    const Expected e = brute_force(made);
    std::vector<std::set<Offset>> keep(made.lists.size());
    const std::set<Slot> named(e.row_slots.begin(), e.row_slots.end());
    for (std::size_t k = 0; k < keep.size(); ++k) {
        const int list = static_cast<int>(k);
        for (Offset i = 0; i < made.n(k); ++i) {
            const bool internal = i < made.lists[k].n_internal;
            const bool stays = internal || named.count(static_cast<Slot>(e.list_offset[k] + i)) > 0;
            if (stays)
                for (const Offset node : chain(ghosts, list, i)) keep[k].insert(node);
            if (rule == CullRule::controls_as_made && !internal)
                keep[k].insert(chain(ghosts, list, i)[1]);
        }
    }
    return keep;
}

class Cull : public ::testing::TestWithParam<CullRule> {};

INSTANTIATE_TEST_SUITE_P(Rules, Cull,
                         ::testing::Values(CullRule::controls_as_made, CullRule::controls_of_kept));

TEST_P(Cull, exactly_the_ghosts_that_nobody_needs_go_and_the_map_is_that_of_the_others) {
    Offset culled = 0, kept_ghosts = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Scene scene(seed);
        ConnectivityMap map;
        scene.boundaries.update(map, node_lists(scene.nodes), MapOptions{}, {false, GetParam()});
        const Case made = copy_of(scene.boundaries.lists());
        const auto keep = wanted(made, scene.boundaries.ghosts(), GetParam());
        const Offset removed = scene.boundaries.cull(map, GetParam());
        const Case after = copy_of(scene.boundaries.lists());
        Offset expected = made.n_slots();
        for (std::size_t k = 0; k < keep.size(); ++k) {
            expected -= static_cast<Offset>(keep[k].size());
            ASSERT_EQ(after.n(k), static_cast<Offset>(keep[k].size()));
            std::vector<double> x;
            for (const Offset i : keep[k])
                for (int d = 0; d < made.dim; ++d)
                    x.push_back(made.lists[k].x[static_cast<std::size_t>(i * made.dim + d)]);
            EXPECT_EQ(after.lists[k].x, x);
        }
        EXPECT_EQ(removed, expected);
        EXPECT_TRUE(equals(map, brute_force(after)));
        culled += removed, kept_ghosts += scene.boundaries.ghosts().n_ghosts();
    }
    EXPECT_GT(culled, 1000);
    EXPECT_GT(kept_ghosts, 1000);
}

TEST_P(Cull, culling_twice_is_culling_once) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Scene scene(seed);
        ConnectivityMap map;
        scene.boundaries.update(map, node_lists(scene.nodes), MapOptions{}, {true, GetParam()});
        const Case once = copy_of(scene.boundaries.lists());
        const auto generation = map.generation();
        EXPECT_EQ(scene.boundaries.cull(map, GetParam()), 0) << seed;
        EXPECT_EQ(map.generation(), generation);
        const Case twice = copy_of(scene.boundaries.lists());
        for (std::size_t k = 0; k < once.lists.size(); ++k)
            EXPECT_EQ(once.lists[k].x, twice.lists[k].x);
    }
}

TEST_P(Cull, ghosts_that_stay_keep_owners_and_images) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Scene scene(seed);
        ConnectivityMap map;
        scene.boundaries.update(map, node_lists(scene.nodes), MapOptions{}, {true, GetParam()});
        const Case before = copy_of(scene.boundaries.lists());
        scene.boundaries.refresh(node_lists(scene.nodes));  // every ghost from its control again
        const Case after = copy_of(scene.boundaries.lists());
        for (std::size_t k = 0; k < before.lists.size(); ++k) {
            EXPECT_EQ(before.lists[k].x, after.lists[k].x);
            EXPECT_EQ(before.lists[k].H, after.lists[k].H);
            const NodeList& list = scene.boundaries.lists()[k];
            for (Offset g = list.n_internal(); g < list.n(); ++g)
                EXPECT_EQ(list.owners()(g - list.n_internal()),
                          chain(scene.boundaries.ghosts(), static_cast<int>(k), g).back());
        }
    }
}

TEST_P(Cull, pairs_alone_name_the_same_ghosts_as_rows) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Scene scene(seed);
        ConnectivityMap map;
        MapOptions options;
        scene.boundaries.update(map, node_lists(scene.nodes), options, {true, GetParam()});
        const Case by_rows = copy_of(scene.boundaries.lists());
        options.rows = false;
        scene.boundaries.update(map, node_lists(scene.nodes), options, {true, GetParam()});
        const Case by_pairs = copy_of(scene.boundaries.lists());
        for (std::size_t k = 0; k < by_rows.lists.size(); ++k)
            EXPECT_EQ(by_rows.lists[k].x, by_pairs.lists[k].x) << seed;
    }
}

TEST(CullLimits, boundaries_that_may_not_be_culled_keep_all_ghosts) {
    Box box;
    box.dim = 2;
    Boundaries boundaries(2);
    boundaries.add(Boundary::reflecting("lower", box.face(0, false)).keep_all_ghosts());
    // Two nodes too far apart to see each other or their images: nobody needs a ghost.
    const Case c = scalar_case(2, {0.3, 0.2, 0.3, 0.8}, {0.2, 0.2});
    ConnectivityMap map;
    boundaries.update(map, node_lists(c), MapOptions{});
    EXPECT_EQ(boundaries.ghosts().n_ghosts(), 2);
    Boundaries free(2);
    free.add(Boundary::reflecting("lower", box.face(0, false)));
    free.update(map, node_lists(c), MapOptions{});
    EXPECT_EQ(free.report().count("ghosts_made"), 2);
    EXPECT_EQ(free.report().count("ghosts_culled"), 2);
    EXPECT_EQ(free.ghosts().n_ghosts(), 0);
    EXPECT_EQ(map.layout().n_slots(), 2);
}

TEST(CullLimits, maps_that_use_rows_of_ghosts_are_left_alone) {
    Scene scene(5);
    for (const bool skin : {false, true})
        for (const bool ghost_rows : {false, true})
            for (const bool overlap : {false, true}) {
                if (!skin && !ghost_rows && !overlap) continue;
                MapOptions options;
                options.skin = skin ? 1e-3 : 0;
                options.ghost_rows = ghost_rows, options.overlap = overlap && !skin;
                ConnectivityMap map;
                Case c = scene.nodes;
                for (ListData& list : c.lists) {
                    for (double& h : list.h) h *= 0.5;
                    for (double& H : list.H) H *= 2;
                }
                scene.boundaries.update(map, node_lists(c), options);
                EXPECT_EQ(scene.boundaries.report().count("ghosts_culled"), 0);
                EXPECT_EQ(map.generation(), 1u);
                if (!options.stores_all_rows()) continue;
                EXPECT_TRUE(fails_with(Status::argument, {"cull", "rows of ghosts"},
                                       [&] { scene.boundaries.cull(map); }));
            }
}

TEST(CullLimits, maps_of_other_nodes_are_refused) {
    Scene scene(4);
    ConnectivityMap map;
    EXPECT_TRUE(fails_with(Status::not_built, {"cull"}, [&] { scene.boundaries.cull(map); }));
    scene.boundaries.make(node_lists(scene.nodes), MapOptions{});
    rebuild(map, scene.nodes);
    ASSERT_GT(scene.boundaries.ghosts().n_ghosts(), 0);
    EXPECT_TRUE(fails_with(Status::stale, {"cull"}, [&] { scene.boundaries.cull(map); }));
}

}  // namespace
}  // namespace connectivity::test
