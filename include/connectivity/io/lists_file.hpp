// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Writer of the result of `connectivity lists`: a box tree and its interaction lists in HDF5,
/// under the names that the files of boxtree's answers have, so that two of them compare in one
/// loop.
///
///     tree_*    arrays and scalars of the tree, named as boxtree's Tree names them
///     trav_*    those of its FMMTraversalInfo; trav_fss{i}_* is list 3 of source level i, with
///               _scalars = [count, num_nonempty_lists]; trav_*_images where the tree is periodic
///     merged_neighbor_source_boxes_*   list 1 with the close lists in it, where there are any
///     tc_*, tcall_*, rot_*             translation classes by level and level-free, rotation
///     classes attrs: command, library_version
///
/// Invariants: what does not exist has no key. Box and particle numbers are int32 (starts of a list
/// with 2^31 entries or more int64), levels and flags uint8, single values int64 or float64, floats
/// of the precision of the coordinates. Arrays [dim or 2^dim, aligned_nboxes] are padded.

#include <memory>
#include <string>

#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/traversal.hpp>

namespace connectivity {

class ListsFile {
public:
    /// Opens a temporary file beside `path`. Throws Error{file}.
    explicit ListsFile(const std::string& path);
    ~ListsFile();  ///< removes what was not committed

    /// Each throws Error: file (the disk is full, say), memory.
    void write(const TreeView& tree);
    void write(const FMMTraversalInfo& lists);
    /// What `lists` becomes by merge_close_lists.
    void write_merged(const FMMTraversalInfo& merged);
    void write(const TranslationClassesInfo& by_level, const TranslationClassesInfo& level_free);
    void write(const RotationClassesInfo& classes);

    /// Closes the file and puts it in its place. Throws Error{file}.
    void commit(const std::string& command);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace connectivity
