// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What an order makes of 1/r by theory: Legendre's series about the boxes that lists name.

#include <cmath>
#include <utility>
#include <vector>

#include <connectivity/lists/traversal.hpp>

namespace connectivity::test {

/// 1 / |R - d| by Legendre's series to degree P.
inline double series(const double (&R)[3], const double (&d)[3], int order) {
    double R2 = 0, d2 = 0, Rd = 0;
    for (int k = 0; k < 3; ++k) R2 += R[k] * R[k], d2 += d[k] * d[k], Rd += R[k] * d[k];
    const double ratio = std::sqrt(d2 / R2), cosine = Rd / std::sqrt(R2 * d2);
    double sum = 0, power = 1, before = 0, now = 1;
    for (int l = 0; l <= order; ++l) {
        sum += power * now;
        power *= ratio;
        before = std::exchange(now, ((2 * l + 1) * cosine * now - l * before) / (l + 1));
    }
    return sum / std::sqrt(R2);
}

/// [targets, the host's order] sums of m/r of order P over all lists: direct lists without
/// expansions, list 2 in the offsets of both particles from the centres of the two boxes, list 3 in
/// the source's, list 4 in the target's. No images.
class SeriesOverLists {
public:
    SeriesOverLists(const FMMTraversalInfo& lists, const std::vector<double>& masses, int order)
        : lists_(lists), tree_(lists.tree()), masses_(masses), order_(order) {
        sums_.assign(tree_.targets.n, 0.0);
        const auto boxes = lists.target_boxes();
        std::vector<Offset> row(tree_.n_boxes, -1);
        const auto parents = lists.target_or_target_parent_boxes();
        for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) row[parents(i)] = i;
        for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
            add_direct(boxes(i), lists.neighbor_source_boxes(), i);
            if (const auto close = lists.from_sep_close_smaller()) add_direct(boxes(i), *close, i);
            if (const auto close = lists.from_sep_close_bigger()) add_direct(boxes(i), *close, i);
            for (BoxId a = boxes(i);; a = tree_.box_parent_ids(a)) {
                for (const BoxId s : lists.from_sep_siblings()[row[a]])
                    add(boxes(i), a, s, tree_.sources.box_counts_cumul(s));
                for (const BoxId s : lists.from_sep_bigger()[row[a]])
                    add(boxes(i), a, s, tree_.sources.box_counts_nonchild(s), false, true);
                if (a == 0) break;
            }
        }
        for (int level = 0; level < lists.nlevels(); ++level) {
            const LevelBoxList list = lists.from_sep_smaller(level);
            for (Offset j = 0; j < list.num_nonempty_lists(); ++j)
                for (const BoxId s : list[j]) {
                    const BoxId t = list.target_boxes_sep_smaller(j);
                    add(t, t, s, tree_.sources.box_counts_cumul(s), true, false);
                }
        }
    }
    std::vector<double> sums() const {
        std::vector<double> user(sums_.size());
        for (std::size_t i = 0; i < user.size(); ++i) user[i] = sums_[tree_.sorted_target_ids(i)];
        return user;
    }

private:
    void add_direct(BoxId t, const BoxList& list, Offset row) {
        for (const BoxId s : list[row])
            add(t, t, s, tree_.sources.box_counts_nonchild(s), true, true);
    }
    /// The first n sources of box s on the own targets of t; expanded about the centres of a and s
    /// but for what is exact.
    void add(BoxId t, BoxId a, BoxId s, int n, bool target_exact = false,
             bool source_exact = false) {
        const TreeParticles &targets = tree_.targets, &sources = tree_.sources;
        for (int i = targets.box_starts(t);
             i < targets.box_starts(t) + targets.box_counts_nonchild(t); ++i)
            for (int j = sources.box_starts(s); j < sources.box_starts(s) + n; ++j) {
                double R[3], d[3];
                for (int k = 0; k < 3; ++k) {
                    const double x = targets.positions(k * targets.n + i),
                                 y = sources.positions(k * sources.n + j),
                                 to = target_exact ? x : tree_.center(k, a),
                                 from = source_exact ? y : tree_.center(k, s);
                    R[k] = to - from;
                    d[k] = (y - from) - (x - to);
                }
                const double m = masses_[tree_.user_source_ids(j)];
                if (target_exact && source_exact) {
                    const double r2 = R[0] * R[0] + R[1] * R[1] + R[2] * R[2];
                    if (r2 > 0) sums_[i] += m / std::sqrt(r2);
                } else {
                    sums_[i] += m * series(R, d, order_);
                }
            }
    }

    const FMMTraversalInfo& lists_;
    const TreeView& tree_;
    const std::vector<double>& masses_;
    int order_;
    std::vector<double> sums_;
};

inline std::vector<double> series_over_lists(const FMMTraversalInfo& lists,
                                             const std::vector<double>& masses, int order) {
    return SeriesOverLists(lists, masses, order).sums();
}

}  // namespace connectivity::test
