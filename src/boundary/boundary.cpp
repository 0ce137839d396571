// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/boundary.hpp>

#include <connectivity/base/error.hpp>

namespace connectivity {

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
    throw Error(Status::argument, "boundary \"" + name + "\": " + what);
}

}  // namespace

Boundary Boundary::reflecting(std::string name, const Plane& plane) {
    Boundary boundary(std::move(name), plane.dim());
    boundary.ways_ = {{plane, plane, RigidMap::mirror(plane)}};
    return boundary;
}

Boundary Boundary::periodic(std::string name, const Plane& one, const Plane& other) {
    if (one.dim() != other.dim())
        refuse(name, "planes of dim " + std::to_string(one.dim()) + " and " +
                         std::to_string(other.dim()) + ", must be the same");
    const int alignment = one.alignment(other);
    if (alignment == 0) refuse(name, "the planes are not parallel");
    const double length = one.distance(other);
    if (alignment > 0 || !(length > 0))
        refuse(name,
               "the planes must face each other, normals pointing into the domain; the second "
               "is at distance " +
                   number(length) + " from the first and faces " +
                   (alignment > 0 ? "the same way" : "the opposite way"));
    std::array<double, 3> forth, back;
    for (int d = 0; d < 3; ++d) {
        forth[d] = length * one.normal()[d];
        back[d] = -forth[d];
    }
    Boundary boundary(std::move(name), one.dim());
    boundary.ways_ = {{one, other, RigidMap::shift(forth)}, {other, one, RigidMap::shift(back)}};
    return boundary;
}

Boundary Boundary::given(std::string name, int dim, const RigidMap& map, ControlFunction controls) {
    if (dim < 1 || dim > 3) refuse(name, "dim = " + std::to_string(dim) + ", must be 1, 2 or 3");
    if (!controls) refuse(name, "no function names the nodes");
    Boundary boundary(std::move(name), dim);
    boundary.given_map_ = map;
    boundary.controls_ = std::move(controls);
    return boundary;
}

}  // namespace connectivity
