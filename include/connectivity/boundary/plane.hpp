// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A plane that bounds the domain (a line in 2D, a point in 1D).
///
/// Invariants: all values finite; the normal has length 1 and points into the domain; components
/// beyond the dimension are 0.

#include <array>
#include <span>

namespace connectivity {

class Plane {
public:
    /// point [dim], normal [dim] of any length > 0. Throws Error{argument} for a dimension that is
    /// none, shapes that disagree, values that are not finite and a normal of length 0.
    Plane(int dim, std::span<const double> point, std::span<const double> normal);

    int dim() const { return dim_; }
    const std::array<double, 3>& point() const { return point_; }
    const std::array<double, 3>& normal() const { return normal_; }

    /// Signed distance of a position [Dim], positive inside.
    template <int Dim>
    double distance(const double* x) const {
        double sum = 0;
        for (int d = 0; d < Dim; ++d) sum += normal_[d] * (x[d] - point_[d]);
        return sum;
    }
    double distance(const Plane& other) const { return distance<3>(other.point_.data()); }

    /// What rounding may do to the distance of a position: less than this is on the plane.
    template <int Dim>
    double rounding(const double* x) const {
        double sum = 0;
        for (int d = 0; d < Dim; ++d)
            sum += (x[d] < 0 ? -x[d] : x[d]) + (point_[d] < 0 ? -point_[d] : point_[d]);
        return 4 * 0x1p-52 * sum;
    }

    /// +1 if the other plane faces the same way, -1 if the opposite way, 0 if they are not
    /// parallel.
    int alignment(const Plane& other) const;

private:
    int dim_;
    std::array<double, 3> point_{0, 0, 0}, normal_{0, 0, 0};
};

}  // namespace connectivity
