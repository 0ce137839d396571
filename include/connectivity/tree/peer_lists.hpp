// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Peers of a box: the smallest boxes, none smaller than itself, that touch or hold it and together
/// cover what lies around it.

#include <connectivity/base/csr.hpp>
#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// Row b [n_boxes] lists the boxes k that touch b (closed cubes; b itself does), are not smaller
/// than b and have no child with both properties; depth-first order. The root's peer is the root.
/// Exact at any depth: touching is told by child numbers. Periodic faces do not touch. Host.
/// Method: Rachh, Klöckner, O'Neil, J. Comput. Phys. 345 (2017), peer lists. Throws Error{memory}.
Csr peer_lists(const TreeView& tree);

}  // namespace connectivity
