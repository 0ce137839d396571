// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Looks at the places of output files before the work and not after it.

#include <initializer_list>
#include <string>

namespace connectivity::program {

/// Empty names are none. Throws Error: argument (one is the input), file (it cannot be written).
void check_outputs(const std::string& input, std::initializer_list<std::string> outputs);

}  // namespace connectivity::program
