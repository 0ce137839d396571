// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Nodes of a snapshot as sources and targets of a box tree.

#include <span>

#include <connectivity/base/box.hpp>
#include <connectivity/io/lists_input.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity::program {

/// All nodes, ghosts too, lists end to end; at most 64 in a leaf. A periodic domain is the root
/// box, into which nodes are wrapped. Throws Error: box (periodic axes of different lengths, nodes
/// that extend further on an open axis), too_many, memory.
ListsInput particles_of(std::span<const NodeList> nodes, const Domain& domain, int dim);

}  // namespace connectivity::program
