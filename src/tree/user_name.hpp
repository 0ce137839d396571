// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How messages name a particle: as the host counts.

#include <string>

#include "particles.hpp"

namespace connectivity::tree_detail {

/// "source 5" or "target 7".
template <class Real, int Dim>
std::string user_name(const Particles<Real, Dim>& particles, Offset i) {
    const Offset n = particles.n_sources();
    return i < n ? "source " + std::to_string(i) : "target " + std::to_string(i - n);
}

}  // namespace connectivity::tree_detail
