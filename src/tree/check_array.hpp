// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Checks of one array of particles or balls.

#include <string>

#include <connectivity/tree/tree_input.hpp>

namespace connectivity::tree_detail {

/// Counts, strides, pointers. `kind` names one of its elements. Throws Error{argument, null,
/// too_many}.
void check_array(const std::string& kind, const ParticleArray& array, int dim,
                 CoordinateType coordinates);

/// Values, too: finite positions, finite radii >= 0. Throws Error{nonfinite, support}.
void check_values(const std::string& kind, const ParticleArray& array, int dim,
                  CoordinateType coordinates);

/// Element i of an array of coordinates.
inline double element(const void* data, CoordinateType type, Offset i) {
    return type == CoordinateType::float32 ? static_cast<double>(static_cast<const float*>(data)[i])
                                           : static_cast<const double*>(data)[i];
}

inline double coordinate(const ParticleArray& array, CoordinateType type, Offset i, int d) {
    return element(array.positions, type, i * array.particle_stride + d * array.axis_stride);
}

/// 0 for points.
inline double radius(const ParticleArray& array, CoordinateType type, Offset i) {
    return array.radii == nullptr ? 0 : element(array.radii, type, i * array.radius_stride);
}

}  // namespace connectivity::tree_detail
