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

/// Distances of the images that are not near from two cells this many cells apart.
void find_distances(const Lengths& lengths, const LatticeGrid& grid,
                    const std::array<int, 3>& apart, const std::vector<Shell>& shells,
                    std::size_t n_near, std::vector<double>& distances) {
    distances.clear();
    for (std::size_t s = n_near; s < shells.size(); ++s) {
        double r2 = 0;
        for (int d = 0; d < 3; ++d) {
            const double r = apart[d] * grid.side[d] - shells[s].image[d] * lengths[d];
            r2 += r * r;
        }
        distances.push_back(std::sqrt(r2));
    }
}

/// The lowest order at which the terms beyond it of all images at these distances are accurate
/// enough; one more than the highest if none is. An image's terms of degree n are at most
/// n (spread / distance)^(n-1) / distance² in the cells' corners. Accelerations in |m| / V^(2/3),
/// `unit` is V^(1/3).
int order_for(double accuracy, double unit, double spread, std::vector<double>& distances) {
    const double nearest = *std::min_element(distances.begin(), distances.end());
    if (!(spread < nearest)) return max_expansion_order + 1;
    // Others are of no weight.
    std::erase_if(distances, [=](double distance) { return distance > 4 * nearest; });
    std::vector<double> power(distances.size());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double size = unit / distances[i], ratio = spread / distances[i];
        power[i] = size * size / ((1 - ratio) * (1 - ratio));
    }
    for (int order = 1; order <= max_expansion_order; ++order) {
        double rest = 0;
        for (std::size_t i = 0; i < distances.size(); ++i) {
            const double ratio = spread / distances[i];
            power[i] *= ratio;
            rest += power[i] * (1 + order * (1 - ratio));
        }
        if (order >= min_order && rest <= accuracy) return order;
    }
    return max_expansion_order + 1;
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

/// Two cells as far apart as may be, towards this image.
std::array<int, 3> nearest_cells(const LatticeGrid& grid, const Image& image) {
    std::array<int, 3> apart;
    for (int d = 0; d < 3; ++d) apart[d] = image[d] == 0 ? 0 : grid.cells[d] - 1;
    return apart;
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
    std::vector<double> distances;
    for (std::size_t n = whole_shells(shells, min_near_images); n <= max_near_images;
         n = whole_shells(shells, n + 1)) {
        // Cells at an edge of the box, where images of one side are nearest.
        find_distances(lengths, grid, nearest_cells(grid, shells[n].image), shells, n, distances);
        const int order = order_for(accuracy, unit, spread(grid), distances);
        if (order >= max_expansion_order) continue;  // others, with more images, may need one more
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
    std::vector<double> distances;
    for (int c = 0; c < plan.grid.size(); ++c) {
        find_distances(lengths, plan.grid, plan.grid.place(c), shells, best.n_near, distances);
        plan.orders[c] = order_for(accuracy, unit, spread(plan.grid), distances);
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
