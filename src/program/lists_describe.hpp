// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Words and tables for people about a box tree and its interaction lists.

#include <string>

#include <connectivity/io/lists_input.hpp>
#include <connectivity/lists/traversal.hpp>
#include <connectivity/lists/work.hpp>
#include <connectivity/tree/box_tree.hpp>

namespace connectivity::program {

/// "1000 sources, 900 targets with radii; adaptive, at most 30 in a leaf, ..."
std::string describe_choices(const ListsInput& input);

/// Boxes, levels, particles and bytes.
std::string describe_tree(const BoxTree& tree);

/// One line per list: rows, entries, bytes.
std::string describe_interactions(const FMMTraversalInfo& lists);

/// One line per kind of operation of a fast multipole method.
std::string describe_work(const Work& work);

/// "root box 0.2 ms, boxes 12 ms": the parts of a build that took time.
std::string describe_times(const Report& report);

}  // namespace connectivity::program
