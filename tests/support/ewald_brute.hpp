// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The oracle for periodic boxes: Ewald's sum over every pair, in long double. Cost: n_targets *
/// n_sources * about 40 images, and (n_targets + n_sources) * about 1000 waves.

#include <array>
#include <vector>

namespace connectivity::test {

/// p = sum of m G(x - y) and a = its gradient, with G = 1/r + O(1) near 0.
struct EwaldSums {
    std::vector<double> p;  ///< [n_targets]
    std::vector<double> a;  ///< [n_targets][3]
};

/// Sources y [n][3] with masses m [n], all their images and the uniform background that makes the
/// mean mass 0, at targets x [n_targets][3]; conducting surroundings, mean of G over the box 0. An
/// image exactly at a target contributes lim (G - 1/r). `splitting`, about 3.5, is Ewald's
/// parameter times the cube root of the volume: it moves work between images and waves, and no
/// result.
EwaldSums ewald_brute(const std::array<double, 3>& lengths, const std::vector<double>& y,
                      const std::vector<double>& m, const std::vector<double>& x,
                      double splitting = 3.5);

}  // namespace connectivity::test
