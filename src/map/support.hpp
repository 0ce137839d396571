// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The support of one node: is it legal, how far does it reach?

#include <cmath>
#include <limits>

#include <connectivity/base/types.hpp>

namespace connectivity {

/// What can be wrong with one node, in the order in which it is looked for.
enum class Fault { none, position, support, not_spd, half_box };

/// Squared reach of a scalar support, -1 for h = 0, which sees nobody. Each product is rounded
/// once.
inline double scalar_reach2(double h, double extent) {
    const double reach = extent * h;
    return h > 0 ? reach * reach : -1.0;
}

/// The inverse of a packed symmetric tensor, by Cholesky, and how far to trust it.
template <int Dim>
struct TensorSupport {
    bool positive_definite = false;
    double half_width[Dim];  ///< of the ellipsoid |H r| <= 1 along each axis
    double radius = 0;  ///< of a ball that holds it, rounding of |H r|² included; may be infinite
};

/// Every pivot must exceed 1e-14 of its diagonal entry: Sylvester's criterion, free of units.
template <int Dim>
TensorSupport<Dim> tensor_support(const double* packed);

}  // namespace connectivity
