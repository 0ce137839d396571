// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Interaction lists straight from their definitions, by testing every box against every other one
/// and its images. Distances are rounded as separation.hpp says, so that all lists of all trees can
/// be compared entry by entry.

#include <limits>
#include <map>
#include <tuple>

#include <connectivity/lists/traversal.hpp>

#include "lists/slow_tree.hpp"

namespace connectivity::test {

struct Entry {
    BoxId box = 0;
    ImageCode image = no_image;
    friend auto operator<=>(const Entry&, const Entry&) = default;
};
using Row = std::vector<Entry>;

class BruteLists {
public:
    BruteLists(const SlowTree& tree, const TraversalOptions& options)
        : tree_(tree), view_(tree.view()), options_(options) {
        for (ImageCode image = 0; image < 27; ++image) {
            bool exists = true;
            for (int k = 0; k < 3; ++k)
                exists &= image_shift(image)[k] == 0 || (k < view_.dim && view_.periodic[k]);
            if (exists) images_.push_back(image);
        }
    }

    const std::vector<ImageCode>& images() const { return images_; }
    bool has(BoxId b, unsigned flags) const { return view_.box_flags(b) & flags; }

    Row same_level(BoxId t) const {
        return select(t, false, [&](Entry s) { return near(t, s); });
    }
    Row list1(BoxId t) const {
        return select(t, false, [&](Entry s) { return has(s.box, 1) && touch(t, s); });
    }
    Row list2(BoxId t) const {
        return select(t, false, [&](Entry s) {
            if (t == 0 || level(t) != level(s.box) || near(t, s) || is_self(t, s)) return false;
            const BoxId parent = view_.box_parent_ids(t);
            const Entry above{view_.box_parent_ids(s.box), s.image};
            return near(parent, above) || is_self(parent, above);
        });
    }
    Row list3(BoxId t) const {
        return select(t, false, [&](Entry s) {
            return visited(t, s) && !touch(t, s) && has(s.box, 1 | 4) && meets(t, s);
        });
    }
    Row close3(BoxId t) const {
        return select(t, false, [&](Entry s) {
            return visited(t, s) && !touch(t, s) && has(s.box, 1) && !meets(t, s);
        });
    }
    Row list4(BoxId t) const {
        return select(t, true, [&](Entry s) {
            return bigger(t, s) && separated(t, s) && !taken_above(t, s);
        });
    }
    Row close4(BoxId t) const {
        return select(t, true, [&](Entry s) {
            return bigger(t, s) && !separated(t, s) && !taken_above(t, s);
        });
    }

    /// c(T) - c(S).
    Point between(BoxId t, Entry s) const {
        Point v{};
        for (int k = 0; k < view_.dim; ++k)
            v[k] = view_.center(k, t) - view_.center(k, s.box) -
                   image_shift(s.image)[k] * view_.root_extent;
        return v;
    }

private:
    template <class Is>
    Row select(BoxId t, bool by_level, const Is& is) const {
        std::map<std::tuple<int, int, int>, Entry> found;
        for (BoxId b = 0; b < view_.n_boxes; ++b)
            for (const ImageCode image : images_)
                if (const Entry s{b, image}; is(s))
                    found[{by_level ? -level(b) : 0, image, tree_.box(b).rank}] = s;
        (void)t;
        Row row;
        for (const auto& [key, entry] : found) row.push_back(entry);
        return row;
    }

    int level(BoxId b) const { return view_.box_levels(b); }
    static bool is_self(BoxId t, Entry s) { return s.box == t && s.image == no_image; }
    bool touch(BoxId t, Entry s) const { return tree_.touch(t, s.box, image_shift(s.image)); }
    bool near(BoxId t, Entry s) const {
        return level(t) == level(s.box) && !is_self(t, s) &&
               tree_.offset(t, s.box, image_shift(s.image)) <= options_.well_sep_is_n_away;
    }
    BoxId ancestor(BoxId b, int at) const {
        while (level(b) > at) b = view_.box_parent_ids(b);
        return b;
    }

    /// Does the walk of list 3 come to S?
    bool visited(BoxId t, Entry s) const {
        if (level(s.box) <= level(t)) return false;
        const Entry above{view_.box_parent_ids(s.box), s.image};
        if (!has(above.box, 4)) return false;
        if (level(above.box) == level(t)) return near(t, above) || is_self(t, above);
        return visited(t, above) && (touch(t, above) || !meets(t, above));
    }
    /// Is S one that list 4 or 4 close is about?
    bool bigger(BoxId t, Entry s) const {
        return has(s.box, 1) && level(s.box) <= level(t) && near(ancestor(t, level(s.box)), s) &&
               !touch(t, s);
    }
    bool taken_above(BoxId t, Entry s) const {
        while (level(t) > level(s.box)) {
            t = view_.box_parent_ids(t);
            if (bigger(t, s) && separated(t, s)) return true;
        }
        return false;
    }

    bool extents() const { return view_.extent_norm.has_value(); }
    double enlarged(bool radii, BoxId b) const {
        return tree_.half_width(b) * (radii ? 1 + view_.stick_out_factor : 1);
    }
    /// c(b), moved by so many root boxes.
    Point moved(BoxId b, ImageCode image, int sign) const {
        Point c{};
        for (int k = 0; k < view_.dim; ++k)
            c[k] = view_.center(k, b) + sign * image_shift(image)[k] * view_.root_extent;
        return c;
    }
    /// dist(X, c) of traversal_options.hpp, a hull as its middle and half width.
    double distance(const TreeParticles& particles, bool radii, BoxId x, const Point& c) const {
        using enum FromSepSmallerCrit;
        const FromSepSmallerCrit crit = options_.from_sep_smaller_crit.value_or(precise_linf);
        double square = 0, cube = 0, hull = -std::numeric_limits<double>::infinity();
        for (int k = 0; k < view_.dim; ++k) {
            const Offset at = k * view_.aligned_n_boxes + x;
            const double v = std::abs(view_.center(k, x) - c[k]),
                         lo = particles.bounding_box_min(at), hi = particles.bounding_box_max(at),
                         e = (lo + hi) / 2, h = (hi - lo) / 2;
            hull = std::max(hull, std::abs(e - c[k]) - h);
            square += v * v;
            cube = std::max(cube, v);
        }
        if (crit == precise_linf) return hull;
        if (radii && x == 0) return -1;  // a root's particles stick out by any length
        return crit == static_linf ? cube - enlarged(radii, x)
                                   : std::sqrt(square) - std::sqrt(view_.dim) * enlarged(radii, x);
    }
    bool meets(BoxId t, Entry s) const {
        if (!extents()) return true;
        const auto& in = tree_.input();
        if (view_.sources.box_counts_cumul(s.box) < options_.from_sep_smaller_min_nsources_cumul)
            return false;
        const double r = enlarged(in.source_radii, s.box);
        return distance(view_.targets, in.target_radii, t, moved(s.box, s.image, 1)) - r >=
               (2 - slack) * r;
    }
    bool separated(BoxId t, Entry s) const {
        if (!extents()) return true;
        const auto& in = tree_.input();
        const Point c = moved(t, s.image, -1);
        const double reach = 3 * enlarged(in.target_radii, t), r = enlarged(in.source_radii, s.box);
        if (in.source_radii)
            return distance(view_.sources, true, s.box, c) >= reach - slack * (reach + r);
        double cube = 0;
        for (int k = 0; k < view_.dim; ++k)
            cube = std::max(cube, std::abs(c[k] - view_.center(k, s.box)));
        return cube >= (reach + r) * (1 - slack);
    }

    static constexpr double slack = 8 * std::numeric_limits<double>::epsilon();

    const SlowTree& tree_;
    const TreeView& view_;
    TraversalOptions options_;
    std::vector<ImageCode> images_;
};

/// A row of ours.
inline Row row_of(const BoxList& list, Offset i) {
    Row row;
    for (Offset k = list.starts(i); k < list.starts(i + 1); ++k)
        row.push_back({list.lists(k), list.image(k)});
    return row;
}

/// List 3 of every target box, levels laid end to end.
inline std::map<BoxId, Row> smaller_rows(const FMMTraversalInfo& lists) {
    std::map<BoxId, Row> rows;
    for (int level = 0; level < lists.nlevels(); ++level) {
        const LevelBoxList list = lists.from_sep_smaller(level);
        for (Offset j = 0; j < list.num_nonempty_lists(); ++j)
            for (const Entry& e : row_of(list, j))
                rows[list.target_boxes_sep_smaller(j)].push_back(e);
    }
    for (const BoxId t : std::span(lists.target_boxes().data(), lists.target_boxes().size()))
        rows[t];
    return rows;
}

}  // namespace connectivity::test
