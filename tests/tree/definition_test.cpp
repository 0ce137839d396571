// SPDX-License-Identifier: BSD-3-Clause
// Random trees against the definition, box by box and particle by particle.
#include <algorithm>

#include <gtest/gtest.h>

#include <tree/tree_case.hpp>

namespace connectivity::test {
namespace {

/// User numbers (sources, then targets) of a slice of one kind.
std::vector<int> slice(const TreeCase& c, const TreeView& tree, bool targets, Offset first,
                       Offset n) {
    std::vector<int> ids;
    if (!targets) {
        for (Offset i = first; i < first + n; ++i) ids.push_back(tree.user_source_ids(i));
        return ids;
    }
    std::vector<int> user(tree.targets.n);
    for (Offset i = 0; i < tree.targets.n; ++i)
        user[tree.sorted_target_ids(i)] = static_cast<int>(i);
    for (Offset i = first; i < first + n; ++i)
        ids.push_back(user[i] + (c.n_targets >= 0 ? c.n_sources : 0));
    return ids;
}

std::vector<int> of_kind(const TreeCase& c, const std::vector<int>& ids, bool targets) {
    if (c.n_targets < 0) return ids;
    std::vector<int> out;
    for (const int i : ids)
        if ((i >= c.n_sources) == targets) out.push_back(i);
    return out;
}

void expect_kind(const TreeCase& c, const TreeView& tree, BoxId b, const SlowBox& slow,
                 bool targets) {
    const TreeParticles& kind = targets ? tree.targets : tree.sources;
    EXPECT_EQ(slice(c, tree, targets, kind.box_starts(b), kind.box_counts_nonchild(b)),
              of_kind(c, slow.own, targets));
    auto all = slice(c, tree, targets, kind.box_starts(b), kind.box_counts_cumul(b));
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, of_kind(c, slow.all, targets));
    const bool has_own = !of_kind(c, slow.own, targets).empty();
    EXPECT_EQ((tree.box_flags(b) &
               (targets ? box_flag::has_own_targets : box_flag::has_own_sources)) != 0,
              has_own);
}

/// Hull by definition: centres of the boxes below, and all particles below.
void expect_hull(const TreeCase& c, const TreeView& tree, const std::vector<std::string>& paths,
                 BoxId b, const SlowBox& slow, bool targets) {
    const TreeParticles& kind = targets ? tree.targets : tree.sources;
    const double tolerance = c.type == CoordinateType::float32 ? 1e-6 : 1e-13;
    for (int d = 0; d < tree.dim; ++d) {
        double lo = tree.center(d, b), hi = lo;
        for (BoxId k = 0; k < tree.n_boxes; ++k)
            if (paths[k].starts_with(paths[b])) {
                lo = std::min(lo, tree.center(d, k));
                hi = std::max(hi, tree.center(d, k));
            }
        for (const int i : of_kind(c, slow.all, targets)) {
            const double x = c.x[i * c.dim + d], r = c.radius(i);
            lo = std::min(lo, x - r);
            hi = std::max(hi, x + r);
        }
        EXPECT_NEAR(kind.bounding_box_min(d * tree.aligned_n_boxes + b), lo, tolerance);
        EXPECT_NEAR(kind.bounding_box_max(d * tree.aligned_n_boxes + b), hi, tolerance);
    }
}

void expect_numbering(const TreeView& tree, const std::vector<std::string>& paths, bool sorted) {
    EXPECT_EQ(tree.level_start_box_nrs(0), 0);
    EXPECT_EQ(tree.level_start_box_nrs(tree.n_levels), tree.n_boxes);
    for (BoxId b = 0; b < tree.n_boxes; ++b) {
        const int level = static_cast<int>(paths[b].size());
        EXPECT_EQ(tree.box_levels(b), level);
        EXPECT_GE(b, tree.level_start_box_nrs(level));
        EXPECT_LT(b, tree.level_start_box_nrs(level + 1));
        if (b > 0) {
            EXPECT_EQ(paths[tree.box_parent_ids(b)], paths[b].substr(0, paths[b].size() - 1));
        }
        if (sorted && b > tree.level_start_box_nrs(level)) {
            EXPECT_LT(paths[b - 1], paths[b]);
        }
        for (int d = 0; d < tree.dim; ++d) {
            double center = tree.bounding_box_min[d];
            for (int l = 0; l < level; ++l)
                if (((paths[b][l] - '0') >> (tree.dim - 1 - d) & 1) != 0)
                    center += std::ldexp(tree.root_extent, -l - 1);
            center += std::ldexp(tree.root_extent, -level - 1);
            EXPECT_NEAR(tree.center(d, b), center, 1e-13 * tree.root_extent);
        }
    }
}

void expect_definition(const TreeCase& c) {
    const BuiltTree built(c);
    const TreeView tree = built.view();
    const SlowTree slow(c, tree.bounding_box_min, tree.root_extent);
    const auto paths = paths_of(tree);
    ASSERT_EQ(static_cast<std::size_t>(tree.n_boxes), slow.boxes().size());
    expect_numbering(tree, paths, c.options.kind != TreeKind::adaptive_level_restricted);
    for (BoxId b = 0; b < tree.n_boxes; ++b) {
        ASSERT_TRUE(slow.boxes().contains(paths[b])) << paths[b];
        const SlowBox& box = slow.boxes().at(paths[b]);
        EXPECT_EQ(tree.box_flags(b) & 12, box.split ? 12 : 0);
        for (const bool targets : {false, true}) {
            expect_kind(c, tree, b, box, targets);
            if (b % 5 == 0) expect_hull(c, tree, paths, b, box, targets);
        }
    }
    for (Offset i = 0; i < tree.sources.n; ++i)
        for (int d = 0; d < c.dim; ++d)
            EXPECT_EQ(tree.sources.positions(d * tree.sources.n + i),
                      c.x[tree.user_source_ids(i) * c.dim + d]);
}

TEST(BoxTree, random_trees_are_those_of_the_definition) {
    for (std::uint64_t seed = 0; seed < 100 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        expect_definition(random_tree_case(seed));
    }
}

// Which of the points beside the middle of the root box stay in it is boxtree's own answer: none.
// Sums in double would keep four of them.
TEST(BoxTree, floats_beside_a_face_are_rounded_as_boxtree_rounds) {
    const std::vector<float> sources{-1.70000005f, -1.70000005f, 2.1500001f,   2.1500001f,
                                     0.225192487f, 0.75f,        0.225192502f, 0.8f,
                                     0.225192532f, 0.85f,        0.225192547f, 0.9f,
                                     0.225192577f, 0.95f,        0.225192592f, 1.0f};
    const std::vector<float> targets{-0.5f, 0.5f, 0.6f, -0.4f}, radii{0x1p-20f, 0x1p-20f};
    TreeInput input;
    input.dim = 2;
    input.coordinates = CoordinateType::float32;
    input.sources = ParticleArray::interleaved(sources.data(), 8, 2);
    input.targets = ParticleArray::interleaved(targets.data(), 2, 2);
    input.targets->radii = radii.data();
    TreeOptions options;
    options.max_particles_in_box = 2;
    options.stick_out_factor = 0;
    BoxTree tree;
    tree.build(input, options);
    const auto& own = tree.view().sources.box_counts_nonchild;
    const std::vector<std::int32_t> theirs{0, 1, 0, 0, 7};
    ASSERT_EQ(own.size(), theirs.size());
    for (std::size_t b = 0; b < theirs.size(); ++b) EXPECT_EQ(own(b), theirs[b]) << b;
}

TEST(BoxTree, level_restriction_goes_across_periodic_faces) {
    for (std::uint64_t seed = 0; seed < 150 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        TreeCase c = random_tree_case(seed);
        if (c.options.kind != TreeKind::adaptive_level_restricted) continue;
        c.options.bounding_box = {{-2, -2, -2}, {2, 2, 2}};
        c.options.periodic = {true, seed % 2 == 0, false};
        c.options.hulls = Hulls::always;
        expect_definition(c);
    }
}

TEST(BoxTree, a_host_s_arrays_may_have_any_strides) {
    TreeCase c = random_tree_case(7);
    c.type = CoordinateType::float64;
    const BuiltTree built(c);
    std::vector<double> wide(5 * c.x.size(), std::nan(""));
    for (int i = 0; i < c.n_sources; ++i)
        for (int d = 0; d < c.dim; ++d) wide[i * 5 * c.dim + 2 * d] = c.x[i * c.dim + d];
    TreeInput input = built.input();
    input.sources.positions = wide.data();
    input.sources.particle_stride = 5 * c.dim;
    input.sources.axis_stride = 2;
    BoxTree tree;
    tree.build(input, c.options);
    ASSERT_EQ(tree.view().n_boxes, built.view().n_boxes);
    for (Offset i = 0; i < c.n_sources; ++i)
        EXPECT_EQ(tree.view().user_source_ids(i), built.view().user_source_ids(i));
}

}  // namespace
}  // namespace connectivity::test
