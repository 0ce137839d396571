// SPDX-License-Identifier: BSD-3-Clause
// Lookups in box trees through the interface, against every box tried.

#include <algorithm>
#include <string>

#include "tree_support.hpp"

namespace connectivity::test {
namespace {

using Ids = std::vector<std::int32_t>;

/// A tree in two dimensions and balls, some outside.
class CapiTreeLookups : public ::testing::Test {
protected:
    CapiTreeLookups() {
        Random random(11);
        for (int k = 0; k < n_balls; ++k) {
            centers.push_back(random.uniform(-0.2, 1.2));
            centers.push_back(random.uniform(-0.2, 1.2));
            radii.push_back(random.uniform(0, 0.1));
        }
    }
    bool meets(std::int32_t box, std::size_t ball) const {
        bool is_close = true;
        for (int d = 0; d < 2; ++d)
            is_close &= distance(box, ball, d) <= boxes.half_width(box) + radii[ball];
        return is_close && boxes.is_leaf(box);
    }
    double distance(std::int32_t box, std::size_t ball, int d) const {
        return std::abs(centers[2 * ball + static_cast<std::size_t>(d)] - boxes.center(d, box));
    }

    static constexpr int n_balls = 40;
    std::vector<double> centers, radii;
    Context context;
    Cloud cloud = cloud_with_radii(2, 4);
    Tree tree{context, cloud, with_radii(6)};
    TreeArrays boxes{tree.handle};
};

Ids sorted(Ids ids) {
    std::ranges::sort(ids);
    return ids;
}

TEST_F(CapiTreeLookups, balls_meet_the_leaves_that_every_box_tried_says) {
    const conn_array x = conn_array_matrix(centers.data(), n_balls, 2),
                     r = conn_array_vector(radii.data(), n_balls);
    BoxRows area, balls;
    ASSERT_TRUE(ok(conn_tree_area_query(tree.handle, &x, 1, &r, &area.view)));
    ASSERT_TRUE(ok(conn_tree_leaves_to_balls(tree.handle, &x, 1, &r, &balls.view)));
    const auto invaders = two_calls<double>(
        [&](auto... out) { return conn_tree_space_invader(tree.handle, &x, 1, &r, out...); });
    ASSERT_EQ(area->n_rows, n_balls);
    ASSERT_EQ(balls->n_rows, boxes->n_boxes);
    std::vector<Ids> expected(n_balls);
    for (std::int32_t b = 0; b < boxes->n_boxes; ++b) {
        Ids here;
        double most = 0;
        for (std::size_t k = 0; k < n_balls; ++k)
            if (meets(b, k)) {
                here.push_back(static_cast<std::int32_t>(k));
                expected[k].push_back(b);
                most = std::max({most, distance(b, k, 0), distance(b, k, 1)});
            }
        EXPECT_EQ(balls.row(b), here) << b;
        EXPECT_EQ(invaders[static_cast<std::size_t>(b)], most) << b;
    }
    for (std::size_t k = 0; k < n_balls; ++k)
        EXPECT_EQ(sorted(area.row(static_cast<std::int64_t>(k))), expected[k]) << k;
}

TEST_F(CapiTreeLookups, peers_touch_are_not_smaller_and_have_no_such_child) {
    BoxRows peers;
    ASSERT_TRUE(ok(conn_tree_peers(tree.handle, &peers.view)));
    ASSERT_EQ(peers->n_rows, boxes->n_boxes);
    const auto is_candidate = [&](std::int32_t k, std::int32_t b) {
        return boxes->box_levels[k] <= boxes->box_levels[b] && boxes.gap(k, b) <= 1e-12;
    };
    for (std::int32_t b = 0; b < boxes->n_boxes; ++b) {
        Ids expected;
        for (std::int32_t k = 0; k < boxes->n_boxes; ++k) {
            bool is_peer = is_candidate(k, b);
            for (int m = 0; m < 4; ++m) {
                const std::int32_t c = boxes->box_child_ids[m * boxes->aligned_n_boxes + k];
                is_peer &= c == 0 || !is_candidate(c, b);
            }
            if (is_peer) expected.push_back(k);
        }
        EXPECT_EQ(sorted(peers.row(b)), expected) << b;
    }
}

TEST_F(CapiTreeLookups, kept_targets_are_those_of_the_flags) {
    std::vector<std::uint8_t> flags;
    for (int t = 0; t < 110; ++t) flags.push_back(t % 3 == 0 ? 200 : 0);
    BoxRows user;
    ParticleSets kept;
    ASSERT_TRUE(ok(conn_tree_filter_targets(tree.handle, flags.data(), 110, &user.view)));
    ASSERT_TRUE(
        ok(conn_tree_filter_targets_in_tree_order(tree.handle, flags.data(), 110, &kept.view)));
    ASSERT_EQ(kept->n, 37);
    EXPECT_EQ(kept->positions, nullptr);
    Ids user_of(110);
    for (std::size_t t = 0; t < 110; ++t)
        user_of[static_cast<std::size_t>(boxes->sorted_target_ids[t])] =
            static_cast<std::int32_t>(t);
    std::int32_t n_kept = 0;
    for (std::int32_t b = 0; b < boxes->n_boxes; ++b) {
        Ids expected;
        EXPECT_EQ(kept->box_starts[b],
                  std::count_if(user_of.begin(), user_of.begin() + boxes->box_target_starts[b],
                                [](int t) { return t % 3 == 0; }));
        for (int k = 0; k < boxes->box_target_counts_nonchild[b]; ++k) {
            const std::int32_t at = boxes->box_target_starts[b] + k,
                               target = user_of[static_cast<std::size_t>(at)];
            if (target % 3 != 0) continue;
            EXPECT_EQ(kept->ids[kept->box_starts[b] + static_cast<int>(expected.size())], at);
            expected.push_back(target);
        }
        EXPECT_EQ(user.row(b), expected) << b;
        EXPECT_EQ(kept->box_counts_nonchild[b], static_cast<int>(expected.size()));
        n_kept += kept->box_counts_nonchild[b];
    }
    EXPECT_EQ(n_kept, 37);
}

TEST_F(CapiTreeLookups, linked_point_sources_follow_their_sources) {
    std::vector<std::int64_t> starts{0};
    for (int s = 0; s < 150; ++s) starts.push_back(starts.back() + s % 4);
    const std::int64_t n = starts.back();
    Random random(2);
    const std::vector<double> x = random_points(random, 2, static_cast<int>(n));
    const conn_array points = conn_array_matrix(x.data(), n, 2);
    ParticleSets linked;
    ASSERT_TRUE(ok(
        conn_tree_link_point_sources(tree.handle, starts.data(), 151, &points, 1, &linked.view)));
    ASSERT_EQ(linked->n, n);
    ASSERT_EQ(linked->n_sources, 150);
    std::int32_t at = 0;
    for (std::int64_t s = 0; s < 150; ++s) {
        const auto user = static_cast<std::size_t>(boxes->user_source_ids[s]);
        EXPECT_EQ(linked->starts[s], at);
        ASSERT_EQ(linked->counts[s], starts[user + 1] - starts[user]);
        for (std::int64_t p = starts[user]; p < starts[user + 1]; ++p, ++at) {
            EXPECT_EQ(linked->ids[at], p);
            EXPECT_EQ(linked->positions[n + at], x[static_cast<std::size_t>(2 * p + 1)]);
        }
    }
    EXPECT_EQ(linked->box_counts_cumul[0], n);
}

TEST_F(CapiTreeLookups, bad_questions_are_refused) {
    const double no = std::nan(""), good = 0.1, negative = -1;
    const conn_array x = conn_array_matrix(centers.data(), n_balls, 2),
                     r = conn_array_vector(radii.data(), n_balls);
    conn_array bad = r, flat = conn_array_matrix(centers.data(), n_balls, 1);
    conn_box_list_view view = CONN_BOX_LIST_VIEW_INIT;
    const auto area = [&](const conn_array* centre, std::int32_t n, const conn_array* radius) {
        return conn_tree_area_query(tree.handle, centre, n, radius, &view);
    };
    EXPECT_TRUE(fails(area(nullptr, 1, &r), CONN_E_NULL, {"centers"}));
    EXPECT_TRUE(fails(area(&x, 1, nullptr), CONN_E_NULL, {"radii"}));
    EXPECT_TRUE(fails(area(&x, 3, &r), CONN_E_ARGUMENT, {"n_centers = 3"}));
    EXPECT_TRUE(fails(area(&flat, 1, &r), CONN_E_ARGUMENT, {"centers"}));
    bad = conn_array_vector(radii.data(), 3);
    EXPECT_TRUE(fails(area(&x, 1, &bad), CONN_E_ARGUMENT, {"radii.extent[0] = 3", "40"}));
    bad = conn_array_vector(&no, n_balls);
    bad.stride[0] = 0;
    EXPECT_TRUE(fails(area(&x, 1, &bad), CONN_E_SUPPORT, {"0"}));
    bad.data = &negative;
    EXPECT_TRUE(fails(area(&x, 1, &bad), CONN_E_SUPPORT, {"-1"}));
    bad.data = &good;
    bad.dtype = CONN_FLOAT32;
    EXPECT_TRUE(fails(area(&x, 1, &bad), CONN_E_ARGUMENT, {"radii.dtype"}));
    std::uint8_t flags[110] = {};
    EXPECT_TRUE(fails(conn_tree_filter_targets(tree.handle, flags, 109, &view), CONN_E_ARGUMENT,
                      {"109", "110"}));
    EXPECT_TRUE(fails(conn_tree_filter_targets(tree.handle, nullptr, 110, &view), CONN_E_NULL));
    conn_particles_view linked = CONN_PARTICLES_VIEW_INIT;
    std::vector<std::int64_t> starts(151, 0);
    starts[7] = 5;
    EXPECT_TRUE(fails(conn_tree_link_point_sources(tree.handle, starts.data(), 151, &x, 1, &linked),
                      CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(conn_tree_link_point_sources(tree.handle, starts.data(), 4, &x, 1, &linked),
                      CONN_E_ARGUMENT));
    EXPECT_EQ(view.owner, nullptr);
    EXPECT_EQ(linked.owner, nullptr);
}

}  // namespace
}  // namespace connectivity::test
