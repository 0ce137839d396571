// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Metrics: ellipsoids as the float tests of a frame see them, and the proof that they lose no
/// pair.
///
/// The shape of a node is P = (reach H / K)², for scalar supports the identity; it has no unit and,
/// as a ball of radius `reach` holds the ellipsoid, no eigenvalue below 1. With t = reach² in units
/// of the frame a node sees a point at r iff g = r'P r / t <= 1, and g >= |r|²/t everywhere. The
/// metric (c, M) is
///     q(r) = c + r'M r = (g - 1) / e,
/// g in units of its own error: q <= -1 is certain, q > 1 certainly not, and between them the
/// double predicate decides. So ellipsoids, balls and nodes that see nobody (c = 2, M = 0) are all
/// tested alike.
///
/// How large e must be, with u = 2^-24 and T = tr P: coordinates are off by |δ| <= D + 2.2 u |r|,
/// D = 3.5 u m + 4 w for a frame of half width m and what folding moved, w (see Frame). As H is
/// linear, sqrt(g) is off by at most sqrt(T/t) |δ| <= z + 2.2 u sqrt(T g), z = D sqrt(T/t).
/// Rounding P, M, the products and up to seven sums adds u (15 T g + 7), for no entry of P exceeds
/// T, and the double predicate itself 2^-49 T g.
/// - If a node is seen, g <= 1: the computed e q <= 2 z + z² + 31 u T.
/// - If it is not, g > 1: the computed e q + 1 >= g (1 - 20 u T) - 2 z sqrt(g) - 7 u T, which grows
///   with g, so e q >= -2 z - 27 u T.
/// Hence e = 40 u T + 2.25 z, where e <= 1/4. Nodes with a larger error, such as ellipsoids of axis
/// ratio beyond 300, take c = 0 and the M of a ball that holds theirs: never certain, at most in
/// doubt. Too large numbers come out as q = +inf or NaN, which is not seen, and only far outside.

#include "kernels.hpp"

namespace connectivity::detail {

constexpr float shape_error = 40 * 0x1p-24f;
constexpr float position_error = 2.25f;
constexpr float largest_metric_error = 0.25f;

}  // namespace connectivity::detail
