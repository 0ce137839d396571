// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Refuses what is no input: counts, strides, limits, weights, values; and finds the root box.

#include <connectivity/tree/tree_input.hpp>

#include "frame.hpp"

namespace connectivity::tree_detail {

/// All that can be checked without reading particles. Throws Error{argument, null, too_many}.
void check_arguments(const TreeInput& input, const TreeOptions& options);

/// Weights in [0, limit]. Throws Error{argument}.
void check_weights(const TreeInput& input, std::int64_t limit);

/// Reads all particles once and lays the root box around them. Throws Error{nonfinite, support,
/// box}.
template <class Real, int Dim>
Frame<Real, Dim> root_box(const Particles<Real, Dim>& particles, const TreeOptions& options);

}  // namespace connectivity::tree_detail
