// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The particles that attract each other, as they lie in the host's memory.
///
/// Everything is read during the call that is given them, and only then. Host memory. In one and
/// two dimensions the coordinates that are missing are 0: the law stays 1/r².

#include <array>

#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// Coordinate d of particle i is element i * particle_stride + d * axis_stride of `positions`;
/// strides count elements and are >= 1. All arrays are of one type.
struct GravityParticles {
    int dim = 3;
    CoordinateType type = CoordinateType::float64;
    Offset n = 0;
    const void* positions = nullptr;
    Offset particle_stride = 1, axis_stride = 1;
    const void* masses = nullptr;  ///< [n], finite; zero and negative ones are legal
    Offset mass_stride = 1;
    const void* softening = nullptr;  ///< [n], lengths, finite, >= 0; nullptr: none
    Offset softening_stride = 1;

    /// positions [n][dim]
    static GravityParticles interleaved(const double* positions, const double* masses, Offset n,
                                        int dim = 3) {
        return {
            .dim = dim, .n = n, .positions = positions, .particle_stride = dim, .masses = masses};
    }
    /// positions [dim][n]
    static GravityParticles separate(const double* positions, const double* masses, Offset n,
                                     int dim = 3) {
        return {.dim = dim,
                .n = n,
                .positions = positions,
                .axis_stride = n > 0 ? n : 1,
                .masses = masses};
    }
};

}  // namespace connectivity
