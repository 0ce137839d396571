// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// From a tolerance to settings: tables of what was fastest where it was measured, and trials on
/// the sample that find the epsilon of the scene at hand.

#include "sample.hpp"
#include "tree_sum.hpp"

namespace connectivity::detail {

constexpr double least_epsilon = 1e-15;

/// Most particles in a leaf.
std::int32_t usual_leaf(const TreeSettings& settings);
/// Order of expansions that reaches the tolerance at the least cost on most scenes.
int usual_order(FarForm form, double tolerance);
/// Epsilon that usually brings the 99th percentile to the tolerance.
double usual_epsilon(const TreeSettings& settings, double tolerance);
/// Number of particles below which direct summation is faster than anything else.
Offset direct_below(double tolerance);

/// Time of this work in units of one near pair in double precision, for comparison.
double cost_of(const TreeSettings& settings, const TreeWork& work, Offset n);

/// Changes settings.epsilon until the sample's p99 is near the tolerance's third; far enough below
/// to be below it for all particles, too, and not so far that time is wasted. `trial` is scratch.
/// Where forces cancel, float32 may not reach the tolerance: then settings.float32 is
/// changed, too, unless that was asked for. Returns the work that the last trial promises.
TreeWork fit_epsilon(TreeSum& tree, Sample& sample, double tolerance, TreeSettings& settings,
                     SumArrays& trial);

}  // namespace connectivity::detail
