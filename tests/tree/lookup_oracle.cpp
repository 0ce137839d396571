// SPDX-License-Identifier: BSD-3-Clause
// Lookups in trees against boxtree's: peers, balls, filters, linked point sources.
#include <gtest/gtest.h>

#include <connectivity/tree/area_query.hpp>
#include <connectivity/tree/linked_sources.hpp>
#include <connectivity/tree/peer_lists.hpp>
#include <connectivity/tree/target_filter.hpp>

#include <support/boxtree_oracle.hpp>

namespace connectivity::test {
namespace {

class BoxtreeLookups : public ::testing::Test {
protected:
    /// False where the file is not at hand.
    bool open(const std::string& name) {
        for (const auto& path : boxtree_files())
            if (path.stem() == name) case_ = std::make_unique<BoxtreeCase>(path);
        if (case_ != nullptr) tree_.build(case_->input(), case_->options());
        return case_ != nullptr;
    }
    const TreeView& tree() const { return tree_.view(); }

    template <class View>
    void expect_same(const std::string& key, const View& ours) const {
        const auto theirs = case_->read<int>(key);
        ASSERT_EQ(ours.size(), theirs.size()) << key;
        for (std::size_t i = 0; i < theirs.size(); ++i)
            ASSERT_EQ(static_cast<int>(ours(i)), theirs[i]) << key << "[" << i << "]";
    }
    void expect_rows(const std::string& prefix, const Csr& ours) const {
        expect_same(prefix + "_starts", ours.offsets());
        expect_same(prefix + "_lists", ours.values());
    }

    std::unique_ptr<BoxtreeCase> case_;
    BoxTree tree_;
};

TEST_F(BoxtreeLookups, peers_balls_and_filters_are_the_same) {
    if (!open("a1_2d")) GTEST_SKIP() << "there is no " << shared_data("oracle/boxtree/a1_2d.h5");
    expect_rows("peer", peer_lists(tree()));

    const auto centers = case_->read<double>("in_ball_centers"),
               radii = case_->read<double>("in_ball_radii");
    auto balls =
        ParticleArray::interleaved(centers.data(), static_cast<Offset>(radii.size()), tree().dim);
    balls.radii = radii.data();
    expect_rows("aq", area_query(tree(), balls, CoordinateType::float64));
    expect_rows("lb", leaves_to_balls(tree(), balls, CoordinateType::float64));
    const auto theirs = case_->read<double>("space_invader");
    const auto ours = space_invader_distances(tree(), balls, CoordinateType::float64);
    ASSERT_EQ(ours.size(), theirs.size());
    // boxtree rounds these to float32 on the way.
    for (std::size_t b = 0; b < theirs.size(); ++b)
        EXPECT_NEAR(ours(b), theirs[b], 6e-8 * theirs[b]);

    const auto flags = case_->read<int>("in_target_flags");
    const std::vector<std::int8_t> small(flags.begin(), flags.end());
    expect_rows("fu", filter_targets_user_order(tree(), small));
    const auto filtered = filter_targets_tree_order(tree(), small);
    expect_same("ft_starts", filtered.box_starts);
    expect_same("ft_counts", filtered.box_counts_nonchild);
    expect_same("ft_unfiltered_from_filtered", filtered.unfiltered_from_filtered);
}

TEST_F(BoxtreeLookups, linked_point_sources_are_the_same) {
    ASSERT_TRUE(open("a3_linked"));
    const auto starts = case_->read<std::int64_t>("in_point_source_starts");
    const auto points = case_->read<double>("in_point_sources");
    const auto n = static_cast<Offset>(points.size()) / tree().dim;
    const auto linked =
        link_point_sources(tree(), starts, ParticleArray::interleaved(points.data(), n, tree().dim),
                           CoordinateType::float64);
    EXPECT_EQ(linked.n, case_->read<int>("tree_npoint_sources")[0]);
    expect_same("tree_user_point_source_ids", linked.user_point_source_ids);
    expect_same("tree_point_source_starts", linked.starts);
    expect_same("tree_point_source_counts", linked.counts);
    expect_same("tree_box_point_source_starts", linked.box_starts);
    expect_same("tree_box_point_source_counts_nonchild", linked.box_counts_nonchild);
    expect_same("tree_box_point_source_counts_cumul", linked.box_counts_cumul);
    const auto theirs = case_->read<double>("tree_point_sources");
    for (std::size_t k = 0; k < theirs.size(); ++k) EXPECT_EQ(linked.positions(k), theirs[k]);
}

}  // namespace
}  // namespace connectivity::test
