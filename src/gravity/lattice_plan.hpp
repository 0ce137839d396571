// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How the far images of a periodic box are summed to an accuracy: the grid, the images that are
/// near, and the orders of expansions.

#include <array>
#include <vector>

#include "lattice_grid.hpp"

namespace connectivity::detail {

struct LatticePlan {
    using Image = std::array<int, 3>;

    LatticeGrid grid;         ///< even numbers of cells
    std::vector<Image> near;  ///< {0, 0, 0} first, then by distance; each with its opposite
    int order = 0;            ///< the largest of all
    /// [cells] order of the expansions of two cells that are |i|, |j|, |k| cells apart.
    std::vector<int> orders;
};

constexpr int max_near_images = 64;
constexpr double max_side_ratio = 10;
constexpr double min_lattice_accuracy = 1e-12;

/// The cheapest plan whose accelerations are wrong by at most accuracy * sum |m| / V^(2/3) wherever
/// particles are. Throws Error{box} if a side is no length, or more than max_side_ratio times
/// another.
LatticePlan plan_lattice(const std::array<double, 3>& lengths, double accuracy);

/// One with this grid and at least these images by hand; for measurements.
LatticePlan plan_lattice(const std::array<double, 3>& lengths, const std::array<int, 3>& cells,
                         int n_near, int order);

}  // namespace connectivity::detail
