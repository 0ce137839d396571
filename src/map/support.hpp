// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The support of one node: is it legal, how far does it reach?

#include <cmath>
#include <limits>

#include <connectivity/base/types.hpp>

namespace connectivity {

/// What can be wrong with one node, in the order in which it is looked for.
enum class Fault { none, position, support, not_spd, ill_conditioned, half_box };

/// Squared reach of a scalar support, -1 for h = 0, which sees nobody. Each product is rounded
/// once.
inline double scalar_reach2(double h, double extent) {
    const double reach = extent * h;
    return h > 0 ? reach * reach : -1.0;
}

/// The same for a support that a skin > 0 widens; h = 0 reaches as far as the skin. The factor is
/// the rounding of distances, displacements and growth that drift.hpp speaks of.
inline double widened_reach2(double h, double extent, double skin) {
    const double reach = (extent * h + skin) * (1 + 32 * std::numeric_limits<double>::epsilon());
    return reach * reach;
}

/// The inverse of a packed symmetric tensor, by Cholesky, and how far to trust it.
template <int Dim>
struct TensorSupport {
    bool positive_definite = false;
    double half_width[Dim] = {};  ///< of the ellipsoid |H r| <= 1 along each axis, if asked for
    double radius = 0;  ///< of a ball that holds it, rounding of |H r|² included; may be infinite
};

/// Half widths cost as much as all the rest; only periodic axes ask for them.
enum class HalfWidths { none, all };

/// Every pivot must exceed 1e-14 of its diagonal entry: Sylvester's criterion, free of units.
template <int Dim>
TensorSupport<Dim> tensor_support(const double* packed, HalfWidths widths);

/// Writes the packed tensor W of an ellipsoid |W r| <= extent that holds every point within `skin`
/// of the ellipsoid |H r| <= extent, for H that is positive definite: of all sums
/// (1 + 1/p) a² + (1 + p) skin² of the squared half axes the one of least trace. It is wide enough
/// for all rounding, of both tests |W r| and |H r| too. False if that cannot be had: condition
/// number of H above 7e12, or axes that overflow.
template <int Dim>
bool widen_tensor(const double* packed, double extent, double skin, double* widened);

/// How much farther than |before r| <= 1 the ellipsoid |after r| <= 1 reaches, in any direction:
/// never too small, 0 for equal tensors and for an ellipsoid inside the old one, infinite if
/// `after` is no legal tensor. Else it is the norm of the difference of the inverses, to which the
/// directions that shrink add, too.
template <int Dim>
double tensor_growth(const double* before, const double* after);

}  // namespace connectivity
