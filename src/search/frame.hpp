// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The float frame of a few leaves, and the proof that its tests lose no pair.
///
/// Positions are x = fl((p - c) s) with |x - x*| <= u |x*|, u = 2^-24 (the subtraction is done in
/// double). For a node of the frame |x*| <= M, for one at distance r from it |x*| <= M + r.
/// Differences, squares and sums add a few units more, so that near a threshold t = r² the computed
/// squared distance is off by at most
///     e = u (7 M / sqrt(t) + 16) + 8 w / sqrt(t),
/// w being what folding into a periodic box moved a node. Hence d <= t (1 - e) is certain, d > t (1
/// + e) certainly not, and between them the double predicate decides. A frame whose e is large is
/// split; see GroupWorker.

#include <cmath>

#include "group_boxes.hpp"

namespace connectivity::detail {

template <int Dim>
struct Frame {
    ReachBox<Dim> box;  ///< of the nodes that are tested in this frame
    double centre[Dim];
    double scale = 1;
    double error = 1;
    double position_error = 0;  ///< of differences of coordinates, beyond a few units

    static constexpr double largest_error = 1.0 / 16;

    Frame(const ReachBox<Dim>& nodes, const GroupBoxes<Dim>& boxes) : box(nodes) {
        double half = 0;
        for (int d = 0; d < Dim; ++d) {
            centre[d] = 0.5 * box.lo[d] + 0.5 * box.hi[d];
            half = std::max({half, box.hi[d] - centre[d], centre[d] - box.lo[d]});
        }
        // Nodes that see nobody meet thresholds of others only: the least of all bounds them.
        const double least2 = box.has_blind ? boxes.all().least : box.least,
                     least = std::sqrt(least2);
        if (!(least > 0x1p-500) || !(least < 0x1p500)) return;  // scale² must be finite
        scale = std::exp2(-std::ilogb(least));
        const bool in_range = half * scale < 1e15 && boxes.all().reach2 * scale * scale < 1e30;
        position_error = 3.5 * 0x1p-24 * half + 4 * boxes.fold_error();
        if (in_range) error = 2 * position_error / least + 16 * 0x1p-24;
    }

    /// May the float tests be used?
    bool is_good() const { return error < largest_error; }

    float widen() const { return static_cast<float>(1 + 4 * error); }
    float band() const { return static_cast<float>(1 + 3 * error); }
    double t_scale() const { return scale * scale * (1 - error); }

    MetricMap metric_map() const {
        return {static_cast<float>(1 / (1 - error)), static_cast<float>(position_error * scale)};
    }

    FrameMap<Dim> map(const double (&image)[Dim], Form form) const {
        FrameMap<Dim> m;
        for (int d = 0; d < Dim; ++d) m.centre[d] = centre[d] - image[d];
        m.scale = scale;
        m.t_scale = t_scale();
        m.widen = widen();
        m.position_error = static_cast<float>(position_error * scale);
        m.form = form;
        return m;
    }

    /// A box of this frame's nodes in its coordinates, rounded outward, with the largest half
    /// widths of their ellipsoids. If x sees y, coordinate by coordinate they are no farther apart
    /// than the half width, and floats see that but for the position error and 3 units of it.
    FrameBox<Dim> inside(const ReachBox<Dim>& b, double slack, const double (&width)[Dim]) const {
        FrameBox<Dim> f;
        for (int d = 0; d < Dim; ++d) {
            const double lo = (b.lo[d] - slack - centre[d]) * scale,
                         hi = (b.hi[d] + slack - centre[d]) * scale;
            f.lo[d] = static_cast<float>(lo - std::fabs(lo) * 0x1p-22);
            f.hi[d] = static_cast<float>(hi + std::fabs(hi) * 0x1p-22);
            f.width[d] = static_cast<float>((width[d] * (1 + error) + position_error) * scale);
        }
        // Not below zero: a node that sees nobody must still find its own place in the list.
        f.t = static_cast<float>(std::max(b.reach2, 0.0) * t_scale());
        return f;
    }
};

}  // namespace connectivity::detail
