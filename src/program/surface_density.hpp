// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Projection of node lists on the x-y plane: mass (or nodes) per area, each node spread over its
/// own support.
///
/// Invariant: mass is conserved up to the resolution of a support by pixels (1 % where it is a few
/// pixels wide) and to what lies outside an open window. On periodic axes the window is the box and
/// supports wrap around it. Cost: the number of pixels under all supports.

#include <span>
#include <vector>

#include <connectivity/io/snapshot.hpp>

namespace connectivity::program {

struct SurfaceDensity {
    int nx = 0, ny = 0;                     ///< pixels; ny = 1 in one dimension
    double lo[2] = {0, 0}, hi[2] = {1, 1};  ///< window, in the units of the positions
    bool by_mass = false;                   ///< mass per area, else nodes per area
    std::vector<float> values;              ///< [ny * nx], row by row from the lowest y

    /// Value that `fraction` of the pixels that hold anything do not exceed; 0 if none does.
    float quantile(double fraction) const;
};

/// Weighs by mass if every list has masses. `pixels` is the longer side of the image.
SurfaceDensity surface_density(std::span<const ListData> lists, const Domain& domain, int pixels);

}  // namespace connectivity::program
