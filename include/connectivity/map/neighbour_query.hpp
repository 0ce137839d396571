// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Neighbours of one node, of any position, near a box or a plane: without lists.
///
/// Holds a copy of the nodes, ordered in a tree of small groups. Results are ascending slots over
/// all lists, ghosts included; supports count with the largest kernel extent of all lists, as in a
/// map. Safe to ask from several threads at once. Cost: one ordering of the nodes in `update`, then
/// a walk through the tree and some hundred distances a question.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/map/node_list.hpp>
#include <connectivity/search/predicate.hpp>

namespace connectivity {

/// A place that is no node, and how far it sees.
struct QueryPoint {
    std::array<double, 3> x{};
    double h = 0;                 ///< 0: sees nobody
    std::span<const double> H{};  ///< packed tensor [n_symmetric(dim)] instead of h, if not empty
};

/// Candidates for a group of close nodes, in three steps.
struct QueryCandidates {
    std::vector<Slot> master;  ///< the nodes of the tree's group around the place
    std::vector<Slot> coarse;  ///< all that any of them may interact with
    std::vector<Slot> refine;  ///< all that the asked node or place itself may interact with
};

class NeighbourQuery {
public:
    NeighbourQuery();
    ~NeighbourQuery();
    NeighbourQuery(NeighbourQuery&&) noexcept;
    NeighbourQuery& operator=(NeighbourQuery&&) noexcept;

    /// Takes the nodes; lists are read during the call only. Throws as ConnectivityMap::rebuild
    /// does; what was taken before then stays.
    void update(std::span<const NodeList> lists, const Domain& domain = {});

    int dim() const;
    Offset n_slots() const;

    /// Exactly the nodes that the node or place sees (gather), that see it (scatter), or either;
    /// never the node itself, but a node at the same place. Throw Error: not_built before the first
    /// update, argument (slot, or a bad value of the point), half_box.
    std::vector<Slot> neighbours(Slot node, SearchMode mode = SearchMode::gather_scatter) const;
    std::vector<Slot> neighbours(const QueryPoint& point,
                                 SearchMode mode = SearchMode::gather_scatter) const;
    /// How many these are.
    Offset count(Slot node, SearchMode mode = SearchMode::gather_scatter) const;
    Offset count(const QueryPoint& point, SearchMode mode = SearchMode::gather_scatter) const;

    /// The steps on the way there. refine holds all neighbours and the node itself; coarse holds
    /// refine and all neighbours of master.
    QueryCandidates candidates(Slot node, SearchMode mode = SearchMode::gather_scatter) const;
    QueryCandidates candidates(const QueryPoint& point,
                               SearchMode mode = SearchMode::gather_scatter) const;

    /// Nodes inside the closed box (gather), nodes whose support's bounding box meets it (scatter),
    /// or either. On periodic axes images count, and the box is at most half a period wide. Throws
    /// Error{argument} if lo > hi or a value is not finite.
    std::vector<Slot> near_box(std::span<const double> lo, std::span<const double> hi,
                               SearchMode mode = SearchMode::gather) const;

    /// Nodes at most `distance` from a plane, on both sides (gather), nodes whose support reaches
    /// it (scatter), or either. Periodic images do not count. Throws Error{argument} for a normal
    /// that is zero, or values that are not finite.
    std::vector<Slot> near_plane(std::span<const double> point, std::span<const double> normal,
                                 double distance, SearchMode mode = SearchMode::gather) const;

    /// By how many periods the nearest image of node j is shifted on each axis, seen from node i:
    /// x_j + shift * length is the place where i sees j. Whole numbers, 0 on open axes. Throws
    /// Error{argument}.
    std::array<double, 3> periodic_shift(Slot i, Slot j) const;

private:
    struct State;
    template <int Dim>
    struct Tree;
    const State& built() const;
    std::unique_ptr<State> state_;
};

}  // namespace connectivity
