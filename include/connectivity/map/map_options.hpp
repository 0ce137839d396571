// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a map is to build. Nothing is built that is not asked for here.

#include <functional>
#include <memory>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/search/search.hpp>

namespace connectivity {

/// The order of rows, pairs and traversals.
enum class ListOrder {
    slot,  ///< ascending (list, node)
    key    ///< ascending (Morton key, position, list, global id): does not depend on how nodes are
           ///< stored, nor on which of them are ghosts
};

/// Common neighbours of the two nodes of every pair.
enum class IntersectionKind {
    none,
    all,        ///< all of them
    in_segment  ///< those whose perpendicular foot on the line between the two lies between them
};

/// true: the pair of these slots is left out. Called with i < j from several threads at once, more
/// than once for a pair: it must answer the same each time. If it throws, the call that asked it
/// throws the same, of several threads the first one's, but Error{memory} for std::bad_alloc; all
/// lists, orders and the generation stay as they were.
using PairPredicate = std::function<bool(Slot i, Slot j)>;

struct MapOptions {
    bool rows = true;
    bool pairs = true;
    bool ghost_rows = false;  ///< rows for ghosts too, and pairs between ghosts
    bool overlap = false;     ///< nodes that see a common node, see ConnectivityMap::overlap
    IntersectionKind intersection = IntersectionKind::none;  ///< implies pairs
    ListOrder order = ListOrder::slot;
    SearchMode mode = SearchMode::gather_scatter;  ///< pairs exist only for gather_scatter
    SearchMethod method = SearchMethod::automatic;
    bool spatial_order =
        false;      ///< keep spatial_order() available (free where the search sorts nodes anyway)
    Domain domain;  ///< open on all axes unless told
    Budget budget;
    /// Length by which all supports are widened, so that the lists stay complete while nodes drift
    /// and supports grow by no more than it: 0, or in [1e-100, 1e100]. Rows and pairs then hold
    /// every neighbour and some nodes close to it; the host's kernel, or a test of the distance,
    /// sorts these out. h = 0 reaches as far as the skin. The widened support, too, must fit half a
    /// periodic box, and tensors must have a condition number below 7e12.
    double skin = 0;
    /// Which lists see each other: [n_lists * n_lists] symmetric, 0 or 1; empty: all.
    std::vector<std::uint8_t> interactions;
    /// Pairs to be left out of everything; none if null.
    std::shared_ptr<const PairPredicate> exclude;
    /// [n_slots], 0 or 1: only active nodes have neighbours in their rows, and every pair has an
    /// active node; empty: all are active. Read during the call. Rows keep their numbers.
    ConstView<std::uint8_t> active;

    /// Overlap, intersections and key order need the rows of all nodes.
    bool stores_all_rows() const {
        return ghost_rows || overlap || intersection != IntersectionKind::none ||
               order == ListOrder::key;
    }
    friend bool operator==(const MapOptions&, const MapOptions&) = default;

    bool wants_pairs() const { return pairs || intersection != IntersectionKind::none; }
    /// Lists are not those that the search finds, but made from them.
    bool is_derived() const {
        return overlap || intersection != IntersectionKind::none || order == ListOrder::key ||
               !interactions.empty() || exclude != nullptr;
    }
};

}  // namespace connectivity
