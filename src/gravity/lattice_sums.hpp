// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sums over the images of a periodic box of irregular harmonics: what all images of a source but
/// the near ones do around a point, with the uniform background that makes the mean density 0.
///
/// Method: Ewald's sum, every degree of it (Nijboer & de Wette, Physica 23 (1957) 309), conducting
/// surroundings. Near images are taken out of the screened part in closed form, so nothing cancels.
/// Cost: some 50 images and 500 waves a point, each of (order + 1)² terms.

#include <array>
#include <vector>

namespace connectivity::detail {

class LatticeSums {
public:
    using Image = std::array<int, 3>;

    /// Orthorhombic box; lengths in units not far from the distances of interest (1e-3 to 1e3).
    /// `near` are the images left out, each with its opposite. order <= 30.
    LatticeSums(const std::array<double, 3>& lengths, const std::vector<Image>& near, int order);

    /// Coefficients T of the far part around r = d, in the layout of expansions:
    ///     H(d - y) - 2 pi / (3 V) |d - y|² = sum_nm conj(R_nm(y)) T_nm,
    /// where H = G - sum over near images of 1/r and the mean of G over the box is 0.
    /// `sums` has (order + 1)² elements, order up to that of the constructor.
    void at(const std::array<double, 3>& d, int order, double* sums) const;

private:
    void add_images(const std::array<double, 3>& d, int order, double* sums) const;
    void add_waves(const std::array<double, 3>& d, int order, double* sums) const;
    void add_background(const std::array<double, 3>& d, int order, double* sums) const;

    std::array<double, 3> lengths_;
    std::vector<Image> near_;
    int order_;
    double volume_, alpha_;
    std::vector<std::array<double, 3>> waves_;
    std::vector<double> harmonics_;  ///< weight * R_nm(k) / (2n-1)!! of each wave
};

/// R_nm(r) for n <= order, in the layout of expansions.
void regular_harmonics(const double r[3], int order, double* out);

}  // namespace connectivity::detail
