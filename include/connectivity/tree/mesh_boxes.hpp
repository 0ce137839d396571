// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A box tree given as boxes, without particles: the cells of a mesh.
///
/// Its view has no particles; in its place every leaf is flagged as owning sources and targets, and
/// every other box as having some below, so that interaction lists of all its boxes can be made.

#include <connectivity/tree/tree_input.hpp>

namespace connectivity {

/// Boxes numbered level by level, the root first; which children a box has. Either `child_ids` or
/// both others; all host arrays, read during the call.
struct MeshBoxes {
    int dim = 3;
    Offset n_boxes = 0;
    std::array<double, 3> lo{};  ///< low corner of the root
    double root_extent = 1;      ///< its side
    std::array<bool, 3> periodic{};
    const BoxId* child_ids = nullptr;             ///< [2^dim][child_stride]; 0: no such child
    Offset child_stride = 0;                      ///< >= n_boxes
    const BoxId* parent_ids = nullptr;            ///< [n_boxes]; any value for the root
    const std::uint8_t* child_numbers = nullptr;  ///< [n_boxes]: which child of its parent a box is
};

}  // namespace connectivity
