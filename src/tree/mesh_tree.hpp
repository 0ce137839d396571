// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Makes the arrays of a tree that is given as boxes.

#include <vector>

#include <connectivity/tree/mesh_boxes.hpp>

#include "tree_arrays.hpp"

namespace connectivity::tree_detail {

/// Throws Error{argument, null, box, too_many, memory}.
TreeArrays mesh_tree(const MeshBoxes& mesh);

}  // namespace connectivity::tree_detail
