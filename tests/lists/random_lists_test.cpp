// SPDX-License-Identifier: BSD-3-Clause
/// Laws of the lists on random trees: definitions, coverage, separation.

#include "lists/coverage.hpp"
#include "lists/random_lists_case.hpp"

namespace connectivity::test {
namespace {

void expect_row(const char* name, BoxId box, const Row& ours, const Row& wanted) {
    ASSERT_EQ(ours.size(), wanted.size()) << name << " of box " << box;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        ASSERT_EQ(ours[i].box, wanted[i].box) << name << " of box " << box << ", entry " << i;
        ASSERT_EQ(ours[i].image, wanted[i].image) << name << " of box " << box << ", entry " << i;
    }
}

void expect_definitions(const FMMTraversalInfo& lists, const Rows& smaller_of,
                        const BruteLists& brute) {
    for (BoxId b = 0; b < lists.nboxes(); ++b)
        expect_row("same level", b, row_of(lists.same_level_non_well_sep_boxes(), b),
                   brute.same_level(b));
    const auto parents = lists.target_or_target_parent_boxes();
    for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
        expect_row("list 2", parents(i), row_of(lists.from_sep_siblings(), i),
                   brute.list2(parents(i)));
        expect_row("list 4", parents(i), row_of(lists.from_sep_bigger(), i),
                   brute.list4(parents(i)));
    }
    const bool close = lists.tree().have_extent();
    ASSERT_EQ(lists.from_sep_close_smaller().has_value(), close);
    ASSERT_EQ(lists.from_sep_close_bigger().has_value(), close);
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        expect_row("list 1", t, row_of(lists.neighbor_source_boxes(), i), brute.list1(t));
        Row smaller = brute.list3(t);
        std::stable_sort(smaller.begin(), smaller.end(), [&](const Entry& a, const Entry& b) {
            return lists.tree().box_levels(a.box) < lists.tree().box_levels(b.box);
        });
        expect_row("list 3", t, smaller_of.at(t), smaller);
        if (!close) continue;
        expect_row("3 close", t, row_of(*lists.from_sep_close_smaller(), i), brute.close3(t));
        expect_row("4 close", t, row_of(*lists.from_sep_close_bigger(), i), brute.close4(t));
    }
}

/// From the nearest of the particles (with their radii) to a point.
double nearest(const SlowTree& tree, int kind, const std::vector<int>& which, const Point& point,
               bool l2) {
    double least = std::numeric_limits<double>::infinity();
    for (const int i : which) {
        const SlowParticle& p = tree.particles(kind)[i];
        double square = 0, cube = 0;
        for (int k = 0; k < 3; ++k) {
            square += (p.x[k] - point[k]) * (p.x[k] - point[k]);
            cube = std::max(cube, std::abs(p.x[k] - point[k]));
        }
        least = std::min(least, (l2 ? std::sqrt(square) : cube) - p.radius);
    }
    return least;
}

/// Expansions keep off by their own size, measured at the particles themselves.
void expect_separation(const FMMTraversalInfo& lists, const Rows& smaller_of, const SlowTree& tree,
                       bool l2) {
    const SlowInput& in = tree.input();
    // Coordinates are rounded as they are made.
    const double rounding = 1e-15 * in.extent;
    constexpr double share = 1 - 1e-9;
    const auto shifted = [&](BoxId b, ImageCode image, int sign) {
        Point c = tree.box(b).center;
        for (int k = 0; k < 3; ++k) c[k] += sign * image_shift(image)[k] * in.extent;
        for (int k = in.dim; k < 3; ++k) c[k] = 0;
        return c;
    };
    const double s_source = in.source_radii ? 1 + in.stick_out : 1,
                 s_target = in.target_radii ? 1 + in.stick_out : 1;
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        for (const Entry& e : smaller_of.at(t))
            ASSERT_GE(nearest(tree, 1, tree.box(t).own[1], shifted(e.box, e.image, 1), l2),
                      3 * s_source * tree.half_width(e.box) * share - rounding)
                << "multipole of box " << e.box << " at the targets of " << t;
    }
    const auto boxes = lists.target_or_target_parent_boxes();
    for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
        const BoxId t = boxes(i);
        for (const Entry& e : row_of(lists.from_sep_bigger(), i))
            ASSERT_GE(nearest(tree, 0, tree.box(e.box).own[0], shifted(t, e.image, -1), l2),
                      3 * s_target * tree.half_width(t) * share - rounding)
                << "sources of box " << e.box << " in the local expansion of " << t;
        for (const Entry& e : row_of(lists.from_sep_siblings(), i))
            ASSERT_GT(tree.offset(t, e.box, image_shift(e.image)), lists.well_sep_is_n_away());
    }
}

void check_case(std::uint64_t seed, bool periodic) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ListsCase c = random_lists_case(seed, periodic);
    const SlowTree tree(c.tree);
    if (tree.view().n_boxes > 200) return;  // brute force would take too long
    const FMMTraversalInfo lists(tree.view(), c.options);
    const BruteLists brute(tree, c.options);
    const Rows smaller_of = smaller_rows(lists);
    expect_definitions(lists, smaller_of, brute);
    expect_coverage(lists, smaller_of, brute.images());
    expect_constant_one(lists, smaller_of, brute.images().size());
    expect_separation(lists, smaller_of, tree,
                      c.options.from_sep_smaller_crit == FromSepSmallerCrit::static_l2);
}

TEST(RandomLists, obey_definitions_coverage_and_separation) {
    for (int seed = 0; seed < n_cases(3000); ++seed) {
        check_case(1000 + seed, false);
        if (HasFatalFailure()) return;
    }
}

TEST(RandomLists, obey_them_in_periodic_boxes_for_every_image) {
    for (int seed = 0; seed < n_cases(3000) / 10; ++seed) {
        check_case(77000 + seed, true);
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace connectivity::test
