// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What interaction lists are to be built, and when a box is far enough from another one.
///
/// Notation, here and in traversal.hpp: box b has centre c(b) and half width r(b); |.| is the
/// maximum norm; d dimensions; s is the tree's stick-out factor, s_T = s where targets have radii
/// and 0 where not, s_S likewise for sources. All targets below T are in its enlargement by
/// 1 + s_T, all sources below S in that of S by 1 + s_S (for ExtentNorm::l2 in the ball around it).
///
/// A multipole of S is used for the targets of T, a coarser box (list 3), where these keep off the
/// centre of S by three times the half width that the sources of S fill:
///
///     dist(targets of T, c(S)) >= 3 (1 + s_S) r(S)
///
/// A local expansion of T is used for the own sources of S, a coarser box (list 4), likewise where
///
///     dist(sources of S, c(T)) >= 3 (1 + s_T) r(T)
///
/// that is, a cube, or the ball around it, keeps off by its own size. In both the larger box of the
/// two is the one whose particles are a region that must be told, by criterion X:
///
///                 X's targets or sources lie in               dist(X, c) is
///   static_linf   the enlarged cube                           |c(X) - c| - (1 + s_X) r(X)
///   precise_linf  the hull [e - h, e + h] of what is below X  max_k (|e_k - c_k| - h_k)
///   static_l2     the ball around the enlarged cube           |c(X) - c|_2 - sqrt(d)(1 + s_X) r(X)
///
/// List 4 takes the plain cube of S where sources are points, whatever the criterion. Inequalities
/// are relaxed by 8 machine epsilons of the coordinate type, so that equality counts as far
/// enough. Without any radii boxes that do not touch are far enough: lists 3 and 4 are tested by
/// integers alone. List 2 never looks at extents: its expansions converge in the worst case if
/// sqrt(d) (2 + s_S + s_T) < 2 (n + 1), which in three dimensions with n = 1 is s_S + s_T < 0.309.
///
/// Source: targets with radii are treated as boxtree does; it has no lists for sources with radii,
/// and these are the mirror image.

#include <optional>
#include <string_view>

#include <connectivity/base/budget.hpp>
#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

enum class FromSepSmallerCrit { static_linf, precise_linf, static_l2 };

/// The criterion of that name. Throws Error{argument} for another one.
FromSepSmallerCrit from_sep_smaller_crit_named(std::string_view name);

struct TraversalOptions {
    /// n: boxes of a level are near if at most n boxes apart; others can use expansions. At least
    /// 1; in trees of more than 13 levels at most 16383.
    int well_sep_is_n_away = 1;
    /// None: precise_linf. static_linf does not go with ExtentNorm::l2, whose particles may leave
    /// the cube. Looked at in trees with radii only.
    std::optional<FromSepSmallerCrit> from_sep_smaller_crit;
    /// Boxes with fewer sources (their own and those below) are not worth a multipole and go to the
    /// close lists. Looked at in trees with radii only, as others have no close lists.
    Offset from_sep_smaller_min_nsources_cumul = 0;

    /// The lists to build; the close ones come with from_sep_smaller and from_sep_bigger.
    bool same_level_non_well_sep_boxes = true;
    bool neighbor_source_boxes = true;
    bool from_sep_siblings = true;
    bool from_sep_smaller = true;
    bool from_sep_bigger = true;

    /// [n_boxes] each; boxes with 0 are left out of source_boxes, source_parent_boxes. For runs
    /// on several ranks, which form multipoles of their own boxes only; empty: all boxes. The lists
    /// do not look at them.
    ConstView<std::uint8_t> source_boxes_mask, source_parent_boxes_mask;

    Budget budget;  ///< for the lists, and for what is needed to build them

    FromSepSmallerCrit crit() const {
        return from_sep_smaller_crit.value_or(FromSepSmallerCrit::precise_linf);
    }
};

}  // namespace connectivity
