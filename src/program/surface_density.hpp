// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Projection of node lists on the x-y plane: mass (or nodes) per area, each node spread over its
/// own support.
///
/// Invariant: what lies in the window is conserved, to 1e-3 where supports cover many pixels. On
/// periodic axes the window is the box and supports wrap around it; on open ones a few outliers may
/// be left out. Cost: the number of pixels under all supports.

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
