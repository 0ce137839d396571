// SPDX-License-Identifier: BSD-3-Clause
// Trees against boxtree's: integers exactly, order included; doubles to the last bit, since lists
// compare boxes that are exactly a diameter apart; float32 to 1e-6.
#include <gtest/gtest.h>

#include <support/boxtree_oracle.hpp>

namespace connectivity::test {
namespace {

class BoxtreeAnswers : public ::testing::TestWithParam<std::filesystem::path> {
protected:
    BoxtreeAnswers() : case_(GetParam()) {
        tree_.build(case_.input(), case_.options());
        tolerance_ = case_.is_float32() ? 1e-6 : 0;
    }

    const TreeView& tree() const { return tree_.view(); }

    template <class View>
    void expect_same(const std::string& key, const View& ours) const {
        if (!case_.has(key)) return;
        const auto theirs = case_.read<int>(key);
        ASSERT_EQ(ours.size(), theirs.size()) << key;
        for (std::size_t i = 0; i < theirs.size(); ++i)
            ASSERT_EQ(static_cast<int>(ours(i)), theirs[i]) << key << "[" << i << "]";
    }
    /// The first `used` columns of `rows` rows.
    template <class View>
    void expect_close(const std::string& key, const View& ours, int rows, Offset used) const {
        if (!case_.has(key)) return;
        const auto theirs = case_.read<double>(key);
        ASSERT_EQ(ours.size(), theirs.size()) << key;
        const Offset columns = static_cast<Offset>(theirs.size()) / rows;
        double scale = 0;
        for (int r = 0; r < rows; ++r)
            for (Offset c = 0; c < used; ++c)
                scale = std::max(scale, std::abs(theirs[r * columns + c]));
        for (int r = 0; r < rows; ++r)
            for (Offset c = 0; c < used; ++c)
                ASSERT_NEAR(ours(r * columns + c), theirs[r * columns + c], tolerance_ * scale)
                    << key << "[" << r << "," << c << "]";
    }
    void expect_kind(const std::string& kind, const TreeParticles& ours) const {
        expect_close("tree_" + kind + "s", ours.positions, tree().dim, ours.n);
        expect_close("tree_" + kind + "_radii", ours.radii, 1, ours.n);
        expect_same("tree_box_" + kind + "_starts", ours.box_starts);
        expect_same("tree_box_" + kind + "_counts_nonchild", ours.box_counts_nonchild);
        expect_same("tree_box_" + kind + "_counts_cumul", ours.box_counts_cumul);
        for (const std::string prefix : {"tree_box_", "trav_box_"}) {
            expect_close(prefix + kind + "_bounding_box_min", ours.bounding_box_min, tree().dim,
                         tree().n_boxes);
            expect_close(prefix + kind + "_bounding_box_max", ours.bounding_box_max, tree().dim,
                         tree().n_boxes);
        }
    }

    BoxtreeCase case_;
    BoxTree tree_;
    double tolerance_ = 0;
};

TEST_P(BoxtreeAnswers, boxes_are_the_same) {
    const TreeView t = tree();
    if (case_.has("tree_nboxes")) {
        EXPECT_EQ(t.n_boxes, case_.read<int>("tree_nboxes")[0]);
        EXPECT_EQ(t.aligned_n_boxes, case_.read<int>("tree_aligned_nboxes")[0]);
        EXPECT_EQ(t.n_levels, case_.read<int>("tree_nlevels")[0]);
        EXPECT_NEAR(t.root_extent, case_.read<double>("tree_root_extent")[0],
                    tolerance_ * t.root_extent);
    }
    if (case_.has("tree_stick_out_factor")) {
        EXPECT_EQ(t.stick_out_factor, case_.read<double>("tree_stick_out_factor")[0]);
    }
    const View<double> lo("lo", t.dim), hi("hi", t.dim);
    for (int d = 0; d < t.dim; ++d) {
        lo(d) = t.bounding_box_min[d];
        hi(d) = t.bounding_box_max[d];
    }
    expect_close("tree_bbox_min", lo, 1, t.dim);
    expect_close("tree_bbox_max", hi, 1, t.dim);
    expect_same("tree_level_start_box_nrs", t.level_start_box_nrs);
    expect_same("tree_box_parent_ids", t.box_parent_ids);
    expect_same("tree_box_child_ids", t.box_child_ids);
    expect_same("tree_box_levels", t.box_levels);
    expect_same("tree_box_flags", t.box_flags);
    expect_close("tree_box_centers", t.box_centers, t.dim, t.n_boxes);
}

TEST_P(BoxtreeAnswers, particles_have_the_same_order_and_slices) {
    expect_same("tree_user_source_ids", tree().user_source_ids);
    expect_same("tree_sorted_target_ids", tree().sorted_target_ids);
    expect_kind("source", tree().sources);
    expect_kind("target", tree().targets);
}

INSTANTIATE_TEST_SUITE_P(Files, BoxtreeAnswers, ::testing::ValuesIn(boxtree_files()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(BoxtreeAnswers, all_files_are_there) {
    if (!std::filesystem::exists(shared_data("oracle/boxtree")))
        GTEST_SKIP() << "only the small files in the repository were compared: there is no "
                     << shared_data("oracle/boxtree");
    EXPECT_EQ(boxtree_files().size(), 28u);
}

}  // namespace
}  // namespace connectivity::test
