// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <connectivity/base/error.hpp>

#include "expansion_kernels.hpp"

namespace connectivity::detail {
namespace {

using Lengths = std::array<double, 3>;
using Image = LatticePlan::Image;

/// Farther ones are never the nearest that is not near.
constexpr int max_shift = 5;
constexpr std::size_t min_near_images = 27;
constexpr int min_order = 2;
constexpr int max_cells_a_side = 60, max_cells = 3000;

/// An image, and how near it comes to any difference of two cells' centres.
struct Shell {
    double distance;
    Image image;
};

LatticeGrid make_grid(const Lengths& lengths, const std::array<int, 3>& cells) {
    LatticeGrid grid{cells, {}};
    for (int d = 0; d < 3; ++d) grid.side[d] = lengths[d] / cells[d];
    return grid;
}

/// Twice the radius of a cell: how far sources and targets are from their centres together.
double spread(const LatticeGrid& grid) {
    return std::hypot(grid.side[0], grid.side[1], grid.side[2]);
}

std::vector<Shell> make_shells(const Lengths& lengths, const LatticeGrid& grid) {
    std::vector<Shell> shells;
    for (int i = -max_shift; i <= max_shift; ++i)
        for (int j = -max_shift; j <= max_shift; ++j)
            for (int k = -max_shift; k <= max_shift; ++k) {
                const Image image{i, j, k};
                double gap[3];
                for (int d = 0; d < 3; ++d)
                    gap[d] = std::max(
                        0.0, std::abs(image[d]) * lengths[d] - (lengths[d] - grid.side[d]));
                shells.push_back({std::hypot(gap[0], gap[1], gap[2]), image});
            }
    std::stable_sort(shells.begin(), shells.end(),
                     [](const Shell& a, const Shell& b) { return a.distance < b.distance; });
    return shells;
}

/// Number of the first shells from `at_least` on that leaves none of equal distance apart.
std::size_t whole_shells(const std::vector<Shell>& shells, std::size_t at_least) {
    std::size_t n = at_least;
    while (n < shells.size() && shells[n].distance < shells[n - 1].distance * (1 + 1e-9)) ++n;
    return n;
}

/// How far the nearest image that is not near is from two cells this many cells apart.
double clearance(const Lengths& lengths, const LatticeGrid& grid, const std::array<int, 3>& apart,
                 const std::vector<Shell>& shells, std::size_t n_near) {
    double nearest = HUGE_VAL;
    for (std::size_t s = n_near; s < shells.size(); ++s) {
        double r[3];
        for (int d = 0; d < 3; ++d)
            r[d] = apart[d] * grid.side[d] - shells[s].image[d] * lengths[d];
        nearest = std::min(nearest, std::hypot(r[0], r[1], r[2]));
    }
    return nearest;
}

/// At most the error of an acceleration, in |m| / V^(2/3), by expansions of two cells this far from
/// the nearest image left out: what one image's terms beyond the order are at the cells' corners.
/// Measured with a particle in a corner of the box: 0.15 to 1 of this.
double truncation(double unit, double spread, double clearance, int order) {
    const double size = unit / clearance;
    return size * size * (order + 1) * std::pow(spread / clearance, order);
}

/// The lowest order that is accurate enough; one more than the highest if none is.
int order_for(double accuracy, double unit, double spread, double clearance) {
    int order = min_order;
    if (!(spread < clearance)) return max_expansion_order + 1;
    while (order <= max_expansion_order && truncation(unit, spread, clearance, order) > accuracy)
        ++order;
    return order;
}

/// Nanoseconds, measured with AVX-512: 200 000 particles, all pairs of cells, and what more near
/// images may cost those who sum over them.
double cost(const LatticeGrid& grid, std::size_t n_near, int order) {
    const double p = order, cells = grid.size();
    const double particles = 1e5 * (p + 1) * (p + 1);
    const double pairs = 0.8 * cells * cells / 8 * (p + 1) * (p + 2) * (p + 3) * (p + 4) / 24;
    return particles + pairs + 5e6 * static_cast<double>(n_near - min_near_images);
}

void check_lengths(const Lengths& lengths) {
    double lo = HUGE_VAL, hi = 0;
    for (int d = 0; d < 3; ++d) {
        if (!std::isfinite(lengths[d]) || !(lengths[d] > 0))
            throw Error(Status::box, "box: side " + std::to_string(d) + " is " +
                                         number(lengths[d]) + ", must be finite and > 0");
        lo = std::min(lo, lengths[d]);
        hi = std::max(hi, lengths[d]);
    }
    if (hi / lo > max_side_ratio * (1 + 1e-12))
        throw Error(Status::box, "box: the longest side of a periodic box is " + number(hi / lo) +
                                     " times the shortest, must be at most " +
                                     number(max_side_ratio) + " for gravity");
}

struct Choice {
    LatticeGrid grid;
    std::size_t n_near = 0;
    double cost = HUGE_VAL;
};

/// The best number of near images for a grid, if it is better than `best`.
void choose_images(const Lengths& lengths, const LatticeGrid& grid, double accuracy, double unit,
                   Choice& best) {
    const std::vector<Shell> shells = make_shells(lengths, grid);
    for (std::size_t n = whole_shells(shells, min_near_images); n <= max_near_images;
         n = whole_shells(shells, n + 1)) {
        const int order = order_for(accuracy, unit, spread(grid), shells[n].distance);
        if (order > max_expansion_order) continue;
        const double found = cost(grid, n, order);
        if (found < best.cost) best = {grid, n, found};
    }
}

}  // namespace

LatticePlan plan_lattice(const Lengths& lengths, double accuracy) {
    check_lengths(lengths);
    if (!(accuracy >= min_lattice_accuracy))
        throw Error(Status::argument, "accuracy of far images is " + number(accuracy) +
                                          ", must be at least " + number(min_lattice_accuracy));
    const double unit = std::cbrt(lengths[0]) * std::cbrt(lengths[1]) * std::cbrt(lengths[2]);
    const double longest = *std::max_element(lengths.begin(), lengths.end());
    Choice best;
    for (int n = 2; n <= max_cells_a_side; n += 2) {
        std::array<int, 3> cells;
        for (int d = 0; d < 3; ++d)
            cells[d] = 2 * static_cast<int>(std::ceil(n / 2 * lengths[d] / longest - 1e-9));
        const LatticeGrid grid = make_grid(lengths, cells);
        if (grid.size() > max_cells) break;
        choose_images(lengths, grid, accuracy, unit, best);
    }
    if (best.n_near == 0)
        throw Error(Status::unsupported, "accuracy of far images is " + number(accuracy) +
                                             ", which a box of this shape cannot have");
    LatticePlan plan = plan_lattice(lengths, best.grid.cells, static_cast<int>(best.n_near), 0);
    const std::vector<Shell> shells = make_shells(lengths, plan.grid);
    for (int c = 0; c < plan.grid.size(); ++c) {
        const double clear = clearance(lengths, plan.grid, plan.grid.place(c), shells, best.n_near);
        plan.orders[c] = order_for(accuracy, unit, spread(plan.grid), clear);
        plan.order = std::max(plan.order, plan.orders[c]);
    }
    return plan;
}

LatticePlan plan_lattice(const Lengths& lengths, const std::array<int, 3>& cells, int n_near,
                         int order) {
    LatticePlan plan;
    plan.grid = make_grid(lengths, cells);
    const std::vector<Shell> shells = make_shells(lengths, plan.grid);
    const std::size_t n = whole_shells(shells, static_cast<std::size_t>(n_near));
    for (std::size_t s = 0; s < n; ++s) plan.near.push_back(shells[s].image);
    plan.order = order;
    plan.orders.assign(plan.grid.size(), order);
    return plan;
}

}  // namespace connectivity::detail
