// SPDX-License-Identifier: BSD-3-Clause
// Bad input ends in an error that says what, where, value and range, and the old tree stays.
#include <limits>

#include <gtest/gtest.h>

#include <support/expect_error.hpp>
#include <tree/tree_case.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Three sources and two targets with radii, in 2D, all legal.
class BadTreeInput : public ::testing::Test {
protected:
    BadTreeInput() {
        input.dim = 2;
        input.sources = ParticleArray::interleaved(x.data(), 3, 2);
        input.targets = ParticleArray::interleaved(y.data(), 2, 2);
        input.targets->radii = r.data();
        options.max_particles_in_box = 1;
        options.stick_out_factor = 0.5;
        tree.build(input, options);
        n_boxes = tree.view().n_boxes;
    }
    void expect(Status status, const std::vector<std::string>& words) {
        EXPECT_TRUE(fails_with(status, words, [&] { tree.build(input, options); }));
        EXPECT_EQ(tree.view().n_boxes, n_boxes);
        EXPECT_EQ(tree.view().sources.n, 3);
        EXPECT_EQ(tree.view().sources.positions.size(), 6u);
    }

    std::vector<double> x{0, 0, 1, 0, 0, 1}, y{0.5, 0.5, 0.2, 0.9}, r{0.1, 0.2};
    std::vector<std::int32_t> weights{1, 2, 3, 1, 0};
    TreeInput input;
    TreeOptions options;
    BoxTree tree;
    Offset n_boxes = 0;
};

TEST_F(BadTreeInput, positions_are_finite) {
    x[3] = nan;
    expect(Status::nonfinite, {"source 1", "position[1]", "nan", "finite"});
    x[3] = 0;
    y[2] = std::numeric_limits<double>::infinity();
    expect(Status::nonfinite, {"target 1", "position[0]", "inf"});
}

TEST_F(BadTreeInput, radii_are_finite_and_not_negative) {
    for (const double bad : {-1e-300, nan, std::numeric_limits<double>::infinity()}) {
        r[1] = bad;
        expect(Status::support, {"target 1", "radius", ">= 0"});
    }
}

TEST_F(BadTreeInput, radii_need_separate_targets_and_a_stick_out_factor) {
    options.stick_out_factor.reset();
    expect(Status::argument, {"stick_out_factor"});
    options.stick_out_factor = -0.1;
    expect(Status::argument, {"stick_out_factor", "-0.1"});
    options.stick_out_factor = nan;
    expect(Status::argument, {"stick_out_factor", "nan"});
    options.stick_out_factor = 0.1;
    input.sources.radii = r.data();
    input.targets.reset();
    expect(Status::argument, {"separate targets"});
}

TEST_F(BadTreeInput, exactly_one_limit_in_its_range) {
    options.max_particles_in_box = 0;
    expect(Status::argument, {"max_particles_in_box", "0", "[1, 2147483647]"});
    options.max_particles_in_box.reset();
    expect(Status::argument, {"neither"});
    options.max_leaf_refine_weight = 5;
    expect(Status::null, {"refine_weights"});
    input.refine_weights = weights.data();
    options.max_particles_in_box = 1;
    expect(Status::argument, {"both"});
    options.max_leaf_refine_weight.reset();
    expect(Status::argument, {"refine_weights", "max_leaf_refine_weight"});
}

TEST_F(BadTreeInput, weights_are_at_most_the_limit) {
    options.max_particles_in_box.reset();
    options.max_leaf_refine_weight = 2;
    input.refine_weights = weights.data();
    expect(Status::argument, {"source 2", "3", "[0, 2]"});
    weights[2] = 0;
    weights[4] = -1;
    expect(Status::argument, {"target 1", "-1", "[0, 2]"});
}

TEST_F(BadTreeInput, counts_strides_pointers_and_enumerators) {
    const TreeInput good = input;
    input.sources.n = -1;
    expect(Status::argument, {"source", "-1"});
    input.sources.n = max_slots;
    expect(Status::too_many, {"2147483649", "2147483647"});
    input.sources.n = max_slots + 1;
    expect(Status::too_many, {"2147483648"});
    input = good;
    input.sources.particle_stride = 0;
    expect(Status::argument, {"source particle_stride", "0"});
    input = good;
    input.targets->axis_stride = -2;
    expect(Status::argument, {"target axis_stride", "-2"});
    input = good;
    input.sources.positions = nullptr;
    expect(Status::null, {"source"});
    input = good;
    input.dim = 4;
    expect(Status::argument, {"dim", "4"});
    input = good;
    input.coordinates = static_cast<CoordinateType>(7);
    expect(Status::argument, {"coordinates", "7"});
    input = good;
    options.kind = static_cast<TreeKind>(-3);
    expect(Status::argument, {"kind", "-3"});
    options.kind = TreeKind::adaptive;
    options.extent_norm = static_cast<ExtentNorm>(2);
    expect(Status::argument, {"extent_norm", "2"});
}

TEST_F(BadTreeInput, a_host_s_box_is_a_cube_that_holds_all) {
    options.bounding_box = {{-1, -1}, {2, 2.5}};
    expect(Status::box, {"cube"});
    options.bounding_box = {{2, 2}, {-1, -1}};
    expect(Status::box, {"lo < hi"});
    options.bounding_box = {{0, 0}, {1, 1}};
    expect(Status::box, {"target 1", "position[1]", "[0, 1]"});
    options.periodic = {false, true, false};
    EXPECT_NO_THROW(tree.build(input, options));
}

TEST_F(BadTreeInput, budget_is_kept) {
    std::vector<double> many(3 << 20);
    for (std::size_t k = 0; k < many.size(); ++k) many[k] = u01(1, k);
    input = TreeInput();
    input.sources = ParticleArray::interleaved(many.data(), 1 << 20, 3);
    options.stick_out_factor.reset();
    options.budget.bytes = 1 << 20;
    expect(Status::budget, {"1048576 particles", "MiB"});
}

TEST_F(BadTreeInput, coincident_particles_are_named_or_a_leaf) {
    x = {0, 0, 0.25, 0.25, 0.25, 0.25};
    expect(Status::argument, {"source 1", "source 2", "one place"});
    options.coincident = Coincident::leaf;
    tree.build(input, options);
    EXPECT_EQ(tree.view().sources.n, 3);
}

TEST(DegenerateTree, all_points_at_one_place) {
    const std::vector<double> x(3 * 11, -7.5);
    TreeInput input;
    input.sources = ParticleArray::interleaved(x.data(), 11, 3);
    TreeOptions options;
    options.max_particles_in_box = 10;
    BoxTree tree;
    EXPECT_TRUE(fails_with(Status::argument, {"source 0", "source 1"},
                           [&] { tree.build(input, options); }));
    options.coincident = Coincident::leaf;
    tree.build(input, options);
    EXPECT_EQ(tree.view().n_boxes, 1);
    EXPECT_EQ(tree.view().root_extent, 7.5);
    for (int i = 0; i < 11; ++i) EXPECT_EQ(tree.view().user_source_ids(i), i);
    options.max_particles_in_box = 11;
    options.coincident = Coincident::error;
    EXPECT_NO_THROW(tree.build(input, options));
}

// boxtree gives a particle on the upper face of a host's box a cell that does not exist.
TEST(DegenerateTree, a_particle_on_the_upper_face_is_in_the_last_box) {
    const std::vector<double> x{0, 0, 1, 1, 0.99, 0.99, 0.1, 0.2};
    TreeInput input;
    input.dim = 2;
    input.sources = ParticleArray::interleaved(x.data(), 4, 2);
    TreeOptions options;
    options.max_particles_in_box = 1;
    options.bounding_box = {{0, 0}, {1, 1}};
    BoxTree tree;
    tree.build(input, options);
    const auto t = tree.view();
    const auto paths = paths_of(t);
    for (BoxId b = 0; b < t.n_boxes; ++b)
        if (t.sources.box_counts_nonchild(b) > 0 &&
            t.user_source_ids(t.sources.box_starts(b)) == 1) {
            EXPECT_EQ(paths[b], std::string(paths[b].size(), '3'));
        }
}

// boxtree counts levels in 32 bits and fails beyond 30 of them.
TEST(DegenerateTree, dynamic_range_of_1e10_and_1e14) {
    for (const double range : {1e10, 1e14}) {
        std::vector<double> x{0.1, 0.9, 0.3};
        for (int i = 0; i < 300; ++i)
            for (int d = 0; d < 3; ++d) x.push_back(u01(5, 3 * i + d) / range);
        TreeInput input;
        input.sources = ParticleArray::interleaved(x.data(), 301, 3);
        TreeOptions options;
        options.max_particles_in_box = 5;
        BoxTree tree;
        tree.build(input, options);
        const auto t = tree.view();
        EXPECT_GT(t.n_levels, std::log2(range));
        Offset total = 0;
        for (BoxId b = 0; b < t.n_boxes; ++b) {
            if (t.box_flags(b) >= 4) continue;
            total += t.sources.box_counts_nonchild(b);
            EXPECT_LE(t.sources.box_counts_nonchild(b), 5);
            const Offset first = t.sources.box_starts(b);
            for (Offset i = first; i < first + t.sources.box_counts_nonchild(b); ++i)
                for (int d = 0; d < 3; ++d)
                    EXPECT_LE(std::abs(t.sources.positions(d * 301 + i) - t.center(d, b)),
                              t.half_width(b) * (1 + 1e-12) + 1e-16);
        }
        EXPECT_EQ(total, 301);
    }
}

TEST(DegenerateTree, deeper_than_254_levels_is_an_error) {
    const std::vector<double> x{0, 1, 1e-100, 3e-100};
    TreeInput input;
    input.dim = 1;
    input.sources = ParticleArray::interleaved(x.data(), 4, 1);
    TreeOptions options;
    options.max_particles_in_box = 1;
    BoxTree tree;
    EXPECT_TRUE(fails_with(Status::too_many, {"254", "source 0", "source 2"},
                           [&] { tree.build(input, options); }));
}

TEST(DegenerateTree, infinite_extent_is_an_error) {
    const std::vector<double> x{-1e308, 1.5e308};
    TreeInput input;
    input.dim = 1;
    input.sources = ParticleArray::interleaved(x.data(), 2, 1);
    TreeOptions options;
    options.max_particles_in_box = 1;
    BoxTree tree;
    EXPECT_TRUE(
        fails_with(Status::box, {"root box", "finite"}, [&] { tree.build(input, options); }));
}

TEST(TreeViews, stay_as_they_are_through_rebuilds) {
    const TreeCase a = random_tree_case(11), b = random_tree_case(12);
    BuiltTree built(a);
    const TreeView old = built.view();
    const std::vector<double> before(old.box_centers.data(),
                                     old.box_centers.data() + old.box_centers.size());
    const BuiltTree other(b);
    built.tree().build(other.input(), b.options);
    EXPECT_EQ(built.view().n_boxes, other.view().n_boxes);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(old.box_centers(k), before[k]);
}

}  // namespace
}  // namespace connectivity::test
