// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Acceleration and potential against the distance from the deepest particle. Drawn by gnuplot.

#include <string>
#include <vector>

#include <connectivity/gravity/gravity.hpp>

#include "program/gravity_particles.hpp"

namespace connectivity::program {

/// One particle of the picture.
struct FieldPoint {
    double r = 0;  ///< distance from the deepest particle, of nearest images
    double a = 0;  ///< |acceleration|
    double phi = 0;
};

/// What a share of the particles at about this distance stays below.
struct FieldBand {
    double r = 0;
    double a[3] = {0, 0, 0};    ///< 10 %, half, 90 %
    double phi[3] = {0, 0, 0};  ///< 10 %, half, 90 %
};

/// All particles, in the order of the input.
std::vector<FieldPoint> field_points(const GravityInput& input, const Gravity& gravity,
                                     const Domain& domain);

/// Distances in equal steps of their logarithm; those with few particles are left out, and so are
/// particles at distance 0.
std::vector<FieldBand> field_bands(std::vector<FieldPoint> points);

struct GravityPictureText {
    std::string title, caption;
    std::string length_unit;  ///< empty if unknown
};

/// Draws a PNG. Atomic. Throws Error: argument (nothing to draw), unsupported (no gnuplot), file.
void draw_gravity(const std::string& path, const GravityInput& input,
                  const std::vector<FieldPoint>& points, const GravityPictureText& text);

}  // namespace connectivity::program
