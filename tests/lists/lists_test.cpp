// SPDX-License-Identifier: BSD-3-Clause
/// Depth, options, reuse, classes and work counts on chosen trees.

#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/work.hpp>

#include "lists/brute_lists.hpp"
#include "lists/random_lists_case.hpp"

namespace connectivity::test {
namespace {

SlowInput uniform_input(int dim, int n, int leaf = 3) {
    Random random(42);
    SlowInput in;
    in.dim = dim;
    in.leaf = leaf;
    in.sources_are_targets = true;
    for (int i = 0; i < n; ++i)
        in.sources.push_back(
            {{random.uniform(), random.uniform(), dim > 2 ? random.uniform() : 0}});
    return in;
}

template <class T>
std::vector<T> values(const ConstView<T>& view) {
    return {view.data(), view.data() + view.size()};
}

/// The tree at the bottom of a chain of boxes that have one child each.
TreeView below_chain(const TreeView& tree, int length) {
    TreeView deep = tree;
    const Offset n = tree.n_boxes + length, stride = n;
    deep.n_boxes = n;
    deep.aligned_n_boxes = stride;
    deep.n_levels = tree.n_levels + length;
    auto starts = allocate<BoxId>("starts", deep.n_levels + 1),
         parents = allocate<BoxId>("parents", n),
         children = allocate_zeroed<BoxId>("children", (1 << tree.dim) * stride);
    auto levels = allocate<std::uint8_t>("levels", n), flags = allocate<std::uint8_t>("flags", n);
    for (int b = 0; b < length; ++b) {
        starts(b) = b;
        parents(b) = std::max(0, b - 1);
        children((b % 3) * stride + b) = b + 1;  // child numbers 0, 1, 2 in turn
        levels(b) = static_cast<std::uint8_t>(b);
        flags(b) = 4 | 8;
    }
    for (int l = 0; l <= tree.n_levels; ++l)
        starts(length + l) = tree.level_start_box_nrs(l) + length;
    for (BoxId b = 0; b < tree.n_boxes; ++b) {
        parents(b + length) = b == 0 ? length - 1 : tree.box_parent_ids(b) + length;
        levels(b + length) = static_cast<std::uint8_t>(tree.box_levels(b) + length);
        flags(b + length) = tree.box_flags(b);
        for (int m = 0; m < 1 << tree.dim; ++m)
            if (const BoxId c = tree.child(m, b); c != 0)
                children(m * stride + b + length) = c + length;
    }
    deep.level_start_box_nrs = starts;
    deep.box_parent_ids = parents;
    deep.box_child_ids = children;
    deep.box_levels = levels;
    deep.box_flags = flags;
    return deep;
}

TEST(DeepTrees, have_the_lists_they_have_near_the_root) {
    const SlowTree tree(uniform_input(2, 300));
    for (const int n_away : {1, 2}) {
        TraversalOptions options;
        options.well_sep_is_n_away = n_away;
        const FMMTraversalInfo near_root(tree.view(), options);
        constexpr int length = 240;
        const FMMTraversalInfo deep(below_chain(tree.view(), length), options);
        ASSERT_GT(deep.nlevels(), 243);
        const auto expect_same = [&](const BoxList& a, const BoxList& b, Offset skip) {
            for (Offset i = 0; i < a.size(); ++i) {
                Row wanted = row_of(a, i);
                for (Entry& e : wanted) e.box += length;
                ASSERT_EQ(row_of(b, i + skip), wanted);
            }
        };
        expect_same(near_root.neighbor_source_boxes(), deep.neighbor_source_boxes(), 0);
        expect_same(near_root.from_sep_siblings(), deep.from_sep_siblings(), length);
        expect_same(near_root.from_sep_bigger(), deep.from_sep_bigger(), length);
        expect_same(near_root.same_level_non_well_sep_boxes(), deep.same_level_non_well_sep_boxes(),
                    length);
        for (int level = 0; level < near_root.nlevels(); ++level)
            expect_same(near_root.from_sep_smaller(level), deep.from_sep_smaller(level + length),
                        0);
        const TranslationClassesInfo a(near_root), b(deep);
        EXPECT_EQ(values(a.from_sep_siblings_translation_classes()),
                  values(b.from_sep_siblings_translation_classes()));
    }
}

TEST(AnyN, beyond_the_tree_makes_everything_direct) {
    const SlowTree tree(uniform_input(2, 60));
    TraversalOptions options;
    for (const int n : {100, 20000, 2000000000}) {
        options.well_sep_is_n_away = n;
        const FMMTraversalInfo lists(tree.view(), options);
        EXPECT_EQ(lists.from_sep_siblings().lists.size(), 0u);
        EXPECT_FALSE(lists.colleagues());
    }
}

TEST(Options, build_only_what_is_asked_for) {
    const SlowTree tree(uniform_input(3, 200));
    const FMMTraversalInfo all(tree.view());
    TraversalOptions options;
    options.same_level_non_well_sep_boxes = options.from_sep_siblings = false;
    options.from_sep_smaller = options.from_sep_bigger = false;
    const FMMTraversalInfo lists(tree.view(), options);
    EXPECT_EQ(values(lists.neighbor_source_boxes().lists),
              values(all.neighbor_source_boxes().lists));
    EXPECT_THROW(lists.from_sep_siblings(), Error);
    EXPECT_THROW(lists.from_sep_smaller(0), Error);
    EXPECT_THROW(lists.colleagues(), Error);
}

TEST(Options, lists_nobody_asked_for_hold_no_bytes_also_after_builds_that_had_them) {
    SlowInput in = uniform_input(2, 200);
    in.target_radii = true;
    in.stick_out = 0.25;
    const SlowTree tree(in);
    const std::vector<std::vector<std::string>> products{
        {"same_level_non_well_sep_boxes"},
        {"neighbor_source_boxes"},
        {"from_sep_siblings"},
        {"from_sep_smaller", "from_sep_close_smaller"},
        {"from_sep_bigger", "from_sep_close_bigger"}};
    FMMTraversalInfo lists(tree.view());
    for (const ReportEntry& entry : lists.report().entries())
        EXPECT_EQ(entry.bytes > 0, entry.built || entry.product == "scratch") << entry.product;
    for (std::size_t asked = 0; asked < products.size(); ++asked) {
        TraversalOptions options;
        bool* const wanted[] = {&options.same_level_non_well_sep_boxes,
                                &options.neighbor_source_boxes, &options.from_sep_siblings,
                                &options.from_sep_smaller, &options.from_sep_bigger};
        for (std::size_t k = 0; k < products.size(); ++k) *wanted[k] = k == asked;
        lists.rebuild(tree.view(), options);
        for (std::size_t k = 0; k < products.size(); ++k)
            for (const std::string& product : products[k]) {
                const ReportEntry* const entry = lists.report().find(product);
                ASSERT_NE(entry, nullptr) << product;
                EXPECT_EQ(entry->built, k == asked) << product;
                EXPECT_EQ(entry->bytes > 0, k == asked) << product;
                EXPECT_EQ(entry->asked_by.empty(), k != asked) << product;
                EXPECT_EQ(entry->ms, 0) << product;
            }
        lists.rebuild(tree.view());
    }
    lists.release_scratch();
    EXPECT_EQ(lists.scratch_bytes(), 0);
    EXPECT_EQ(lists.report().find("scratch")->bytes, 0);
}

TEST(Options, masks_restrict_the_source_lists_alone) {
    const SlowTree tree(uniform_input(2, 100));
    const FMMTraversalInfo all(tree.view());
    auto mask = allocate_zeroed<std::uint8_t>("mask", tree.view().n_boxes);
    for (Offset b = 0; b < tree.view().n_boxes; b += 2) mask(b) = 1;
    TraversalOptions options;
    options.source_boxes_mask = options.source_parent_boxes_mask = mask;
    const FMMTraversalInfo some(tree.view(), options);
    std::vector<BoxId> even;
    for (const BoxId b : values(all.source_boxes()))
        if (b % 2 == 0) even.push_back(b);
    EXPECT_EQ(values(some.source_boxes()), even);
    EXPECT_EQ(values(some.from_sep_siblings().lists), values(all.from_sep_siblings().lists));
    EXPECT_EQ(values(some.neighbor_source_boxes().lists),
              values(all.neighbor_source_boxes().lists));
}

TEST(Rebuild, leaves_copies_and_views_as_they_are) {
    const SlowTree small(uniform_input(2, 40)), large(uniform_input(3, 300));
    FMMTraversalInfo lists(large.view());
    const FMMTraversalInfo copy = lists.get();
    const BoxList held = lists.neighbor_source_boxes();
    const auto wanted = values(held.lists);
    lists.rebuild(small.view());
    EXPECT_EQ(values(held.lists), wanted);
    EXPECT_EQ(values(copy.neighbor_source_boxes().lists), wanted);
    EXPECT_EQ(values(lists.neighbor_source_boxes().lists),
              values(FMMTraversalInfo(small.view()).neighbor_source_boxes().lists));
    lists.rebuild(large.view());
    EXPECT_EQ(values(lists.neighbor_source_boxes().lists), wanted);
}

TEST(Classes, are_equal_exactly_where_translations_and_angles_are) {
    for (const int dim : {1, 2, 3})
        for (const bool periodic : {false, true}) {
            SlowInput in = uniform_input(dim, dim == 3 ? 400 : 200);
            for (int k = 0; k < dim; ++k) in.periodic[k] = periodic;
            const SlowTree tree(in);
            const FMMTraversalInfo lists(tree.view());
            const BruteLists brute(tree, {});
            const TranslationClassesInfo by_level(lists), free(lists, false);
            const RotationClassesInfo angles(lists);
            const BoxList list = lists.from_sep_siblings();
            std::set<int> used;
            for (Offset i = 0; i < list.size(); ++i)
                for (Offset e = list.starts(i); e < list.starts(i + 1); ++e) {
                    const BoxId t = lists.target_or_target_parent_boxes()(i);
                    const Point v = brute.between(t, {list.lists(e), list.image(e)});
                    const int level = tree.view().box_levels(t),
                              c = by_level.from_sep_siblings_translation_classes()(e),
                              f = free.from_sep_siblings_translation_classes()(e);
                    used.insert(c);
                    double square = 0;
                    for (int k = 0; k < dim; ++k) {
                        const Offset n = by_level.nfrom_sep_siblings_translation_classes(),
                                     m = free.nfrom_sep_siblings_translation_classes();
                        ASSERT_EQ(v[k],
                                  by_level.from_sep_siblings_translation_class_to_distance_vector()(
                                      k * n + c));
                        ASSERT_EQ(std::ldexp(v[k], level),
                                  free.from_sep_siblings_translation_class_to_distance_vector()(
                                      k * m + f));
                        square += v[k] * v[k];
                    }
                    ASSERT_NEAR(angles.from_sep_siblings_rotation_class_to_angle()(
                                    angles.from_sep_siblings_rotation_classes()(e)),
                                std::acos(v[dim - 1] / std::sqrt(square)), 1e-14);
                }
            EXPECT_EQ(used.size(), by_level.nfrom_sep_siblings_translation_classes());
            for (Offset a = 0; a < angles.nfrom_sep_siblings_rotation_classes(); ++a)
                for (Offset b = 0; b < a; ++b)
                    EXPECT_GT(std::abs(angles.from_sep_siblings_rotation_class_to_angle()(a) -
                                       angles.from_sep_siblings_rotation_class_to_angle()(b)),
                              1e-6);
        }
}

TEST(WorkCounts, add_up_what_the_lists_say) {
    SlowInput in = random_lists_case(5, false).tree;
    for (std::uint64_t seed = 5;
         !in.target_radii || in.sources.size() < 20 || in.targets.size() < 20; ++seed)
        in = random_lists_case(seed, false).tree;
    const SlowTree tree(in);
    TraversalOptions options;
    options.from_sep_smaller_crit = FromSepSmallerCrit::precise_linf;
    const FMMTraversalInfo lists(tree.view(), options);
    const WorkCounts work = count_work(lists);
    Work sum, wanted;
    for (Offset b = 0; b < lists.nboxes(); ++b) sum += work.boxes(b);
    EXPECT_EQ(sum, work.total);
    const auto own = [&](BoxId b, int kind) {
        return static_cast<Offset>(tree.box(b).own[kind].size());
    };
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        for (const Entry& e : row_of(lists.neighbor_source_boxes(), i))
            wanted.p2p += own(t, 1) * own(e.box, 0);
        for (const BoxList& close :
             {*lists.from_sep_close_smaller(), *lists.from_sep_close_bigger()})
            for (const Entry& e : row_of(close, i)) wanted.p2p_close += own(t, 1) * own(e.box, 0);
    }
    for (const auto& [t, row] : smaller_rows(lists)) wanted.m2p += own(t, 1) * row.size();
    for (const BoxId s : values(lists.from_sep_bigger().lists)) wanted.p2l += own(s, 0);
    EXPECT_EQ(work.total.p2p, wanted.p2p);
    EXPECT_EQ(work.total.p2p_close, wanted.p2p_close);
    EXPECT_EQ(work.total.m2p, wanted.m2p);
    EXPECT_EQ(work.total.p2l, wanted.p2l);
    EXPECT_EQ(work.total.m2l, lists.from_sep_siblings().starts(lists.from_sep_siblings().size()));
    EXPECT_EQ(work.total.p2m, static_cast<Offset>(in.sources.size()));
    EXPECT_EQ(work.total.l2p, static_cast<Offset>(in.targets.size()));
}

TEST(Starts, become_box_numbers_only_where_they_fit) {
    start_runtime();
    auto starts = allocate<Offset>("starts", 2);
    starts(0) = 0;
    starts(1) = 2147483647;
    EXPECT_EQ(starts_as_box_ids(starts)(1), 2147483647);
    starts(1) = 2147483648;
    EXPECT_THROW(starts_as_box_ids(starts), Error);
}

}  // namespace
}  // namespace connectivity::test
