// SPDX-License-Identifier: BSD-3-Clause
/// Laws of the lists on random trees: definitions, coverage, separation.

#include <cstdlib>
#include <numeric>

#include <gtest/gtest.h>

#include <connectivity/lists/work.hpp>

#include "lists/brute_lists.hpp"
#include "lists/random_lists_case.hpp"

namespace connectivity::test {
namespace {

int n_cases(int usual) {
    const char* const told = std::getenv("CONNECTIVITY_LIST_CASES");
    return told != nullptr ? std::atoi(told) : usual;
}

void expect_row(const char* name, BoxId box, const Row& ours, const Row& wanted) {
    ASSERT_EQ(ours.size(), wanted.size()) << name << " of box " << box;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        ASSERT_EQ(ours[i].box, wanted[i].box) << name << " of box " << box << ", entry " << i;
        ASSERT_EQ(ours[i].image, wanted[i].image) << name << " of box " << box << ", entry " << i;
    }
}

using Rows = std::map<BoxId, Row>;

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

/// How often the own sources of every (box, image) reach the own targets of every box.
class Coverage {
public:
    Coverage(const FMMTraversalInfo& lists, const Rows& smaller_of) : tree_(lists.tree()) {
        add_tree(lists);
        const auto targets = lists.target_boxes();
        for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
            auto& reached = reached_[targets(i)];
            const auto add = [&](const BoxList& list) {
                for (const Entry& e : row_of(list, i)) ++reached[e];
            };
            add(lists.neighbor_source_boxes());
            if (const auto close = lists.from_sep_close_smaller()) add(*close);
            if (const auto close = lists.from_sep_close_bigger()) add(*close);
            for (const Entry& e : smaller_of.at(targets(i))) add_below(e, reached);
            for (BoxId b = targets(i);; b = tree_.box_parent_ids(b)) {
                for (const auto& [e, n] : locals_[b]) reached[e] += n;
                if (b == 0) break;
            }
        }
    }

    int times(BoxId target, const Entry& source) const {
        const auto row = reached_.find(target);
        if (row == reached_.end()) return 0;
        const auto at = row->second.find(source);
        return at == row->second.end() ? 0 : at->second;
    }
    std::size_t n_reached(BoxId target) const {
        const auto row = reached_.find(target);
        return row == reached_.end() ? 0 : row->second.size();
    }

private:
    using Counts = std::map<Entry, int>;

    void add_below(const Entry& e, Counts& counts) const {
        if (tree_.box_flags(e.box) & 1) ++counts[e];
        for (int m = 0; m < 1 << tree_.dim; ++m)
            if (const BoxId c = tree_.child(m, e.box); c != 0) add_below({c, e.image}, counts);
    }
    /// Lists 2 and 4: local expansions.
    void add_tree(const FMMTraversalInfo& lists) {
        const auto boxes = lists.target_or_target_parent_boxes();
        for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
            Counts& counts = locals_[boxes(i)];
            for (const Entry& e : row_of(lists.from_sep_siblings(), i)) add_below(e, counts);
            for (const Entry& e : row_of(lists.from_sep_bigger(), i)) ++counts[e];
        }
    }

    TreeView tree_;
    std::map<BoxId, Counts> reached_, locals_;
};

void expect_coverage(const FMMTraversalInfo& lists, const Rows& smaller_of,
                     const std::vector<ImageCode>& images) {
    const Coverage coverage(lists, smaller_of);
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        for (Offset j = 0; j < static_cast<Offset>(lists.source_boxes().size()); ++j)
            for (const ImageCode image : images)
                ASSERT_EQ(coverage.times(t, {lists.source_boxes()(j), image}), 1)
                    << "target box " << t << ", source box " << lists.source_boxes()(j)
                    << ", image " << int{image};
        ASSERT_EQ(coverage.n_reached(t), lists.source_boxes().size() * images.size());
    }
}

/// The kernel that is 1 everywhere: every target receives the number of sources.
void expect_constant_one(const FMMTraversalInfo& lists, const Rows& smaller_of,
                         std::size_t n_images) {
    const TreeView& tree = lists.tree();
    std::vector<Offset> potential(tree.n_boxes);
    const auto &own = tree.sources.box_counts_nonchild, &below = tree.sources.box_counts_cumul;
    const auto boxes = lists.target_or_target_parent_boxes();
    for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
        Offset& local = potential[boxes(i)];
        if (boxes(i) != 0) local = potential[tree.box_parent_ids(boxes(i))];
        for (const BoxId s : lists.from_sep_siblings()[i]) local += below(s);
        for (const BoxId s : lists.from_sep_bigger()[i]) local += own(s);
    }
    const FMMTraversalInfo merged = lists.merge_close_lists();
    const Offset wanted = tree.sources.n * static_cast<Offset>(n_images);
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        Offset sum = potential[t];
        for (const BoxId s : merged.neighbor_source_boxes()[i]) sum += own(s);
        for (const Entry& e : smaller_of.at(t)) sum += below(e.box);
        ASSERT_EQ(sum, wanted) << "target box " << t;
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
    if (c.exact_grid) expect_definitions(lists, smaller_of, brute);
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
