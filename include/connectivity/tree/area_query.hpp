// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Which leaves do balls touch? Balls are those of the maximum norm: cubes of half width `radius`.
///
/// A leaf is a box that was never split. Periodic faces do not wrap. Cost: O(depth + leaves found)
/// a ball. All throw Error{argument, null} (sizes, strides), {nonfinite}, {support} (naming the
/// ball), {memory}; everything is host memory.

#include <connectivity/base/csr.hpp>
#include <connectivity/tree/tree_input.hpp>

namespace connectivity {

/// Row k [balls.n]: leaves with |ball centre - box centre| <= half width + radius, so touching
/// counts; in depth-first order. A ball may lie outside the root box.
Csr area_query(const TreeView& tree, const ParticleArray& balls, CoordinateType coordinates);

/// Row b [n_boxes]: the balls, ascending, whose area query has leaf b; empty for other boxes.
Csr leaves_to_balls(const TreeView& tree, const ParticleArray& balls, CoordinateType coordinates);

/// [n_boxes]: how far the centres of the balls that touch a leaf are from its centre at most, in
/// the maximum norm and double precision; 0 without such balls and for other boxes.
View<double> space_invader_distances(const TreeView& tree, const ParticleArray& balls,
                                     CoordinateType coordinates);

}  // namespace connectivity
