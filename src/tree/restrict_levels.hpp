// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Splits leaves of level 1 and deeper until leaves that touch (face, edge, corner; across periodic
/// faces, too) differ by one level at most. The smallest such tree, empty leaves counted in.
///
/// New boxes stand at the end of their level: in the order in which a level-by-level construction
/// would force them (which is boxtree's), parents ascending.

#include "frame.hpp"
#include "raw_boxes.hpp"

namespace connectivity::tree_detail {

/// `raw` has all children of split boxes, empty ones too. Throws Error{too_many}.
template <class Real, int Dim>
void restrict_levels(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
                     const std::array<bool, 3>& periodic, Offset max_boxes, RawTree& raw);

}  // namespace connectivity::tree_detail
