// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Brings particles into tree order, sources apart from targets, and says where each box has its
/// own of either kind.

#include "number_boxes.hpp"
#include "particles.hpp"

namespace connectivity::tree_detail {

/// Fills positions, radii, ids, the boxes' slices and the flags of own particles. `rank` [n + 1] is
/// scratch memory; not needed where sources are targets.
template <class Real, int Dim>
void sort_particles(const Particles<Real, Dim>& particles, const RawTree& raw,
                    const BoxNumbers& numbers, std::int32_t* rank, TreeArrays& arrays);

}  // namespace connectivity::tree_detail
