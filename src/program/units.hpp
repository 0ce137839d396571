// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Units in words that the field uses: "ckpc/h", "1e10 Msun/h". Empty where the file does not tell.

#include <string>

#include <connectivity/io/snapshot.hpp>

namespace connectivity::program {

std::string length_unit(const Units& units);
std::string mass_unit(const Units& units);

/// "1e10 Msun/h (ckpc/h)^-3", or what the units are in terms of the file if it does not tell.
std::string density_unit(const Units& units, int dim);

}  // namespace connectivity::program
