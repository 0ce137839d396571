// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Bounding boxes of the particles below each box.
///
/// The hull of a box: its centre, x - r and x + r of its own particles, and its children's hulls;
/// so it holds the centres of all boxes below. Cost: one pass over particles and boxes.

#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// min, max [dim][aligned_n_boxes], host; padding is 0. `particles` are the tree's sources or
/// targets.
void particle_hulls(const TreeView& tree, const TreeParticles& particles, View<double> min,
                    View<double> max);

}  // namespace connectivity
