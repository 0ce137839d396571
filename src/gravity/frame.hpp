// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The frame in which forces are summed: the host's particles as separate doubles, scaled by powers
/// of two, so that scaling is exact and no power of a distance leaves the range of a double.
///
/// Invariants: the widest extent (of a periodic box: the longest side) is in (0.5, 1], or less
/// where softening lengths are 2^40 times that, or 0; the sum of |m| is in (0.5, 1], or 0; all
/// values are finite. Cost: two passes over the particles.

#include <array>

#include <connectivity/gravity/options.hpp>
#include <connectivity/gravity/particles.hpp>

namespace connectivity::detail {

struct Frame {
    Offset n = 0;
    View<double> x;            ///< [3][n]
    View<double> mass;         ///< [n]
    View<double> softening;    ///< [n]; empty where all are 0
    double length = 1;         ///< the host's length of one unit, a power of two
    double mass_unit = 1;      ///< the host's mass of one unit, a power of two
    double max_softening = 0;  ///< in units of the frame
    bool periodic = false;
    std::array<double, 3> box{};  ///< sides of the periodic box, whose low corner is at 0
};

/// Checks everything about the particles and the domain and lays the frame around them; arrays of
/// `frame` are reused where they suffice. Throws as Gravity::solve does; then `frame` is of no use.
void make_frame(const GravityParticles& particles, const GravityOptions& options, Frame& frame);

}  // namespace connectivity::detail
