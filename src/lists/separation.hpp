// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Whether a box is far enough for an expansion: the inequalities of traversal_options.hpp.
///
/// The last bit decides about boxes exactly one diameter apart, so this is how they are rounded.
/// Everything is double; r is the half width enlarged by 1 + s of the box's kind, u is 8 machine
/// epsilons of the coordinate type, a hull's e is (lo + hi) / 2 and its h (hi - lo) / 2.
///
///     list 3                      dist(T, c(S)) - r(S) >= (2 - u) r(S)
///     list 4, sources with radii  dist(S, c(T)) >= 3 r(T) - u (3 r(T) + r(S))
///     list 4, points              |c(T) - c(S)| >= (3 r(T) + r(S)) (1 - u)
///
/// For an image of S c(S) moves in list 3, and c(T) the other way in list 4.

#include <array>

#include <connectivity/lists/box_list.hpp>
#include <connectivity/lists/traversal_options.hpp>

namespace connectivity::detail {

class Separation {
public:
    /// Throws Error: argument (criterion), null (arrays that the criterion needs).
    Separation(const TreeView& tree, const TraversalOptions& options);

    bool tests_extents() const { return tests_; }
    /// Is the multipole of S, smaller than T, good for the targets of T, and worth it?
    bool smaller_is_far(BoxId target, BoxId source, ImageCode image) const {
        return !tests_ || test_smaller(target, source, image);
    }
    /// Is the local expansion of T good for the own sources of S, as large or larger?
    bool bigger_is_far(BoxId target, BoxId source, ImageCode image) const {
        return !tests_ || test_bigger(target, source, image);
    }

private:
    using Vector = std::array<double, 3>;
    struct Side {
        const double *hull_min = nullptr, *hull_max = nullptr;
        double enlargement = 1;  // 1 + s, 1 for points
        bool has_extent = false;
    };

    bool test_smaller(BoxId target, BoxId source, ImageCode image) const;
    bool test_bigger(BoxId target, BoxId source, ImageCode image) const;
    Vector place(BoxId box, ImageCode image, double sign) const;
    double distance(const Side& side, BoxId box, const Vector& point) const;
    double half_width(BoxId b) const { return half_widths_[levels_[b]]; }

    bool tests_ = false, sources_have_extent_ = false;
    int dim_ = 1;
    Offset aligned_ = 0, min_sources_ = 0;
    double root_extent_ = 0, slack_ = 0, ball_ = 1;  // ball_: sqrt(dim)
    FromSepSmallerCrit crit_{};
    const double* centers_ = nullptr;
    const std::uint8_t* levels_ = nullptr;
    const std::int32_t* n_sources_below_ = nullptr;
    Side targets_, sources_;
    std::array<double, 256> half_widths_{};
};

}  // namespace connectivity::detail
