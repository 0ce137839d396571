// SPDX-License-Identifier: BSD-3-Clause
// Box trees and interaction lists without memory: what there was stays.

#include "c_session.hpp"
#include "connectivity_lists.h"

namespace connectivity::test {
namespace {

class CTrees : public CSession {
protected:
    void SetUp() override {
        CSession::SetUp();
        if (IsSkipped()) return;
        ASSERT_TRUE(ok(conn_tree_create(context(), &tree_)));
        ASSERT_TRUE(ok(conn_lists_create(context(), &lists_)));
        ASSERT_TRUE(ok(build(old_)));
        ASSERT_TRUE(ok(conn_lists_rebuild(lists_, tree_, nullptr)));
    }
    void TearDown() override {
        EXPECT_TRUE(ok(conn_lists_destroy(&lists_)));
        EXPECT_TRUE(ok(conn_tree_destroy(&tree_)));
    }

    /// Separate axes, which are copied, and targets with radii.
    conn_status build(const NodeSet& set) const {
        const auto size = static_cast<std::int64_t>(set.h.size());
        conn_array axes[2] = {conn_array_vector(set.x.data(), size),
                              conn_array_vector(set.x.data() + 1, size)};
        axes[0].stride[0] = axes[1].stride[0] = 2;
        const conn_array targets = conn_array_matrix(set.x.data(), size, 2),
                         radii = conn_array_vector(set.h.data(), size);
        conn_tree_input input = CONN_TREE_INPUT_INIT;
        input.dim = input.n_sources = 2;
        input.sources = axes;
        input.targets = &targets;
        input.target_radii = &radii;
        conn_tree_options options = CONN_TREE_OPTIONS_INIT;
        options.max_particles_in_box = 4;
        options.stick_out_factor = 0.25;
        return conn_tree_build(tree_, &input, &options);
    }
    std::vector<std::int32_t> order() const {
        conn_tree_view view = CONN_TREE_VIEW_INIT;
        EXPECT_TRUE(ok(conn_tree_acquire(tree_, 0, &view)));
        const std::vector ids(view.user_source_ids, view.user_source_ids + view.n_sources);
        EXPECT_TRUE(ok(conn_tree_release(&view)));
        return ids;
    }
    std::vector<std::int32_t> siblings() const {
        conn_box_list_view view = CONN_BOX_LIST_VIEW_INIT;
        EXPECT_TRUE(ok(conn_lists_acquire(lists_, CONN_LIST_FROM_SEP_SIBLINGS, 0, 0, &view)));
        const std::vector boxes(view.lists, view.lists + view.n_entries);
        EXPECT_TRUE(ok(conn_box_list_release(&view)));
        return boxes;
    }

    /// acquire() again and again, with release() of what it pins.
    template <class View>
    void each(const char* name, View& view, conn_status (*release)(View*), const Call& acquire) {
        each_allocation(
            name, acquire, [&] { ASSERT_EQ(view.owner, nullptr); }, [&] { release(&view); });
        EXPECT_TRUE(ok(release(&view)));
    }

    conn_tree* tree_ = nullptr;
    conn_lists* lists_ = nullptr;
};

TEST_F(CTrees, builds_that_fail_keep_the_old_boxes_and_lists) {
    conn_tree* tree = nullptr;
    conn_lists* lists = nullptr;
    each_allocation(
        "conn_tree_create", [&] { return conn_tree_create(context(), &tree); },
        [&] { ASSERT_EQ(tree, nullptr); }, [&] { conn_tree_destroy(&tree); });
    each_allocation(
        "conn_lists_create", [&] { return conn_lists_create(context(), &lists); },
        [&] { ASSERT_EQ(lists, nullptr); }, [&] { conn_lists_destroy(&lists); });
    const auto boxes = order(), entries = siblings();
    each_allocation(
        "conn_tree_build", [&] { return build(now_); }, [&] { ASSERT_EQ(order(), boxes); },
        [&] { ASSERT_TRUE(ok(build(old_))); });
    ASSERT_NE(order(), boxes);
    each_allocation(
        "conn_lists_rebuild", [&] { return conn_lists_rebuild(lists_, tree_, nullptr); },
        [&] { ASSERT_EQ(siblings(), entries); },
        [&] {
            ASSERT_TRUE(ok(build(old_)));
            ASSERT_TRUE(ok(conn_lists_rebuild(lists_, tree_, nullptr)));
            ASSERT_TRUE(ok(build(now_)));
        });
    ASSERT_NE(siblings(), entries);
    each_allocation("conn_lists_merge_close", [&] { return conn_lists_merge_close(lists_); });
    EXPECT_GT(n_failed_, 60);
    EXPECT_TRUE(ok(conn_tree_destroy(&tree)));
    EXPECT_TRUE(ok(conn_lists_destroy(&lists)));
}

TEST_F(CTrees, lookups_that_fail_hold_nothing) {
    conn_box_list_view list = CONN_BOX_LIST_VIEW_INIT;
    conn_particles_view particles = CONN_PARTICLES_VIEW_INIT;
    const conn_array x = conn_array_matrix(now_.x.data(), n, 2),
                     r = conn_array_vector(now_.h.data(), n);
    const std::vector<std::uint8_t> flags(old_.h.size(), 1);
    const auto n_old = static_cast<std::int64_t>(old_.h.size());
    std::vector<std::int64_t> starts(flags.size() + 1, 0);
    starts.back() = n;
    std::vector<double> distances(2000);
    std::int64_t count = 0;
    each("conn_tree_peers", list, conn_box_list_release,
         [&] { return conn_tree_peers(tree_, &list); });
    each("conn_tree_area_query", list, conn_box_list_release,
         [&] { return conn_tree_area_query(tree_, &x, 1, &r, &list); });
    each("conn_tree_leaves_to_balls", list, conn_box_list_release,
         [&] { return conn_tree_leaves_to_balls(tree_, &x, 1, &r, &list); });
    each_allocation("conn_tree_space_invader", [&] {
        return conn_tree_space_invader(tree_, &x, 1, &r, distances.data(), 2000, &count);
    });
    each("conn_tree_filter_targets", list, conn_box_list_release,
         [&] { return conn_tree_filter_targets(tree_, flags.data(), n_old, &list); });
    each("conn_tree_filter_targets_in_tree_order", particles, conn_particles_release, [&] {
        return conn_tree_filter_targets_in_tree_order(tree_, flags.data(), n_old, &particles);
    });
    each("conn_tree_link_point_sources", particles, conn_particles_release, [&] {
        return conn_tree_link_point_sources(tree_, starts.data(), n_old + 1, &x, 1, &particles);
    });
    EXPECT_GT(n_failed_, 50);
}

TEST_F(CTrees, views_that_fail_hold_nothing) {
    conn_tree_view boxes = CONN_TREE_VIEW_INIT;
    conn_box_list_view list = CONN_BOX_LIST_VIEW_INIT;
    conn_classes_view classes = CONN_CLASSES_VIEW_INIT;
    std::vector<std::int64_t> counts(2000);
    std::int64_t count = 0, total = 0;
    each("conn_tree_acquire", boxes, conn_tree_release,
         [&] { return conn_tree_acquire(tree_, 0, &boxes); });
    for (int which = 0; which < 12; ++which)
        each("conn_lists_acquire", list, conn_box_list_release,
             [&] { return conn_lists_acquire(lists_, which, 0, 0, &list); });
    for (int which = 0; which < 3; ++which)
        each("conn_lists_classes_acquire", classes, conn_lists_classes_release,
             [&] { return conn_lists_classes_acquire(lists_, which, 0, &classes); });
    each_allocation("conn_lists_work", [&] {
        return conn_lists_work(lists_, CONN_WORK_P2P, counts.data(), 2000, &count, &total);
    });
    ASSERT_TRUE(ok(conn_tree_acquire(tree_, 0, &boxes)));
    each_allocation("conn_tree_set_boxes", [&] { return conn_tree_set_boxes(tree_, &boxes); });
    EXPECT_TRUE(ok(conn_tree_release(&boxes)));
    EXPECT_GT(n_failed_, 50);
}

}  // namespace
}  // namespace connectivity::test
