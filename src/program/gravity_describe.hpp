// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Words and tables for people about gravity.

#include <string>

#include "program/gravity_particles.hpp"

namespace connectivity::program {

/// One line per list: particles, mass, softening.
std::string describe_gravity_lists(const GravityInput& input);

/// Method and settings, errors of the sample, and whether the tolerance was kept.
std::string describe_solution(const GravityInfo& info, const GravityOptions& options);

/// Potential energy and the force of all particles on themselves, which should be none.
std::string describe_sums(const Gravity& gravity, const GravityInput& input,
                          const GravityOptions& options);

/// "G = 1: accelerations are G m/r^2, m/r^2 in 1e10 Msun/h (ckpc/h)^-2; ..."
std::string describe_gravity_units(double constant, const Units& units);

}  // namespace connectivity::program
