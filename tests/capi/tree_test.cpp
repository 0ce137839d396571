// SPDX-License-Identifier: BSD-3-Clause
// Box trees through the interface: what the boxes hold, whatever form the host's arrays have, and
// boxes that the host brings itself.

#include <algorithm>
#include <set>
#include <string>

#include "tree_support.hpp"

namespace connectivity::test {
namespace {

using Ids = std::vector<std::int32_t>;

template <class T>
std::vector<T> values(const T* from, std::int64_t n) {
    return from == nullptr ? std::vector<T>() : std::vector<T>(from, from + n);
}

TEST(CapiTree, slices_hold_every_particle_once_within_its_enlarged_box) {
    const Context context;
    for (int dim = 1; dim <= 3; ++dim) {
        const Cloud cloud = cloud_with_radii(dim, static_cast<std::uint64_t>(dim));
        const Tree tree(context, cloud, with_radii(8));
        const TreeArrays t(tree.handle);
        ASSERT_EQ(t->dim, dim);
        ASSERT_EQ(t->n_sources, 150);
        ASSERT_EQ(t->extent_norm, CONN_EXTENT_LINF);
        ASSERT_EQ(t->level_start_box_nrs[t->n_levels], t->n_boxes);
        std::set<std::int32_t> seen;
        for (std::int32_t b = 0; b < t->n_boxes; ++b) {
            for (int k = 0; k < t->box_source_counts_nonchild[b]; ++k) {
                const std::int32_t s = t->box_source_starts[b] + k, user = t->user_source_ids[s];
                EXPECT_TRUE(seen.insert(user).second);
                const auto place = static_cast<std::size_t>(user);
                EXPECT_EQ(t->source_radii[s], cloud.source_radii[place]);
                for (int d = 0; d < dim; ++d) {
                    const double x = t->sources[d * t->n_sources + s];
                    EXPECT_EQ(x, cloud.sources[place * static_cast<std::size_t>(dim) +
                                               static_cast<std::size_t>(d)]);
                    EXPECT_LE(std::abs(x - t.center(d, b)) + t->source_radii[s],
                              (b == 0 ? 2 : 1.25) * t.half_width(b) * (1 + 1e-12));
                }
            }
            if (b > 0) {
                EXPECT_EQ(t->box_levels[b], t->box_levels[t->box_parent_ids[b]] + 1);
            }
        }
        EXPECT_EQ(seen.size(), 150u);
    }
}

/// The tree of the same particles, given as `sources` and `radii` say.
Ids boxes_of(const Context& context, const std::vector<conn_array>& sources,
             const conn_array& targets, const conn_array& radii) {
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    input.n_sources = static_cast<std::int32_t>(sources.size());
    input.sources = sources.data();
    input.targets = &targets;
    input.source_radii = &radii;
    conn_tree_options options = with_radii(6);
    options.bounding_box = 1;
    for (int d = 0; d < 3; ++d) {
        options.box_lo[d] = -0.5;
        options.box_hi[d] = 1.5;
    }
    const Tree tree(context);
    EXPECT_TRUE(ok(conn_tree_build(tree.handle, &input, &options)));
    const TreeArrays t(tree.handle);
    Ids all = values(t->box_child_ids, 8 * t->aligned_n_boxes);
    for (const Ids& more :
         {values(t->user_source_ids, t->n_sources), values(t->box_source_starts, t->n_boxes),
          values(t->box_source_counts_nonchild, t->n_boxes)})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

TEST(CapiTree, every_form_of_the_arrays_gives_the_same_boxes) {
    const Context context;
    Random random(5);
    constexpr int n = 200;
    std::vector<double> x(n * 3), planar(n * 3), reversed(n * 3), target(3, 0.5), r(n, 0.015625);
    std::vector<float> floats(n * 3);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t d = 0; d < 3; ++d) {
            const double value = random.below(1 << 20) * 0x1p-20;  // whole in float32, too
            x[3 * i + d] = planar[d * n + i] = reversed[3 * (n - 1 - i) + d] = value;
            floats[3 * i + d] = static_cast<float>(value);
        }
    const conn_array one = conn_array_matrix(target.data(), 1, 3),
                     each = conn_array_vector(r.data(), n);
    const Ids expected = boxes_of(context, {conn_array_matrix(x.data(), n, 3)}, one, each);
    EXPECT_EQ(boxes_of(context, {conn_array_planar(planar.data(), n, 3)}, one, each), expected);
    EXPECT_EQ(boxes_of(context,
                       {conn_array_vector(planar.data(), n), conn_array_vector(&planar[n], n),
                        conn_array_vector(&planar[2 * n], n)},
                       one, each),
              expected);
    conn_array backwards = conn_array_matrix(&reversed[3 * (n - 1)], n, 3), same = each;
    backwards.stride[0] = -3;
    same.stride[0] = 0;
    EXPECT_EQ(boxes_of(context, {backwards}, one, same), expected);
    const float middle[] = {0.5f, 0.5f, 0.5f}, radius = 0.015625f;
    conn_array small = conn_array_vector_float(&radius, n);
    small.stride[0] = 0;
    EXPECT_EQ(boxes_of(context, {conn_array_matrix_float(floats.data(), n, 3)},
                       conn_array_matrix_float(middle, 1, 3), small),
              expected);
}

TEST(CapiTree, weights_of_any_whole_type_split_as_particles_do) {
    const Context context;
    Random random(9);
    const std::vector<double> x = random_points(random, 2, 120);
    const conn_array sources = conn_array_matrix(x.data(), 120, 2);
    conn_tree_options options = leaf_of(5);
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    input.dim = 2;
    input.sources = &sources;
    const Tree tree(context);
    ASSERT_TRUE(ok(conn_tree_build(tree.handle, &input, &options)));
    const std::int64_t n_boxes = TreeArrays(tree.handle)->n_boxes;
    options.max_particles_in_box = -1;
    options.max_leaf_refine_weight = 15;
    const Ids threes(120, 3);
    const std::int64_t three = 3;
    const conn_array narrow = conn_array_vector_int32(threes.data(), 120);
    conn_array wide = conn_array_vector_int64(&three, 120);
    wide.stride[0] = 0;
    for (const conn_array& weights : {narrow, wide}) {
        input.refine_weights = &weights;
        ASSERT_TRUE(ok(conn_tree_build(tree.handle, &input, &options)));
        EXPECT_EQ(TreeArrays(tree.handle)->n_boxes, n_boxes);
    }
}

TEST(CapiTree, boxes_of_the_host_have_the_lists_of_the_tree_they_were_taken_from) {
    const Context context;
    for (const bool has_radii : {false, true}) {
        Cloud cloud = cloud_with_radii(2, 6);
        if (!has_radii) cloud.source_radii = cloud.target_radii = {};
        const Tree tree(context, cloud, has_radii ? with_radii(5) : leaf_of(5)), copy(context);
        const TreeArrays arrays(tree.handle);
        ASSERT_TRUE(ok(conn_tree_set_boxes(copy.handle, &arrays.view)));
        const InteractionLists lists(context, tree), of_copy(context, copy);
        for (int which = 0; which < 12; ++which)
            for (int level = 0;
                 level < (which == CONN_LIST_FROM_SEP_SMALLER ? arrays->n_levels : 1); ++level) {
                const BoxRows ours(of_copy.handle, which, level),
                    theirs(lists.handle, which, level);
                ASSERT_EQ(ours->is_none, theirs->is_none);
                if (ours->is_none) continue;
                EXPECT_EQ(ours.entries(), theirs.entries()) << which;
                EXPECT_EQ(ours.starts(), theirs.starts()) << which;
            }
        conn_box_list_view view = CONN_BOX_LIST_VIEW_INIT;
        const std::vector<std::uint8_t> flags(110, 1);
        EXPECT_TRUE(fails(conn_tree_filter_targets(copy.handle, flags.data(), 110, &view),
                          CONN_E_ARGUMENT, {"conn_tree_set_boxes"}));
        ASSERT_TRUE(ok(copy.build(cloud, has_radii ? with_radii(7) : leaf_of(7))));
        EXPECT_NE(TreeArrays(copy.handle)->user_source_ids, nullptr);
    }
}

TEST(CapiTree, boxes_that_contradict_each_other_are_refused) {
    const Context context;
    const Tree tree(context, cloud_with_radii(2, 6), with_radii(5)), copy(context);
    const TreeArrays arrays(tree.handle);
    const auto refused = [&](auto spoil) {
        conn_tree_view boxes = arrays.view;
        spoil(boxes);
        return conn_tree_set_boxes(copy.handle, &boxes);
    };
    using V = conn_tree_view;
    Ids parents = values(arrays->box_parent_ids, arrays->n_boxes);
    parents.back() = 1 << 30;
    Ids starts = values(arrays->level_start_box_nrs, arrays->n_levels + 1);
    starts[1] = -4;
    EXPECT_TRUE(fails(refused([&](V& v) { v.box_parent_ids = parents.data(); }), CONN_E_ARGUMENT,
                      {"another parent"}));
    EXPECT_TRUE(
        fails(refused([&](V& v) { v.level_start_box_nrs = starts.data(); }), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(refused([](V& v) { v.dim = 4; }), CONN_E_ARGUMENT, {"dim = 4"}));
    EXPECT_TRUE(fails(refused([](V& v) { v.n_boxes = 0; }), CONN_E_ARGUMENT, {"n_boxes = 0"}));
    EXPECT_TRUE(fails(refused([](V& v) { v.aligned_n_boxes = v.n_boxes - 1; }), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(refused([](V& v) { v.root_extent = std::nan(""); }), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(refused([](V& v) { v.extent_norm = 3; }), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(refused([](V& v) { v.n_sources = -1; }), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(refused([](V& v) { v.box_flags = nullptr; }), CONN_E_NULL, {"box_flags"}));
    conn_tree_view view = CONN_TREE_VIEW_INIT;
    EXPECT_TRUE(fails(conn_tree_acquire(copy.handle, CONN_SPACE_HOST, &view), CONN_E_NOT_BUILT));
}

}  // namespace
}  // namespace connectivity::test
