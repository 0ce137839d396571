// SPDX-License-Identifier: BSD-3-Clause
// Interaction lists through the interface: every target meets every source once, lists that are
// known from the definition, classes and work counts from the entries themselves.

#include <algorithm>
#include <map>
#include <string>

#include "tree_support.hpp"

namespace connectivity::test {
namespace {

using Ids = std::vector<std::int32_t>;

/// Who met whom, by the host's indices, as an FMM with these lists would have it.
class Meetings {
public:
    Meetings(const TreeArrays& tree, const conn_lists* lists)
        : tree_(tree.view),
          user_target_(static_cast<std::size_t>(tree->n_targets)),
          n_met_(static_cast<std::size_t>(tree->n_targets * tree->n_sources)) {
        for (std::int64_t t = 0; t < tree_.n_targets; ++t)
            user_target_[static_cast<std::size_t>(tree_.sorted_target_ids[t])] = t;
        for (const int which : {CONN_LIST_NEIGHBOR_SOURCE_BOXES, CONN_LIST_FROM_SEP_CLOSE_SMALLER,
                                CONN_LIST_FROM_SEP_CLOSE_BIGGER})
            add(lists, which, 0, false, false);
        add(lists, CONN_LIST_FROM_SEP_SIBLINGS, 0, true, true);
        for (int level = 0; level < tree_.n_levels; ++level)
            add(lists, CONN_LIST_FROM_SEP_SMALLER, level, false, true);
        add(lists, CONN_LIST_FROM_SEP_BIGGER, 0, true, false);
    }
    /// The number that every pair met, or -1 where they differ.
    int everyone() const {
        const bool same = std::ranges::all_of(n_met_, [&](int n) { return n == n_met_[0]; });
        return same ? n_met_.at(0) : -1;
    }

private:
    void add(const conn_lists* lists, int which, int level, bool targets_below,
             bool sources_below) {
        const BoxRows rows(lists, which, level);
        for (std::int64_t r = 0; r < rows->n_rows; ++r)
            for (const std::int32_t s : rows[r])
                meet(rows->row_boxes[r], s, targets_below, sources_below);
    }
    void meet(std::int32_t t, std::int32_t s, bool targets_below, bool sources_below) {
        const int n_t = (targets_below ? tree_.box_target_counts_cumul
                                       : tree_.box_target_counts_nonchild)[t],
                  n_s = (sources_below ? tree_.box_source_counts_cumul
                                       : tree_.box_source_counts_nonchild)[s];
        for (int a = 0; a < n_t; ++a)
            for (int b = 0; b < n_s; ++b) {
                const auto target =
                    user_target_[static_cast<std::size_t>(tree_.box_target_starts[t] + a)];
                const auto source = tree_.user_source_ids[tree_.box_source_starts[s] + b];
                ++n_met_[static_cast<std::size_t>(target * tree_.n_sources + source)];
            }
    }

    const conn_tree_view& tree_;
    std::vector<std::int64_t> user_target_;
    std::vector<int> n_met_;
};

/// A random host: dimension, extents on either side, kinds, norms, criteria, periodic axes.
struct Host {
    Cloud cloud;
    conn_tree_options tree = CONN_TREE_OPTIONS_INIT;
    conn_lists_options lists = CONN_LISTS_OPTIONS_INIT;
    int n_images = 1;

    explicit Host(std::uint64_t seed) {
        Random random(seed);
        cloud.dim = static_cast<int>(seed % 3) + 1;
        const double steepness = random.chance(0.5) ? 4 : 1;
        const int n_sources = 1 + random.below(120), n_targets = 1 + random.below(120);
        cloud.sources = random_points(random, cloud.dim, n_sources, steepness);
        cloud.has_targets = random.chance(0.7);
        if (cloud.has_targets) choose_targets(random, n_sources, n_targets, steepness);
        tree.max_particles_in_box = 1 + random.below(12);
        tree.kind = random.below(3);
        tree.coincident = CONN_COINCIDENT_LEAF;
        tree.hulls = CONN_HULLS_ALWAYS;
        lists.well_sep_is_n_away = 1 + random.below(3);
        if (random.chance(0.2)) lists.from_sep_smaller_min_nsources_cumul = random.below(9);
        if (random.chance(0.2)) make_periodic(random);
    }

private:
    void choose_targets(Random& random, int n_sources, int n_targets, double steepness) {
        cloud.targets = random_points(random, cloud.dim, n_targets, steepness);
        if (random.chance(0.6)) cloud.target_radii = random_radii(random, n_targets);
        if (random.chance(0.4)) cloud.source_radii = random_radii(random, n_sources);
        if (cloud.target_radii.empty() && cloud.source_radii.empty()) return;
        tree.stick_out_factor = random.uniform(0, 0.5);
        tree.extent_norm = random.chance(0.5) ? CONN_EXTENT_L2 : CONN_EXTENT_LINF;
        do lists.from_sep_smaller_crit = random.below(4);
        while (lists.from_sep_smaller_crit == CONN_CRIT_STATIC_LINF &&
               tree.extent_norm == CONN_EXTENT_L2);
    }
    void make_periodic(Random& random) {
        tree.bounding_box = 1;
        for (int d = 0; d < cloud.dim; ++d) {
            tree.box_lo[d] = -0.5;
            tree.box_hi[d] = 1.5;
            tree.periodic[d] = random.below(2);
            if (tree.periodic[d]) n_images *= 3;
        }
    }
};

TEST(CapiLists, every_target_meets_every_source_once) {
    const Context context;
    const Tree tree(context);
    const InteractionLists lists(context);
    int n_close = 0, n_deep = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        const Host host(seed);
        ASSERT_TRUE(ok(tree.build(host.cloud, host.tree))) << seed;
        ASSERT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, &host.lists))) << seed;
        const TreeArrays arrays(tree.handle);
        ASSERT_EQ(Meetings(arrays, lists.handle).everyone(), host.n_images) << seed;
        n_close += BoxRows(lists.handle, CONN_LIST_FROM_SEP_CLOSE_SMALLER)->n_entries > 0;
        n_deep += arrays->n_levels > 4;
        ASSERT_TRUE(ok(conn_lists_merge_close(lists.handle))) << seed;
        ASSERT_EQ(BoxRows(lists.handle, CONN_LIST_FROM_SEP_CLOSE_SMALLER)->is_none, 1);
        ASSERT_EQ(Meetings(arrays, lists.handle).everyone(), host.n_images) << seed << " merged";
    }
    EXPECT_GT(n_close, 10);
    EXPECT_GT(n_deep, 30);
}

/// 8 points at the middles of the eighths of [0, 1], a leaf each: a complete binary tree, box i of
/// level l is 2^l - 1 + i.
class CapiListsOfALine : public ::testing::Test {
protected:
    CapiListsOfALine() {
        Cloud cloud;
        cloud.dim = 1;
        for (int i = 0; i < 8; ++i) cloud.sources.push_back((i + 0.5) / 8);
        conn_tree_options options = leaf_of(1);
        options.bounding_box = 1;
        options.box_hi[0] = 1;
        EXPECT_TRUE(ok(tree.build(cloud, options)));
        EXPECT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, nullptr)));
    }
    static Ids level(int l, const std::vector<int>& places) {
        Ids boxes;
        for (const int i : places) boxes.push_back((1 << l) - 1 + i);
        return boxes;
    }

    Context context;
    Tree tree{context};
    InteractionLists lists{context};
};

TEST_F(CapiListsOfALine, lists_are_those_of_the_definitions) {
    const Ids leaves = level(3, {0, 1, 2, 3, 4, 5, 6, 7});
    const BoxRows targets(lists.handle, CONN_LIST_TARGET_BOXES),
        parents(lists.handle, CONN_LIST_SOURCE_PARENT_BOXES),
        near(lists.handle, CONN_LIST_SAME_LEVEL_NON_WELL_SEP_BOXES),
        colleagues(lists.handle, CONN_LIST_COLLEAGUES),
        direct(lists.handle, CONN_LIST_NEIGHBOR_SOURCE_BOXES),
        siblings(lists.handle, CONN_LIST_FROM_SEP_SIBLINGS),
        bigger(lists.handle, CONN_LIST_FROM_SEP_BIGGER);
    EXPECT_EQ(targets.entries(), leaves);
    EXPECT_EQ(targets.starts(), (std::vector<std::int64_t>{0, 0, 0, 0, 8}));
    EXPECT_EQ(parents.entries(), (Ids{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(parents.starts(), (std::vector<std::int64_t>{0, 1, 3, 7, 7}));
    EXPECT_EQ(near->row_boxes, nullptr);
    EXPECT_EQ(near->n_rows, 15);
    EXPECT_EQ(near.row(0), Ids());
    EXPECT_EQ(near.row(4), level(2, {0, 2}));
    EXPECT_EQ(near.row(14), level(3, {6}));
    EXPECT_EQ(colleagues.entries(), near.entries());
    EXPECT_EQ(Ids(direct->row_boxes, direct->row_boxes + direct->n_rows), leaves);
    EXPECT_EQ(direct.row(0), level(3, {0, 1}));
    EXPECT_EQ(direct.row(3), level(3, {2, 3, 4}));
    EXPECT_EQ(siblings->n_rows, 15);
    EXPECT_EQ(siblings.row(5), level(2, {0}));
    EXPECT_EQ(siblings.row(7 + 2), level(3, {0, 4, 5}));
    EXPECT_EQ(siblings.row(7 + 5), level(3, {2, 3, 7}));
    EXPECT_EQ(bigger->n_entries, 0);
    for (int l = 0; l < 4; ++l)
        EXPECT_EQ(BoxRows(lists.handle, CONN_LIST_FROM_SEP_SMALLER, l)->n_rows, 0);
}

TEST_F(CapiListsOfALine, what_a_tree_cannot_have_is_none_and_what_was_not_asked_for_an_error) {
    for (const int which : {CONN_LIST_FROM_SEP_CLOSE_SMALLER, CONN_LIST_FROM_SEP_CLOSE_BIGGER}) {
        const BoxRows none(lists.handle, which);
        EXPECT_EQ(none->is_none, 1);
        EXPECT_EQ(none->n_rows, 0);
    }
    conn_lists_options options = CONN_LISTS_OPTIONS_INIT;
    options.well_sep_is_n_away = 2;
    options.from_sep_siblings = 0;
    ASSERT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, &options)));
    EXPECT_EQ(BoxRows(lists.handle, CONN_LIST_COLLEAGUES)->is_none, 1);
    conn_box_list_view view = CONN_BOX_LIST_VIEW_INIT;
    conn_classes_view classes = CONN_CLASSES_VIEW_INIT;
    EXPECT_TRUE(fails(
        conn_lists_acquire(lists.handle, CONN_LIST_FROM_SEP_SIBLINGS, 0, CONN_SPACE_HOST, &view),
        CONN_E_NOT_BUILT, {"from_sep_siblings"}));
    EXPECT_TRUE(fails(
        conn_lists_classes_acquire(lists.handle, CONN_CLASSES_ROTATION, CONN_SPACE_HOST, &classes),
        CONN_E_NOT_BUILT));
    EXPECT_EQ(view.owner, nullptr);
}

TEST_F(CapiListsOfALine, masked_boxes_are_left_out_of_the_sources) {
    std::vector<std::uint8_t> own(15, 1), parents(15, 1);
    own[7] = parents[0] = parents[6] = 0;
    conn_lists_options options = CONN_LISTS_OPTIONS_INIT;
    options.source_boxes_mask = own.data();
    options.source_parent_boxes_mask = parents.data();
    EXPECT_TRUE(fails(conn_lists_rebuild(lists.handle, tree.handle, &options), CONN_E_ARGUMENT,
                      {"n_mask = 0", "15"}));
    options.n_mask = 15;
    ASSERT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, &options)));
    EXPECT_EQ(BoxRows(lists.handle, CONN_LIST_SOURCE_BOXES).entries(),
              level(3, {1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(BoxRows(lists.handle, CONN_LIST_SOURCE_PARENT_BOXES).entries(), (Ids{1, 2, 3, 4, 5}));
}

TEST_F(CapiListsOfALine, classes_of_translations_and_rotations_are_those_of_the_entries) {
    const TreeArrays boxes(tree.handle);
    const BoxRows siblings(lists.handle, CONN_LIST_FROM_SEP_SIBLINGS);
    const Classes per_level(lists.handle, CONN_CLASSES_TRANSLATION_PER_LEVEL),
        free(lists.handle, CONN_CLASSES_TRANSLATION),
        rotations(lists.handle, CONN_CLASSES_ROTATION);
    ASSERT_EQ(per_level->n_entries, siblings->n_entries);
    EXPECT_EQ(per_level->n_classes, 8);  // -3, -2, 2, 3 boxes of level 2 and of level 3
    EXPECT_EQ(Ids(per_level->level_starts, per_level->level_starts + 5), (Ids{0, 0, 0, 4, 8}));
    EXPECT_EQ(free->n_classes, 4);
    EXPECT_EQ(free->n_levels, 1);
    EXPECT_EQ(rotations->n_classes, 2);
    EXPECT_EQ(rotations->vectors, nullptr);
    EXPECT_EQ(per_level->angles, nullptr);
    for (std::int64_t r = 0, k = 0; r < siblings->n_rows; ++r)
        for (const std::int32_t s : siblings[r]) {
            const std::int32_t t = siblings->row_boxes[r];
            const double v = boxes.center(0, t) - boxes.center(0, s);
            EXPECT_EQ(per_level->vectors[per_level->classes[k]], v);
            EXPECT_EQ(free->vectors[free->classes[k]], std::ldexp(v, boxes->box_levels[t]));
            EXPECT_NEAR(rotations->angles[rotations->classes[k]], v > 0 ? 0 : std::acos(-1.0),
                        1e-15);
            ++k;
        }
}

/// What the lists say, added up box by box.
std::vector<std::int64_t> sums(const conn_lists* lists, int which, const std::int32_t* per_row,
                               const std::int32_t* per_entry, std::int64_t n_boxes, int n_levels) {
    std::vector<std::int64_t> work(static_cast<std::size_t>(n_boxes), 0);
    for (int level = 0; level < n_levels; ++level) {
        const BoxRows rows(lists, which, level);
        for (std::int64_t r = 0; r < rows->n_rows; ++r)
            for (const std::int32_t s : rows[r]) {
                const std::int32_t t = rows->row_boxes[r];
                work[static_cast<std::size_t>(t)] +=
                    std::int64_t{per_row == nullptr ? 1 : per_row[t]} *
                    (per_entry == nullptr ? 1 : per_entry[s]);
            }
    }
    return work;
}

TEST(CapiLists, work_counts_are_sums_over_the_lists) {
    const Context context;
    for (const std::uint64_t seed : {3, 5, 8, 13}) {
        const Host host(seed);
        const Tree tree(context, host.cloud, host.tree);
        const InteractionLists lists(context, tree, host.lists);
        const TreeArrays t(tree.handle);
        const auto expect = [&](int kind, int which, const std::int32_t* targets,
                                const std::int32_t* sources) {
            std::int64_t total = -1, sum = 0;
            const int n_levels = which == CONN_LIST_FROM_SEP_SMALLER ? t->n_levels : 1;
            const auto ours = two_calls<std::int64_t>(
                [&](auto... out) { return conn_lists_work(lists.handle, kind, out..., &total); });
            EXPECT_EQ(ours, sums(lists.handle, which, targets, sources, t->n_boxes, n_levels))
                << seed << " " << kind;
            for (const std::int64_t w : ours) sum += w;
            EXPECT_EQ(total, sum);
        };
        const std::int32_t *targets = t->box_target_counts_nonchild,
                           *sources = t->box_source_counts_nonchild;
        expect(CONN_WORK_P2P, CONN_LIST_NEIGHBOR_SOURCE_BOXES, targets, sources);
        expect(CONN_WORK_M2L, CONN_LIST_FROM_SEP_SIBLINGS, nullptr, nullptr);
        expect(CONN_WORK_M2P, CONN_LIST_FROM_SEP_SMALLER, targets, nullptr);
        expect(CONN_WORK_P2L, CONN_LIST_FROM_SEP_BIGGER, nullptr, sources);
        expect(CONN_WORK_FROM_SEP_SMALLER_ENTRIES, CONN_LIST_FROM_SEP_SMALLER, nullptr, nullptr);
        expect(CONN_WORK_FROM_SEP_BIGGER_ENTRIES, CONN_LIST_FROM_SEP_BIGGER, nullptr, nullptr);
    }
}

TEST(CapiLists, views_stay_through_rebuilds_and_the_end_of_lists_and_tree) {
    const Context context;
    const Host host(5), other(7);
    std::optional<Tree> tree(std::in_place, context, host.cloud, host.tree);
    std::optional<InteractionLists> lists(std::in_place, context, *tree, host.lists);
    std::optional<TreeArrays> arrays(std::in_place, tree->handle);
    const BoxRows rows(lists->handle, CONN_LIST_NEIGHBOR_SOURCE_BOXES);
    const Classes classes(lists->handle, CONN_CLASSES_TRANSLATION);
    const Ids entries = rows.entries(),
              of_entries(classes->classes, classes->classes + classes->n_entries),
              users(arrays->view.user_source_ids,
                    arrays->view.user_source_ids + arrays->view.n_sources);
    EXPECT_EQ(rows->generation, arrays->view.generation);
    ASSERT_TRUE(ok(tree->build(other.cloud, other.tree)));
    EXPECT_EQ(BoxRows(lists->handle, CONN_LIST_NEIGHBOR_SOURCE_BOXES).entries(), entries);
    ASSERT_TRUE(ok(conn_lists_rebuild(lists->handle, tree->handle, &other.lists)));
    EXPECT_NE(BoxRows(lists->handle, CONN_LIST_NEIGHBOR_SOURCE_BOXES)->generation,
              rows->generation);
    const auto expect_the_same = [&] {
        EXPECT_EQ(rows.entries(), entries);
        EXPECT_EQ(Ids(classes->classes, classes->classes + classes->n_entries), of_entries);
        EXPECT_EQ(Ids(arrays->view.user_source_ids,
                      arrays->view.user_source_ids + arrays->view.n_sources),
                  users);
    };
    expect_the_same();
    lists.reset();
    tree.reset();
    expect_the_same();
}

TEST(CapiLists, a_failed_rebuild_keeps_the_old_lists) {
    const Context context;
    const Host host(5);
    const Tree tree(context, host.cloud, host.tree), empty(context);
    const InteractionLists lists(context, tree, host.lists);
    const auto before = BoxRows(lists.handle, CONN_LIST_FROM_SEP_SIBLINGS).entries();
    const auto refused = [&](auto spoil) {
        conn_lists_options options = CONN_LISTS_OPTIONS_INIT;
        spoil(options);
        return conn_lists_rebuild(lists.handle, tree.handle, &options);
    };
    using O = conn_lists_options;
    EXPECT_TRUE(fails(refused([](O& o) { o.well_sep_is_n_away = 0; }), CONN_E_ARGUMENT));
    EXPECT_TRUE(
        fails(refused([](O& o) { o.from_sep_smaller_crit = 4; }), CONN_E_ARGUMENT, {"CONN_CRIT"}));
    EXPECT_TRUE(fails(refused([](O& o) { o.from_sep_siblings = 2; }), CONN_E_ARGUMENT,
                      {"from_sep_siblings = 2"}));
    EXPECT_TRUE(fails(refused([](O& o) { o.reserved = 1; }), CONN_E_UNSUPPORTED, {"reserved"}));
    EXPECT_TRUE(fails(refused([](O& o) { o.n_mask = 3; }), CONN_E_ARGUMENT, {"n_mask = 3"}));
    EXPECT_TRUE(fails(refused([](O& o) { o.budget_bytes = -1; }), CONN_E_ARGUMENT, {"-1"}));
    EXPECT_TRUE(fails(refused([](O& o) { o.budget_bytes = 1; }), CONN_E_BUDGET));
    EXPECT_TRUE(fails(conn_lists_rebuild(lists.handle, empty.handle, nullptr), CONN_E_NOT_BUILT,
                      {"conn_tree_build"}));
    EXPECT_EQ(BoxRows(lists.handle, CONN_LIST_FROM_SEP_SIBLINGS).entries(), before);
}

}  // namespace
}  // namespace connectivity::test
