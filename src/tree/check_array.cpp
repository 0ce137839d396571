// SPDX-License-Identifier: BSD-3-Clause
#include "check_array.hpp"

#include <cmath>

namespace connectivity::tree_detail {

namespace {

void check_stride(const std::string& what, Offset stride, Offset n) {
    const Offset most = (Offset{1} << 58) / n;
    if (stride < 1 || stride > most)
        throw Error(Status::argument, what + " is " + std::to_string(stride) + ", must be in [1, " +
                                          std::to_string(most) + "] elements");
}

void check_pointer(const std::string& what, const void* pointer, CoordinateType type) {
    const std::size_t size = type == CoordinateType::float32 ? sizeof(float) : sizeof(double);
    if (pointer == nullptr)
        throw Error(Status::null, what + " are null, must be given where there are any");
    if (reinterpret_cast<std::uintptr_t>(pointer) % size != 0)
        throw Error(Status::argument, what + " are at an address that is no multiple of their " +
                                          std::to_string(size) + " bytes an element");
}

}  // namespace

void check_array(const std::string& kind, const ParticleArray& array, int dim,
                 CoordinateType coordinates) {
    if (array.n < 0 || array.n > max_slots)
        throw Error(array.n < 0 ? Status::argument : Status::too_many,
                    "the number of " + kind + "s is " + std::to_string(array.n) +
                        ", must be in [0, " + std::to_string(max_slots) + "]");
    if (array.n == 0) return;
    check_pointer("positions of " + kind + "s", array.positions, coordinates);
    if (array.n > 1) check_stride(kind + " particle_stride", array.particle_stride, array.n);
    if (dim > 1) check_stride(kind + " axis_stride", array.axis_stride, dim);
    if (array.radii == nullptr) return;
    check_pointer("radii of " + kind + "s", array.radii, coordinates);
    if (array.n > 1) check_stride(kind + " radius_stride", array.radius_stride, array.n);
}

void check_values(const std::string& kind, const ParticleArray& array, int dim,
                  CoordinateType coordinates) {
    for (Offset i = 0; i < array.n; ++i) {
        for (int d = 0; d < dim; ++d)
            if (const double x = coordinate(array, coordinates, i, d); !std::isfinite(x))
                throw Error(Status::nonfinite, kind + " " + std::to_string(i) + ": position[" +
                                                   std::to_string(d) + "] = " + number(x) +
                                                   ", must be finite");
        const double r = radius(array, coordinates, i);
        if (!(r >= 0) || !std::isfinite(r))
            throw Error(Status::support, kind + " " + std::to_string(i) + ": radius = " +
                                             number(r) + ", must be finite and >= 0");
    }
}

}  // namespace connectivity::tree_detail
