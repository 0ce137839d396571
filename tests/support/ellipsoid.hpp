// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// An ellipsoid by its axes, and the tensor that has it as support.

#include <algorithm>
#include <cmath>

#include <support/random.hpp>

namespace connectivity::test {

/// Orthonormal directions and half lengths.
struct Ellipsoid {
    double direction[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double half[3] = {1, 1, 1};

    /// Anywhere; each axis `scale`, `scale` / `ratio` or between.
    Ellipsoid(Random& random, int dim, double ratio, double scale) {
        for (double& a : half)
            a = scale * random.pick({1.0, 1 / ratio, random.log_uniform(1 / ratio, 1)});
        for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b) turn(a, b, random.uniform(0, 6.28), dim);
    }

    void turn(int a, int b, double angle, int dim) {
        for (int d = 0; d < dim; ++d) {
            const double p = direction[a][d], q = direction[b][d];
            direction[a][d] = std::cos(angle) * p - std::sin(angle) * q;
            direction[b][d] = std::sin(angle) * p + std::cos(angle) * q;
        }
    }

    /// Packed H with |H r| <= extent.
    void pack(int dim, double extent, double* packed) const {
        for (int i = 0, at = 0; i < dim; ++i)
            for (int j = i; j < dim; ++j, ++at) {
                packed[at] = 0;
                for (int k = 0; k < dim; ++k)
                    packed[at] += direction[k][i] * direction[k][j] * extent / half[k];
            }
    }

    /// Farthest point along u, and how far that is.
    double farthest(int dim, const double* u, double* point) const {
        double width2 = 0;
        for (int d = 0; d < dim; ++d) point[d] = 0;
        for (int k = 0; k < dim; ++k) {
            double along = 0;
            for (int d = 0; d < dim; ++d) along += direction[k][d] * u[d];
            width2 += half[k] * half[k] * along * along;
            for (int d = 0; d < dim; ++d) point[d] += half[k] * half[k] * along * direction[k][d];
        }
        for (int d = 0; d < dim; ++d) point[d] /= std::sqrt(width2);
        return std::sqrt(width2);
    }

    /// A point of the surface, spread over all axes alike.
    void surface(Random& random, int dim, double* point) const {
        double along[3], length = 0;
        for (int k = 0; k < dim; ++k) {
            along[k] = random.uniform(-1, 1);
            length = std::hypot(length, along[k]);
        }
        for (int d = 0; d < dim; ++d) {
            point[d] = 0;
            for (int k = 0; k < dim; ++k) point[d] += half[k] * along[k] / length * direction[k][d];
        }
    }
};

}  // namespace connectivity::test
