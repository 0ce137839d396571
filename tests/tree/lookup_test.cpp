// SPDX-License-Identifier: BSD-3-Clause
// Lookups in random trees against their definitions; trees given as boxes.
#include <algorithm>

#include <gtest/gtest.h>

#include <connectivity/tree/area_query.hpp>
#include <connectivity/tree/linked_sources.hpp>
#include <connectivity/tree/peer_lists.hpp>
#include <connectivity/tree/target_filter.hpp>

#include <support/expect_error.hpp>
#include <tree/tree_case.hpp>

namespace connectivity::test {
namespace {

std::vector<int> row(const Csr& csr, Offset r) {
    return {csr.value_data() + csr.offset_data()[r], csr.value_data() + csr.offset_data()[r + 1]};
}

/// Boxes for which `wanted` holds, depth-first.
template <class Wanted>
std::vector<int> depth_first(const std::vector<std::string>& paths, const Wanted& wanted) {
    std::vector<int> boxes;
    for (int b = 0; b < static_cast<int>(paths.size()); ++b)
        if (wanted(b)) boxes.push_back(b);
    std::sort(boxes.begin(), boxes.end(), [&](int a, int b) { return paths[a] < paths[b]; });
    return boxes;
}

TEST(PeerLists, are_those_of_the_definition) {
    for (std::uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TreeCase c = random_tree_case(seed);
        const BuiltTree built(c);
        const TreeView tree = built.view();
        if (tree.n_boxes > 600) continue;
        const SlowTree slow(c, tree.bounding_box_min, tree.root_extent);
        const auto paths = paths_of(tree);
        const Csr peers = peer_lists(tree);
        for (BoxId b = 0; b < tree.n_boxes; ++b) {
            const auto near = [&](int k) {
                return paths[k].size() <= paths[b].size() && slow.touch(paths[b], paths[k]);
            };
            EXPECT_EQ(row(peers, b), depth_first(paths, [&](int k) {
                          bool child = false;
                          for (int m = 0; m < 1 << tree.dim; ++m)
                              child = child || (tree.child(m, k) > 0 && near(tree.child(m, k)));
                          return near(k) && !child;
                      }));
        }
    }
}

TEST(AreaQuery, balls_and_leaves_find_each_other) {
    for (std::uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TreeCase c = random_tree_case(seed);
        const BuiltTree built(c);
        const TreeView tree = built.view();
        if (tree.n_boxes > 1000) continue;
        const auto paths = paths_of(tree);
        Random random(seed);
        std::vector<double> x, r;
        for (int k = 0; k < 20; ++k) {
            for (int d = 0; d < c.dim; ++d) x.push_back(random.uniform(-2, 2));
            r.push_back(random.chance(0.1) ? 0 : random.log_uniform(1e-3, 2));
        }
        auto balls = ParticleArray::interleaved(x.data(), 20, c.dim);
        balls.radii = r.data();
        const auto distance = [&](int ball, int b) {
            double most = 0;
            for (int d = 0; d < c.dim; ++d)
                most = std::max(most, std::abs(x[ball * c.dim + d] - tree.center(d, b)));
            return most;
        };
        const auto touches = [&](int ball, int b) {
            return tree.box_flags(b) < 4 && distance(ball, b) <= tree.half_width(b) + r[ball];
        };
        const Csr leaves = area_query(tree, balls, CoordinateType::float64),
                  found = leaves_to_balls(tree, balls, CoordinateType::float64);
        const auto farthest = space_invader_distances(tree, balls, CoordinateType::float64);
        for (int ball = 0; ball < 20; ++ball)
            EXPECT_EQ(row(leaves, ball),
                      depth_first(paths, [&](int b) { return touches(ball, b); }));
        for (BoxId b = 0; b < tree.n_boxes; ++b) {
            std::vector<int> wanted;
            double most = 0;
            for (int ball = 0; ball < 20; ++ball)
                if (touches(ball, b)) {
                    wanted.push_back(ball);
                    most = std::max(most, distance(ball, b));
                }
            EXPECT_EQ(row(found, b), wanted);
            EXPECT_EQ(farthest(b), most);
        }
    }
}

TEST(Lookups, refuse_bad_input) {
    const TreeCase c = random_tree_case(3);
    const BuiltTree built(c);
    const TreeView tree = built.view();
    std::vector<double> x{0, 0, std::nan("")}, r{-1};
    auto balls = ParticleArray::interleaved(x.data(), 1, tree.dim);
    balls.radii = r.data();
    EXPECT_TRUE(fails_with(Status::support, {"ball 0", "-1"},
                           [&] { area_query(tree, balls, CoordinateType::float64); }));
    x[0] = std::nan("");
    EXPECT_TRUE(fails_with(Status::nonfinite, {"ball 0"},
                           [&] { area_query(tree, balls, CoordinateType::float64); }));
    const std::vector<std::int8_t> flags(tree.targets.n + 1);
    EXPECT_TRUE(
        fails_with(Status::argument, {"flags"}, [&] { filter_targets_user_order(tree, flags); }));
    const std::vector<Offset> starts(tree.sources.n + 1, 1);
    EXPECT_TRUE(fails_with(Status::argument, {"start 0", "[0, 0]"},
                           [&] { link_point_sources(tree, starts, {}, CoordinateType::float64); }));
}

TEST(MeshBoxes, give_the_tree_they_came_from) {
    for (std::uint64_t seed = 0; seed < 30 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TreeCase c = random_tree_case(seed);
        const BuiltTree built(c);
        const TreeView t = built.view();
        MeshBoxes mesh;
        mesh.dim = t.dim;
        mesh.n_boxes = t.n_boxes;
        mesh.lo = t.bounding_box_min;
        mesh.root_extent = t.root_extent;
        mesh.child_ids = t.box_child_ids.data();
        mesh.child_stride = t.aligned_n_boxes;
        BoxTree by_children, by_parents;
        by_children.build(mesh);
        std::vector<std::uint8_t> numbers(t.n_boxes);
        for (BoxId b = 0; b < t.n_boxes; ++b)
            for (int k = 0; k < 1 << t.dim; ++k)
                if (t.child(k, b) > 0) numbers[t.child(k, b)] = static_cast<std::uint8_t>(k);
        mesh.child_ids = nullptr;
        mesh.parent_ids = t.box_parent_ids.data();
        mesh.child_numbers = numbers.data();
        by_parents.build(mesh);
        for (const TreeView& m : {by_children.view(), by_parents.view()}) {
            ASSERT_EQ(m.n_boxes, t.n_boxes);
            ASSERT_EQ(m.n_levels, t.n_levels);
            for (BoxId b = 0; b < t.n_boxes; ++b) {
                bool leaf = true;
                EXPECT_EQ(m.box_parent_ids(b), t.box_parent_ids(b));
                EXPECT_EQ(m.box_levels(b), t.box_levels(b));
                for (int k = 0; k < 1 << t.dim; ++k) {
                    EXPECT_EQ(m.child(k, b), t.child(k, b));
                    leaf = leaf && t.child(k, b) == 0;
                }
                for (int d = 0; d < t.dim; ++d) EXPECT_EQ(m.center(d, b), t.center(d, b));
                EXPECT_EQ(m.box_flags(b), leaf ? 3 : 12);
            }
        }
    }
}

TEST(MeshBoxes, out_of_order_are_refused) {
    const std::vector<BoxId> parents{0, 0, 1, 0};
    const std::vector<std::uint8_t> numbers{0, 0, 0, 1};
    MeshBoxes mesh;
    mesh.dim = 1;
    mesh.n_boxes = 4;
    mesh.parent_ids = parents.data();
    mesh.child_numbers = numbers.data();
    BoxTree tree;
    EXPECT_TRUE(
        fails_with(Status::argument, {"box 3", "level by level"}, [&] { tree.build(mesh); }));
    mesh.child_numbers = nullptr;
    EXPECT_TRUE(fails_with(Status::null, {"child_ids"}, [&] { tree.build(mesh); }));
}

}  // namespace
}  // namespace connectivity::test
