// SPDX-License-Identifier: BSD-3-Clause
#include "separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace connectivity {

FromSepSmallerCrit from_sep_smaller_crit_named(std::string_view name) {
    if (name == "static_linf") return FromSepSmallerCrit::static_linf;
    if (name == "precise_linf") return FromSepSmallerCrit::precise_linf;
    if (name == "static_l2") return FromSepSmallerCrit::static_l2;
    throw Error(Status::argument, "from_sep_smaller_crit is '" + std::string(name) +
                                      "', must be static_linf, precise_linf or static_l2");
}

namespace detail {
namespace {

void check_crit(const TreeView& tree, FromSepSmallerCrit crit) {
    if (crit != FromSepSmallerCrit::static_linf && crit != FromSepSmallerCrit::precise_linf &&
        crit != FromSepSmallerCrit::static_l2)
        throw Error(Status::argument, "from_sep_smaller_crit is " +
                                          std::to_string(static_cast<int>(crit)) +
                                          ", must be static_linf, precise_linf or static_l2");
    if (crit == FromSepSmallerCrit::static_linf && tree.extent_norm == ExtentNorm::l2)
        throw Error(Status::argument,
                    "from_sep_smaller_crit static_linf is not rigorous for a tree with extent "
                    "norm l2, whose particles may leave the enlarged cube: use static_l2 or "
                    "precise_linf");
}

void require(const char* name, std::size_t size, Offset n) {
    if (static_cast<Offset>(size) < n)
        throw Error(size == 0 ? Status::null : Status::argument,
                    std::string("interaction lists: tree.") + name + " has " +
                        std::to_string(size) + " elements, particles with radii need " +
                        std::to_string(n));
}

}  // namespace

Separation::Separation(const TreeView& tree, const TraversalOptions& options)
    : tests_(tree.have_extent()),
      sources_have_extent_(tree.sources.have_extent()),
      dim_(tree.dim),
      aligned_(tree.aligned_n_boxes),
      min_sources_(options.from_sep_smaller_min_nsources_cumul),
      root_extent_(tree.root_extent),
      ball_(std::sqrt(static_cast<double>(tree.dim))),
      crit_(options.crit()),
      centers_(tree.box_centers.data()),
      levels_(tree.box_levels.data()),
      n_sources_below_(tree.sources.box_counts_cumul.data()) {
    check_crit(tree, crit_);
    if (!tests_) return;
    const Offset n = dim_ * aligned_;
    require("box_centers", tree.box_centers.size(), n);
    if (min_sources_ > 0)
        require("sources.box_counts_cumul", tree.sources.box_counts_cumul.size(), tree.n_boxes);
    const auto side = [&](const TreeParticles& particles) {
        if (crit_ == FromSepSmallerCrit::precise_linf) {
            require("bounding_box_min", particles.bounding_box_min.size(), n);
            require("bounding_box_max", particles.bounding_box_max.size(), n);
        }
        return Side{particles.bounding_box_min.data(), particles.bounding_box_max.data(),
                    particles.have_extent() ? 1 + tree.stick_out_factor : 1.0,
                    particles.have_extent()};
    };
    targets_ = side(tree.targets);
    sources_ = sources_have_extent_ ? side(tree.sources) : Side{};
    slack_ = 8 * (tree.coordinates == CoordinateType::float32
                      ? static_cast<double>(std::numeric_limits<float>::epsilon())
                      : std::numeric_limits<double>::epsilon());
    for (int l = 0; l < 256; ++l)
        half_widths_[static_cast<std::size_t>(l)] = std::ldexp(root_extent_, -(l + 1));
}

/// c(S, image), or of T as that image of S sees it.
Separation::Vector Separation::place(BoxId box, ImageCode image, double sign) const {
    Vector c{};
    for (int k = 0; k < dim_; ++k)
        c[static_cast<std::size_t>(k)] = centers_[Offset{k} * aligned_ + box];
    if (image != no_image) {
        const auto shift = image_shift(image);
        for (std::size_t k = 0; k < 3; ++k) c[k] += sign * shift[k] * root_extent_;
    }
    return c;
}

/// Distance from the particles below a box to a point. The hull's centre is taken by itself, as
/// boxtree does: hulls end on centres of boxes, so that rounding decides.
double Separation::distance(const Side& side, BoxId box, const Vector& point) const {
    // Only of a periodic root box particles stick out by more than the factor, by any length.
    if (crit_ != FromSepSmallerCrit::precise_linf && side.has_extent && levels_[box] == 0)
        return -std::numeric_limits<double>::infinity();
    double far =
        crit_ == FromSepSmallerCrit::precise_linf ? -std::numeric_limits<double>::infinity() : 0;
    for (int k = 0; k < dim_; ++k) {
        const Offset at = k * aligned_ + box;
        const double x = point[static_cast<std::size_t>(k)], away = centers_[at] - x;
        if (crit_ == FromSepSmallerCrit::static_l2) {
            far += away * away;
        } else if (crit_ == FromSepSmallerCrit::static_linf) {
            far = std::max(far, std::abs(away));
        } else {
            const double lo = side.hull_min[at], hi = side.hull_max[at];
            far = std::max(far, std::abs(0.5 * (lo + hi) - x) - 0.5 * (hi - lo));
        }
    }
    const double r = half_width(box) * side.enlargement;
    if (crit_ == FromSepSmallerCrit::static_l2) return std::sqrt(far) - ball_ * r;
    return crit_ == FromSepSmallerCrit::static_linf ? far - r : far;
}

bool Separation::test_smaller(BoxId target, BoxId source, ImageCode image) const {
    if (min_sources_ > 0 && n_sources_below_[source] < min_sources_) return false;
    const double r = half_width(source) * sources_.enlargement;
    return distance(targets_, target, place(source, image, 1)) - r >= (2 - slack_) * r;
}

bool Separation::test_bigger(BoxId target, BoxId source, ImageCode image) const {
    const Vector t = place(target, image, -1);
    const double reach = 3 * targets_.enlargement * half_width(target),
                 r = half_width(source) * sources_.enlargement;
    if (sources_have_extent_) return distance(sources_, source, t) >= reach - slack_ * (reach + r);
    double far = 0;
    for (int k = 0; k < dim_; ++k)
        far = std::max(far, std::abs(t[static_cast<std::size_t>(k)] -
                                     centers_[Offset{k} * aligned_ + source]));
    return far >= (reach + r) * (1 - slack_);
}

}  // namespace detail
}  // namespace connectivity
