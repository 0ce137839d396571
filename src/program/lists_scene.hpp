// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a picture of the interaction lists of one box shows: which boxes, where, in which list.
///
/// Invariant: the sources of the entries (all sources below a box of list 2 or 3, its own ones in
/// the others), ancestors' lists included, are all sources of the tree, each once.

#include <array>
#include <vector>

#include <connectivity/lists/traversal.hpp>

namespace connectivity::program {

/// How sources of a box reach the targets of the chosen one.
enum class ListRole {
    siblings_of_ancestor,  ///< list 2 of an ancestor
    bigger_of_ancestor,    ///< list 4 of an ancestor
    siblings,              ///< list 2
    smaller,               ///< list 3
    bigger,                ///< list 4
    neighbor,              ///< list 1
    close_smaller,         ///< list 3 close
    close_bigger,          ///< list 4 close
};
constexpr int n_list_roles = 8;

struct ListedBox {
    ListRole role{};
    BoxId box = 0;
    std::array<double, 3> center{};  ///< in the image of the entry
    double half_width = 0;
    bool is_split = false;
};

struct ListsScene {
    TreeView tree;
    BoxId box = 0;  ///< the chosen one
    int well_sep_is_n_away = 1;
    std::vector<ListedBox> listed;  ///< in the order of ListRole
    std::array<Offset, n_list_roles> counts{};
    std::array<bool, n_list_roles> exists{};  ///< false: the tree has no such list
};

/// The target box that has entries in most of its lists 1 to 4 and close, of those the one with the
/// most entries, of those the first. Throws Error{argument} if no box has targets.
BoxId telling_target_box(const FMMTraversalInfo& lists);

/// Throws Error{argument} if there is no such box, or no targets are in or below it.
ListsScene lists_scene(const FMMTraversalInfo& lists, BoxId box);

}  // namespace connectivity::program
