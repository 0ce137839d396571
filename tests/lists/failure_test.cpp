// SPDX-License-Identifier: BSD-3-Clause
/// Bad options and trees end in an error that says what is wrong, and nothing is lost.

#include <functional>

#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/work.hpp>

#include "lists/slow_tree.hpp"
#include "support/expect_error.hpp"

namespace connectivity::test {
namespace {

SlowInput input_with_radii(ExtentNorm norm) {
    Random random(7);
    SlowInput in;
    in.norm = norm;
    in.target_radii = true;
    in.stick_out = 0.25;
    for (int i = 0; i < 80; ++i) {
        in.sources.push_back({{random.uniform(), random.uniform(), 0}});
        in.targets.push_back({{random.uniform(), random.uniform(), 0}, 0.02 * random.uniform()});
    }
    return in;
}

/// A traversal that must be the same after calls that fail.
class FailingBuilds : public ::testing::Test {
protected:
    FailingBuilds() : tree_(input_with_radii(ExtentNorm::linf)), lists_(tree_.view()) {
        before_ = lists_.from_sep_siblings();
        copy_.assign(before_.lists.data(), before_.lists.data() + before_.lists.size());
    }

    void expect_failure(Status status, const std::vector<std::string>& words,
                        const TraversalOptions& options) {
        expect_failure(status, words, tree_.view(), options);
    }
    void expect_failure(Status status, const std::vector<std::string>& words, const TreeView& tree,
                        const TraversalOptions& options = {}) {
        EXPECT_TRUE(fails_with(status, words, [&] { lists_.rebuild(tree, options); }));
        const BoxList after = lists_.from_sep_siblings();
        EXPECT_EQ(after.lists.data(), before_.lists.data());
        EXPECT_EQ(copy_,
                  std::vector<BoxId>(after.lists.data(), after.lists.data() + after.lists.size()));
        EXPECT_EQ(lists_.nboxes(), tree_.view().n_boxes);
    }
    /// The tree with an array of it changed.
    template <class T>
    TreeView with(ConstView<T> TreeView::*array, const std::function<void(View<T>&)>& change) {
        TreeView tree = tree_.view();
        const ConstView<T> old = tree.*array;
        auto copy = allocate<T>("copy", static_cast<Offset>(old.size()));
        std::copy(old.data(), old.data() + old.size(), copy.data());
        change(copy);
        tree.*array = copy;
        return tree;
    }

    SlowTree tree_;
    FMMTraversalInfo lists_;
    BoxList before_;
    std::vector<BoxId> copy_;
};

TEST_F(FailingBuilds, n_away_below_1) {
    TraversalOptions options;
    for (const int n : {0, -3}) {
        options.well_sep_is_n_away = n;
        expect_failure(Status::argument, {"well_sep_is_n_away", std::to_string(n)}, options);
    }
}

TEST_F(FailingBuilds, unknown_criterion) {
    TraversalOptions options;
    options.from_sep_smaller_crit = static_cast<FromSepSmallerCrit>(7);
    expect_failure(Status::argument, {"from_sep_smaller_crit", "7", "static_l2"}, options);
    EXPECT_TRUE(fails_with(Status::argument, {"'nearly'", "precise_linf"},
                           [] { from_sep_smaller_crit_named("nearly"); }));
}

TEST_F(FailingBuilds, static_linf_with_the_norm_l2) {
    const SlowTree tree(input_with_radii(ExtentNorm::l2));
    TraversalOptions options;
    options.from_sep_smaller_crit = FromSepSmallerCrit::static_linf;
    expect_failure(Status::argument, {"static_linf", "l2"}, tree.view(), options);
}

TEST_F(FailingBuilds, negative_threshold_and_masks_of_another_size) {
    TraversalOptions options;
    options.from_sep_smaller_min_nsources_cumul = -1;
    expect_failure(Status::argument, {"from_sep_smaller_min_nsources_cumul", "-1"}, options);
    options = {};
    options.source_boxes_mask = allocate_zeroed<std::uint8_t>("mask", 3);
    expect_failure(Status::argument, {"source_boxes_mask", "3"}, options);
}

TEST_F(FailingBuilds, budget_exceeded_while_boxes_are_found_and_before_the_fill) {
    TraversalOptions options;
    options.budget.bytes = 100;
    expect_failure(Status::budget, {"near boxes", "budget"}, options);
    options.budget.bytes = 3 * lists_.report().count("near bytes") / 2;
    expect_failure(Status::budget, {"interaction lists need", "the largest is"}, options);
}

TEST_F(FailingBuilds, null_arrays) {
    TreeView tree = tree_.view();
    tree.box_child_ids = {};
    expect_failure(Status::null, {"box_child_ids"}, tree);
    tree = tree_.view();
    tree.box_centers = {};
    expect_failure(Status::null, {"box_centers"}, tree);
    tree = tree_.view();
    tree.targets.bounding_box_min = {};
    expect_failure(Status::null, {"bounding_box_min"}, tree);
}

TEST_F(FailingBuilds, arrays_that_contradict_each_other) {
    const auto last = static_cast<BoxId>(tree_.view().n_boxes - 1);
    const Offset stride = tree_.view().aligned_n_boxes;
    const auto expect = [&](const char* word, const TreeView& tree) {
        expect_failure(Status::argument, {word}, tree);
    };
    expect("another parent",
           with<BoxId>(&TreeView::box_parent_ids, [&](auto& a) { a(last) = last; }));
    expect("box_child_ids", with<BoxId>(&TreeView::box_child_ids, [&](auto& a) { a(0) = last; }));
    expect("box_child_ids",
           with<BoxId>(&TreeView::box_child_ids, [&](auto& a) { a(0) = 1 << 30; }));
    expect("box_child_ids", with<BoxId>(&TreeView::box_child_ids, [&](auto& a) { a(0) = -5; }));
    expect("box_child_ids",
           with<BoxId>(&TreeView::box_child_ids, [&](auto& a) { a(stride) = a(0); }));
    expect("box_levels",
           with<std::uint8_t>(&TreeView::box_levels, [&](auto& a) { a(last) = 200; }));
    expect("box_flags", with<std::uint8_t>(&TreeView::box_flags, [&](auto& a) { a(0) = 0; }));
    expect("level_start_box_nrs",
           with<BoxId>(&TreeView::level_start_box_nrs, [&](auto& a) { a(1) = 5; }));
    TreeView tree = tree_.view();
    tree.dim = 4;
    expect("dim", tree);
    tree = tree_.view();
    tree.root_extent = std::nan("");
    expect("root_extent", tree);
    tree = {};
    tree.dim = 2;
    expect("n_boxes", tree);
}

TEST_F(FailingBuilds, classes_without_list_2) {
    TraversalOptions options;
    options.well_sep_is_n_away = 1;
    lists_.rebuild(tree_.view(), options);
    EXPECT_NO_THROW(TranslationClassesInfo classes(lists_));
    options.from_sep_siblings = false;
    lists_.rebuild(tree_.view(), options);
    EXPECT_TRUE(fails_with(Status::not_built, {"from_sep_siblings"},
                           [&] { RotationClassesInfo classes(lists_); }));
}

TEST(EmptyTraversal, has_no_boxes_and_no_lists) {
    const FMMTraversalInfo none;
    EXPECT_EQ(none.nboxes(), 0);
    EXPECT_EQ(none.ntarget_boxes(), 0);
    EXPECT_TRUE(fails_with(Status::not_built, {"neighbor_source_boxes"},
                           [&] { none.neighbor_source_boxes(); }));
    EXPECT_TRUE(fails_with(Status::not_built, {"from_sep_siblings"},
                           [&] { TranslationClassesInfo classes(none); }));
    EXPECT_EQ(count_work(none).total, Work{});
}

}  // namespace
}  // namespace connectivity::test
