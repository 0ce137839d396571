// SPDX-License-Identifier: BSD-3-Clause
// Cases for box trees and interaction lists: what is read from the file, and what is refused.
#include <gtest/gtest.h>

#include <connectivity/io/lists_input.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

class ListsInputFile : public ::testing::Test {
protected:
    std::string path() const { return folder_ / "case.h5"; }
    TemporaryFolder folder_;
};

TEST_F(ListsInputFile, defaults_without_params) {
    PlainFile::create(path()).data<double>("in_sources", {1, 2, 3, 4, 5, 6}, {2, 3});
    EXPECT_TRUE(is_lists_input(path()));
    const ListsInput in = read_lists_input(path());
    EXPECT_EQ(in.dim, 3);
    EXPECT_EQ(in.coordinates, CoordinateType::float64);
    EXPECT_FALSE(in.targets || in.have_radii() || in.tree_only);
    EXPECT_EQ(in.tree.kind, TreeKind::adaptive);
    EXPECT_EQ(in.tree.max_particles_in_box, 64);
    EXPECT_FALSE(in.tree.max_leaf_refine_weight || in.tree.stick_out_factor);
    EXPECT_EQ(in.tree.extent_norm, ExtentNorm::linf);
    EXPECT_EQ(in.lists.well_sep_is_n_away, 1);
    EXPECT_FALSE(in.lists.from_sep_smaller_crit);
    EXPECT_EQ(in.lists.from_sep_smaller_min_nsources_cumul, 0);
    const TreeInput particles = in.particles();
    EXPECT_EQ(particles.sources.n, 2);
    const auto* const x = static_cast<const double*>(particles.sources.positions);
    EXPECT_EQ(x[particles.sources.particle_stride + 2 * particles.sources.axis_stride], 6);
    EXPECT_EQ(particles.sources.radii, nullptr);
    EXPECT_EQ(particles.refine_weights, nullptr);
}

TEST_F(ListsInputFile, every_param_is_honoured) {
    PlainFile::create(path())
        .data<double>("in_sources", {1, 2, 3, 4}, {2, 2})
        .data<double>("in_targets", {5, 6}, {1, 2})
        .data<double>("in_source_radii", {0.5, 0.25})
        .data<double>("in_target_radii", {0.75})
        .data<int>("in_refine_weights", {1, 2, 3})
        .attribute("/", "params",
                   R"({"d": 2, "kind": "adaptive-level-restricted", "leaf": null, "maxw": 7,
                       "n_away": 3, "crit": "static_l2", "sof": 0.125, "norm": "l2", "minsrc": 9,
                       "f32": true, "notrav": true, "name": "x", "seed": 1, "trad": [-1, 0]})");
    const ListsInput in = read_lists_input(path());
    EXPECT_EQ(in.tree.kind, TreeKind::adaptive_level_restricted);
    EXPECT_EQ(in.tree.max_leaf_refine_weight, 7);
    EXPECT_FALSE(in.tree.max_particles_in_box);
    EXPECT_EQ(in.lists.well_sep_is_n_away, 3);
    EXPECT_EQ(in.lists.crit(), FromSepSmallerCrit::static_l2);
    EXPECT_EQ(in.tree.stick_out_factor, 0.125);
    EXPECT_EQ(in.tree.extent_norm, ExtentNorm::l2);
    EXPECT_EQ(in.lists.from_sep_smaller_min_nsources_cumul, 9);
    EXPECT_EQ(in.coordinates, CoordinateType::float32);
    EXPECT_TRUE(in.tree_only);
    const TreeInput particles = in.particles();
    EXPECT_EQ(static_cast<const float*>(particles.sources.positions)[3], 4);
    EXPECT_EQ(static_cast<const float*>(particles.sources.radii)[1], 0.25F);
    EXPECT_EQ(static_cast<const float*>(particles.targets->radii)[0], 0.75F);
    EXPECT_EQ(particles.refine_weights[2], 3);
}

TEST_F(ListsInputFile, stick_out_is_none_without_radii) {
    PlainFile::create(path())
        .data<double>("in_sources", {1, 2}, {2, 1})
        .attribute("/", "params", R"({"sof": 0.25, "norm": "l2"})");
    EXPECT_FALSE(read_lists_input(path()).tree.stick_out_factor);
}

TEST_F(ListsInputFile, both_limits_are_refused) {
    PlainFile::create(path())
        .data<double>("in_sources", {1, 2}, {2, 1})
        .data<int>("in_refine_weights", {1, 1})
        .attribute("/", "params", R"({"leaf": 5, "maxw": 6})");
    expect_error(Status::format, {"leaf = 5", "weights"}, [&] { read_lists_input(path()); });
}

TEST_F(ListsInputFile, params_that_are_no_string_are_refused) {
    PlainFile::create(path())
        .data<double>("in_sources", {1, 2}, {2, 1})
        .attribute("/", "params", 5);
    expect_error(Status::format, {"params", "no string"}, [&] { read_lists_input(path()); });
}

TEST_F(ListsInputFile, other_files_are_not_cases) {
    PlainFile::create(path()).data<double>("PartType0/Coordinates", {1, 2, 3}, {1, 3});
    EXPECT_FALSE(is_lists_input(path()));
    expect_error(Status::format, {"in_sources"}, [&] { read_lists_input(path()); });
    expect_error(Status::file, {"none.h5"}, [&] { is_lists_input(folder_ / "none.h5"); });
}

}  // namespace
}  // namespace connectivity::test
