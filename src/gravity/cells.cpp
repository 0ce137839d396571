// SPDX-License-Identifier: BSD-3-Clause
#include "cells.hpp"

#include <algorithm>
#include <cmath>

#include "upward.hpp"

namespace connectivity::detail {

namespace {

/// Scale of cells whose particles are all at one place.
constexpr double no_extent = 0x1p-300;
constexpr double above = 1 + 1e-14;  // more than the rounding of a distance

template <class T>
void grow(View<T>& view, const char* label, Offset n) {
    ensure_capacity(view, label, n);
}

void reserve(Cells& cells, Offset n, bool softened) {
    grow(cells.level_starts, "gravity/level_starts", 258);
    for (auto* ids : {&cells.parent, &cells.first_child, &cells.n_children, &cells.leaves})
        grow(*ids, "gravity/cells", n);
    grow(cells.first, "gravity/first", n);
    grow(cells.count, "gravity/count", n);
    grow(cells.centre, "gravity/centres", 3 * n);
    grow(cells.radius, "gravity/radii", n);
    grow(cells.scale, "gravity/scales", n);
    grow(cells.mass, "gravity/cell_masses", n);
    grow(cells.max_softening, "gravity/cell_softening", softened ? n : 0);
}

/// The box below which there is a choice: `box`, or the end of its chain of only children.
BoxId end_of_chain(const TreeView& tree, BoxId box) {
    for (;;) {
        BoxId only = 0;
        for (int k = 0; k < 8; ++k) {
            const BoxId child = tree.child(k, box);
            if (child == 0) continue;
            if (only != 0) return box;
            only = child;
        }
        if (only == 0) return box;
        box = only;
    }
}

/// Numbers the cells; boxes [n_boxes] is scratch: the box of each cell.
void link(const TreeView& tree, BoxId* boxes, Cells& cells) {
    boxes[0] = end_of_chain(tree, 0);
    cells.parent(0) = 0;
    cells.n = 1;
    cells.n_levels = 0;
    cells.n_leaves = 0;
    for (CellId c = 0, level_end = 0; c < cells.n; ++c) {
        if (c == level_end) {
            cells.level_starts(cells.n_levels++) = c;
            level_end = cells.n;
        }
        const BoxId box = boxes[c];
        cells.first(c) = tree.sources.box_starts(box);
        cells.count(c) = tree.sources.box_counts_cumul(box);
        cells.first_child(c) = cells.n;
        for (int k = 0; k < 8; ++k)
            if (const BoxId child = tree.child(k, box); child != 0) {
                boxes[cells.n] = end_of_chain(tree, child);
                cells.parent(cells.n++) = c;
            }
        cells.n_children(c) = cells.n - cells.first_child(c);
        if (cells.is_leaf(c)) cells.leaves(cells.n_leaves++) = c;
    }
    cells.level_starts(cells.n_levels) = cells.n;
}

/// Weighted mean of places; where the weights are 0, the plain one.
struct Mean {
    double weight = 0, sum[3] = {}, count = 0, plain[3] = {};

    void add(double w, double n, const double x[3]) {
        weight += w;
        count += n;
        for (int d = 0; d < 3; ++d) {
            sum[d] += w * x[d];
            plain[d] += n * x[d];
        }
    }
    double at(int d) const { return weight > 0 ? sum[d] / weight : plain[d] / count; }
};

double distance(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return std::sqrt(x * x + y * y + z * z);
}

class Shape {
public:
    Shape(const TreeBodies& bodies, Cells& cells) : b_(bodies), k_(cells) {}

    /// Children first.
    void measure(CellId c) const {
        double x[3], r = 0;
        find_centre(c, x);
        const std::int32_t first = k_.first(c), last = first + k_.count(c);
        if (k_.is_leaf(c) || k_.count(c) <= few_particles) {
            for (std::int32_t i = first; i < last; ++i) {
                const double a = b_.x[0][i] - x[0], b = b_.x[1][i] - x[1], d = b_.x[2][i] - x[2];
                r = std::max(r, a * a + b * b + d * d);
            }
            r = std::sqrt(r);
        } else {
            for_children(c, [&](CellId child) {
                const double y[3] = {k_.x(0, child), k_.x(1, child), k_.x(2, child)};
                r = std::max(r, distance(x, y) + k_.radius(child));
            });
        }
        k_.radius(c) = r * above;
        int exponent = 0;
        std::frexp(k_.radius(c), &exponent);
        k_.scale(c) = r > no_extent ? std::ldexp(1.0, exponent) : no_extent;
        if (b_.softening != nullptr) find_softening(c);
    }

private:
    template <class Body>
    void for_children(CellId c, const Body& body) const {
        for (CellId child = k_.first_child(c); child < k_.first_child(c) + k_.n_children(c);
             ++child)
            body(child);
    }
    void find_centre(CellId c, double x[3]) const {
        Mean mean;
        if (k_.is_leaf(c))
            for (std::int32_t i = k_.first(c); i < k_.first(c) + k_.count(c); ++i) {
                const double y[3] = {b_.x[0][i], b_.x[1][i], b_.x[2][i]};
                mean.add(std::abs(b_.mass[i]), 1, y);
            }
        else
            for_children(c, [&](CellId child) {
                const double y[3] = {k_.x(0, child), k_.x(1, child), k_.x(2, child)};
                mean.add(k_.mass(child), k_.count(child), y);
            });
        k_.mass(c) = mean.weight;
        for (int d = 0; d < 3; ++d) k_.centre(Offset{d} * k_.n + c) = x[d] = mean.at(d);
    }
    void find_softening(CellId c) const {
        double e = 0;
        if (k_.is_leaf(c))
            for (std::int32_t i = k_.first(c); i < k_.first(c) + k_.count(c); ++i)
                e = std::max(e, b_.softening[i]);
        else
            for_children(c, [&](CellId child) { e = std::max(e, k_.max_softening(child)); });
        k_.max_softening(c) = e;
    }

    const TreeBodies& b_;
    Cells& k_;
};

}  // namespace

Offset Cells::bytes() const {
    const auto of = [](const auto&... views) {
        return (static_cast<Offset>(views.size() * sizeof(*views.data())) + ...);
    };
    return of(level_starts, parent, first_child, n_children, first, count, centre, radius, scale,
              mass, max_softening, leaves, moments, rho);
}

CellArrays Cells::arrays() const {
    const double* const at = centre.data();
    return {at, at + n, at + 2 * Offset{n}, scale.data(), moments.data(), stride};
}

void make_cells(const TreeView& tree, const TreeBodies& bodies, Cells& cells) {
    cells.softened = bodies.softening != nullptr;
    reserve(cells, tree.n_boxes, cells.softened);
    link(tree, cells.leaves.data(), cells);
    const Shape shape(bodies, cells);
    for_each_upward("gravity/cells", cells, [&](CellId c) { shape.measure(c); });
}

}  // namespace connectivity::detail
