// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// FMMTraversalInfo: who interacts with whom in a fast multipole method, box by box.
///
/// Words. Two boxes touch if their closures meet (so do a box and what is below it, and itself).
/// Boxes of one level, different ones, are near if at most n = well_sep_is_n_away boxes apart in
/// the maximum norm. A box's own particles are those not handed to a child. Far enough: see
/// traversal_options.hpp.
///
///   list    of box T ...        ... the boxes S                                       method
///   nws     any                 near T                                                (none)
///   1       with own targets    with own sources, touching T, any level               direct
///   2       with targets below  of T's level, not near T, parents near                M2L
///   3       with own targets    below a box near T or T itself, not touching, far     M2P
///                               enough from T's targets, parent not so
///   3 close with own targets    the same, not far enough; own sources only            direct
///   4       with targets below  with own sources, as large as T or larger, near an    P2L
///                               ancestor of T (or T), not touching T and far enough,
///                               which does not hold for T's parent
///   4 close with own targets    the same, not far enough                              direct
///
/// Theorem (coverage): for every box T with own targets and every S with own sources exactly one of
/// these holds: S is in list 1, 3 close or 4 close of T; S or one ancestor is in list 3 of T; S is
/// in list 4 of T or of one ancestor; one pair of (T or an ancestor, S or an ancestor) is in list
/// 2. So every target meets every source exactly once.
///
/// Periodic trees: the sources are those of the root box and of its images next to it, shifted by
/// -1, 0 or 1 root extents along each periodic axis; the images of the root are near the root.
/// Every entry says in which image it lies, and the theorem holds for every pair of T and (S,
/// image): each target meets each of these 3^p images of each source exactly once, its own nearest
/// one (minimum image) among them. What is farther is a lattice sum of the root's expansions and
/// the host's.
///
/// Rows are in depth-first order of the tree, children in the order of their numbers, images in
/// that of their codes; rows of list 4 and 4 close by level first, the deepest before. Decisions on
/// the grid are made by integers and hold at any depth; decisions about extents are made once, a
/// child inherits what its parent left.
///
/// Cost: time and memory are those of the entries, and 12 bytes for each entry of nws rows as
/// scratch, so that a rebuild allocates nothing unless lists grow or are held elsewhere. Source:
/// boxtree, https://documen.tician.de/boxtree/traversal.html; Carrier, Greengard, Rokhlin, SIAM J.
/// Sci. Stat. Comput. 9 (1988) 669.

#include <memory>
#include <optional>

#include <connectivity/base/report.hpp>
#include <connectivity/lists/box_list.hpp>
#include <connectivity/lists/traversal_options.hpp>

namespace connectivity {

namespace detail {
struct TraversalState;
}

/// Accessors have the names of boxtree's attributes X_starts and X_lists, without the ending. What
/// the tree cannot have is none; what was not asked for is Error{not_built}.
class FMMTraversalInfo {
public:
    FMMTraversalInfo();
    explicit FMMTraversalInfo(const TreeView& tree, const TraversalOptions& options = {});
    /// Copies share the lists, and have no scratch; a rebuild of one leaves the other as it is.
    FMMTraversalInfo(const FMMTraversalInfo& other);
    FMMTraversalInfo(FMMTraversalInfo&& other) noexcept;
    FMMTraversalInfo& operator=(FMMTraversalInfo other) noexcept;
    ~FMMTraversalInfo();

    /// Builds the lists of another tree. If it throws, the old ones stay. Throws
    /// Error: argument (options, arrays of the tree that contradict each other), null (arrays the
    /// lists need and the tree lacks), unsupported (n too large for a deep tree), budget, memory.
    void rebuild(const TreeView& tree, const TraversalOptions& options = {});

    const TreeView& tree() const;
    Offset nboxes() const { return tree().n_boxes; }
    int nlevels() const { return tree().n_levels; }
    int well_sep_is_n_away() const;
    const Budget& budget() const;  ///< of the options

    /// Boxes, ascending, and [nlevels + 1] places in them where each level begins.
    ConstView<BoxId> source_boxes() const;         ///< with own sources
    ConstView<BoxId> target_boxes() const;         ///< with own targets
    ConstView<BoxId> source_parent_boxes() const;  ///< with sources below
    ConstView<BoxId> target_or_target_parent_boxes() const;
    ConstView<Offset> level_start_source_box_nrs() const;
    ConstView<Offset> level_start_target_box_nrs() const;
    ConstView<Offset> level_start_source_parent_box_nrs() const;
    ConstView<Offset> level_start_target_or_target_parent_box_nrs() const;
    Offset ntarget_boxes() const;
    Offset ntarget_or_target_parent_boxes() const;

    /// Hulls of the particles below each box, [dim][aligned_n_boxes]; none where particles of the
    /// kind have no radii (the tree has the hulls of points).
    std::optional<ConstView<double>> box_source_bounding_box_min() const;
    std::optional<ConstView<double>> box_source_bounding_box_max() const;
    std::optional<ConstView<double>> box_target_bounding_box_min() const;
    std::optional<ConstView<double>> box_target_bounding_box_max() const;

    BoxList same_level_non_well_sep_boxes() const;  ///< base: all boxes
    std::optional<BoxList> colleagues() const;      ///< the same; none unless n = 1
    BoxList neighbor_source_boxes() const;          ///< list 1; base: target_boxes
    BoxList from_sep_siblings() const;              ///< list 2; base: target_or_target_parent_boxes
    LevelBoxList from_sep_smaller(int source_level) const;  ///< list 3, from_sep_smaller_by_level
    std::optional<BoxList> from_sep_close_smaller() const;  ///< 3 close; base: target_boxes
    BoxList from_sep_bigger() const;  ///< list 4; base: target_or_target_parent_boxes
    std::optional<BoxList> from_sep_close_bigger() const;  ///< 4 close; base: target_boxes

    /// Whether the list was asked for.
    bool has_same_level_non_well_sep_boxes() const;
    bool has_neighbor_source_boxes() const;
    bool has_from_sep_siblings() const;
    bool has_from_sep_smaller() const;
    bool has_from_sep_bigger() const;

    /// A copy on the host, which is where the lists are: it shares them.
    FMMTraversalInfo get() const { return *this; }

    /// The same with rows of list 1, 3 close and 4 close joined in this order to list 1, and no
    /// close lists; an unchanged copy where there are none. Throws Error{not_built} unless list 1
    /// was asked for, Error: budget, memory.
    FMMTraversalInfo merge_close_lists() const;

    /// What each list costs: bytes, and the time of the phase that made it.
    const Report& report() const;

    Offset scratch_bytes() const;  ///< kept for the next rebuild
    void release_scratch();        ///< gives that back

private:
    std::unique_ptr<detail::TraversalState> state_;
};

}  // namespace connectivity
