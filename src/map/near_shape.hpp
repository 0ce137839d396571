// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Nodes near a box or a plane, for NeighbourQuery.

#include <cmath>

#include <Eigen/Dense>

#include "node_tree.hpp"

namespace connectivity::detail {

[[noreturn]] inline void refuse(const std::string& text) { throw Error(Status::argument, text); }

inline std::vector<Slot> sorted(std::vector<Slot> slots) {
    std::sort(slots.begin(), slots.end());
    return slots;
}

/// How far supports reach along an axis or a direction of length 1.
template <int Dim>
double reach_along(const SearchNodes<Dim>& nodes, Slot slot, const double (&direction)[Dim]) {
    const double* const packed =
        nodes.H.size() > 0 ? nodes.H.data() + slot * Offset{n_symmetric(Dim)} : nullptr;
    if (packed == nullptr || packed[0] == 0)
        return nodes.reach2(slot) < 0 ? -1.0 : std::sqrt(nodes.reach2(slot));
    Eigen::Matrix<double, Dim, Dim> H;
    for (int i = 0, k = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j, ++k) H(i, j) = H(j, i) = packed[k];
    const Eigen::Map<const Eigen::Matrix<double, Dim, 1>> n(direction);
    const Eigen::Matrix<double, Dim, 1> half_axis = H.ldlt().solve(n);
    return std::sqrt(nodes.extent2) * half_axis.stableNorm();
}

/// A box by centre and half widths: differences can be wrapped.
template <int Dim>
struct QueryBox {
    double lo[Dim], hi[Dim];
    const Periods<Dim>& periods;

    /// How far x is outside along an axis; <= 0 inside.
    double gap(double x, int d) const {
        if (!(periods.length[d] > 0)) return std::max(x - hi[d], lo[d] - x);
        const double centre = lo[d] + 0.5 * (hi[d] - lo[d]);
        return std::fabs(periods.wrap(x - centre, d)) - 0.5 * (hi[d] - lo[d]);
    }
};

template <int Dim>
QueryBox<Dim> query_box(const SearchNodes<Dim>& nodes, std::span<const double> lo,
                        std::span<const double> hi) {
    if (lo.size() != Dim || hi.size() != Dim)
        refuse("near_box: lo and hi have " + std::to_string(lo.size()) + " and " +
               std::to_string(hi.size()) + " values, must have " + std::to_string(Dim));
    QueryBox<Dim> box{{}, {}, nodes.periods};
    for (int d = 0; d < Dim; ++d) {
        box.lo[d] = lo[d], box.hi[d] = hi[d];
        if (!std::isfinite(lo[d]) || !std::isfinite(hi[d]) || !(lo[d] <= hi[d]))
            refuse("near_box: axis " + std::to_string(d) + " runs from " + number(lo[d]) + " to " +
                   number(hi[d]) + ", must be finite and ascending");
        if (const double length = nodes.periods.length[d]; length > 0 && hi[d] - lo[d] > length / 2)
            refuse("near_box: width " + number(hi[d] - lo[d]) + " on periodic axis " +
                   std::to_string(d) + ", must be at most half its length, " + number(length / 2));
    }
    return box;
}

template <int Dim>
std::vector<Slot> nodes_near_box(const NodeTree<Dim>& tree, const QueryBox<Dim>& box,
                                 SearchMode mode) {
    const SearchNodes<Dim>& nodes = tree.nodes();
    // For the walk: the ball around the box, with the box's own reach where supports do not count.
    typename NodeTree<Dim>::Box around;
    for (int d = 0; d < Dim; ++d) {
        const double shift = detail::device::fold(box.lo[d], nodes.periods.length[d]) - box.lo[d];
        around.lo[d] = box.lo[d] + shift, around.hi[d] = box.hi[d] + shift;
    }
    around.reach2 = 0;
    double far[Dim];
    for (int d = 0; d < Dim; ++d) far[d] = std::max(std::fabs(box.lo[d]), std::fabs(box.hi[d]));
    const auto near = tree.nearness(SearchMode::gather_scatter, tree.slack_at(far));
    // The nearest corner of a bounding box is up to sqrt(Dim) times as far as its ball.
    const auto may_hold = [&](auto other) {
        other.reach2 = mode == SearchMode::gather ? 0 : Dim * std::max(other.reach2, 0.0);
        return near(around, other);
    };
    const auto inside = [&](Slot slot) {
        for (int d = 0; d < Dim; ++d)
            if (box.gap(nodes.positions(Offset{slot} * Dim + d), d) > 0) return false;
        return true;
    };
    const auto touches = [&](Slot slot) {
        if (nodes.reach2(slot) < 0) return false;
        for (int d = 0; d < Dim; ++d) {
            double axis[Dim] = {};
            axis[d] = 1;
            if (box.gap(nodes.positions(Offset{slot} * Dim + d), d) >
                reach_along(nodes, slot, axis))
                return false;
        }
        return true;
    };
    std::vector<Slot> out;
    tree.walk(may_hold, [&](Slot slot) {
        if ((mode != SearchMode::scatter && inside(slot)) ||
            (mode != SearchMode::gather && touches(slot)))
            out.push_back(slot);
    });
    return sorted(std::move(out));
}

/// A plane through a point.
template <int Dim>
struct QueryPlane {
    double point[Dim], normal[Dim];

    double distance(const double* x) const {
        double sum = 0;
        for (int d = 0; d < Dim; ++d) sum += normal[d] * (x[d] - point[d]);
        return sum;
    }
};

template <int Dim>
QueryPlane<Dim> query_plane(std::span<const double> point, std::span<const double> normal,
                            double distance) {
    if (point.size() != Dim || normal.size() != Dim)
        refuse("near_plane: point and normal have " + std::to_string(point.size()) + " and " +
               std::to_string(normal.size()) + " values, must have " + std::to_string(Dim));
    QueryPlane<Dim> plane;
    const Eigen::Map<const Eigen::Matrix<double, Dim, 1>> p(point.data()), n(normal.data());
    const double length = n.stableNorm();
    if (!p.allFinite() || !(length > 0) || !std::isfinite(length))
        refuse("near_plane: point and normal must be finite, the normal not zero");
    if (!(distance >= 0) || !std::isfinite(distance))
        refuse("near_plane: distance = " + number(distance) + ", must be finite and >= 0");
    for (int d = 0; d < Dim; ++d) plane.point[d] = point[d], plane.normal[d] = normal[d] / length;
    return plane;
}

template <int Dim>
std::vector<Slot> nodes_near_plane(const NodeTree<Dim>& tree, const QueryPlane<Dim>& plane,
                                   double distance, SearchMode mode) {
    const SearchNodes<Dim>& nodes = tree.nodes();
    const auto is_near = [&](Slot slot) {
        const double d = std::fabs(plane.distance(nodes.positions.data() + Offset{slot} * Dim));
        return (mode != SearchMode::scatter && d <= distance) ||
               (mode != SearchMode::gather && nodes.reach2(slot) >= 0 &&
                d <= reach_along(nodes, slot, plane.normal));
    };
    // Folded boxes are not where their nodes are: with periodic axes all nodes are asked.
    const auto may_hold = [&](const auto& box) {
        if (nodes.periods.any) return true;
        double centre[Dim], width = 0, size = 0;
        for (int d = 0; d < Dim; ++d) {
            centre[d] = 0.5 * box.lo[d] + 0.5 * box.hi[d];
            width += std::fabs(plane.normal[d]) * (0.5 * box.hi[d] - 0.5 * box.lo[d]);
            size += std::fabs(centre[d]) + std::fabs(plane.point[d]);
        }
        const double reach = mode == SearchMode::gather ? 0 : std::sqrt(std::max(box.reach2, 0.0));
        const double slack = 16 * std::numeric_limits<double>::epsilon() * (size + width);
        return !(std::fabs(plane.distance(centre)) >
                 (width + std::max(mode == SearchMode::scatter ? 0 : distance, reach)) *
                         (1 + 1e-14) +
                     slack);
    };
    std::vector<Slot> out;
    tree.walk(may_hold, [&](Slot slot) {
        if (is_near(slot)) out.push_back(slot);
    });
    return sorted(std::move(out));
}

}  // namespace connectivity::detail
