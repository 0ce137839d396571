// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/plane.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <connectivity/base/error.hpp>

namespace connectivity {

namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw Error(Status::argument, "plane: " + what);
}

void check_vector(const char* name, int dim, std::span<const double> values) {
    if (static_cast<int>(values.size()) != dim)
        refuse(std::string(name) + " has " + std::to_string(values.size()) +
               " components, must have dim = " + std::to_string(dim));
    for (int d = 0; d < dim; ++d)
        if (!std::isfinite(values[d]))
            refuse(std::string(name) + "[" + std::to_string(d) + "] = " + number(values[d]) +
                   ", must be finite");
}

/// Cosines and sines of angles that rounding makes.
constexpr double small_angle = 1e-12;

}  // namespace

Plane::Plane(int dim, std::span<const double> point, std::span<const double> normal) : dim_(dim) {
    if (dim < 1 || dim > 3) refuse("dim = " + std::to_string(dim) + ", must be 1, 2 or 3");
    check_vector("point", dim, point);
    check_vector("normal", dim, normal);
    double largest = 0, sum = 0;
    for (const double component : normal) largest = std::max(largest, std::abs(component));
    if (largest == 0) refuse("normal has length 0, must be longer");
    for (int d = 0; d < dim; ++d) {
        point_[d] = point[d];
        normal_[d] = normal[d] / largest;
        sum += normal_[d] * normal_[d];
    }
    if (sum != 1)
        for (double& component : normal_) component /= std::sqrt(sum);
}

int Plane::alignment(const Plane& other) const {
    const auto &a = normal_, &b = other.normal_;
    double cosine = 0, sine2 = 0;
    for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3;
        const double cross = a[d] * b[e] - a[e] * b[d];
        cosine += a[d] * b[d];
        sine2 += cross * cross;
    }
    if (sine2 > small_angle * small_angle) return 0;
    return cosine > 0 ? 1 : -1;
}

}  // namespace connectivity
