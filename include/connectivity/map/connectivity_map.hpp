// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Who interacts with whom, over node lists: sorted rows and the list of unique pairs, each only if
/// asked for.
///
/// Invariants: a row is ascending, never names its own node, and j is in row(i) iff i is in row(j)
/// where both are stored; every pair has at least one stored row and stands once. Results are the
/// same bits for any number of threads, any search method and any instruction set. A rebuild that
/// throws leaves everything as it was. Cost: O(N) time for bounded neighbour numbers; rows 4 bytes
/// an entry + 8 per node and list, pairs 4 bytes each + 8 per node; storage is kept
/// from rebuild to rebuild.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/base/report.hpp>
#include <connectivity/map/node_list.hpp>
#include <connectivity/map/node_pair_list.hpp>
#include <connectivity/map/rows.hpp>
#include <connectivity/search/search.hpp>

namespace connectivity {

struct MapOptions {
    bool rows = true;
    bool pairs = true;
    bool ghost_rows = false;  ///< rows for ghosts too, and pairs between ghosts
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

    friend bool operator==(const MapOptions&, const MapOptions&) = default;
};

/// Whether a skin pays: over the life of a map.
struct ReuseCounts {
    std::int64_t rebuilds = 0;
    std::int64_t reuses = 0;  ///< needs_rebuild said false
    double max_drift = 0;     ///< of the states for which it did
};

class ConnectivityMap {
public:
    ConnectivityMap();
    ~ConnectivityMap();
    ConnectivityMap(ConnectivityMap&&) noexcept;  ///< what was moved from may only be assigned to
    ConnectivityMap& operator=(ConnectivityMap&&) noexcept;

    /// Finds all neighbours anew. `lists` (at least one, all of one dimension) are read during the
    /// call only. Throws Error: argument (no list, dimensions differ, pairs with gather or
    /// scatter, skin out of range), nonfinite / support / not_spd (list, node, value), box,
    /// half_box, too_many, budget, memory; the map is then as it was before.
    void rebuild(std::span<const NodeList> lists, const MapOptions& options);

    /// How far `lists` are from those of the last rebuild: twice the largest displacement plus the
    /// largest growth of a support radius (of an ellipsoid that left the old one: the largest
    /// growth or shrinkage along any direction). 0 if nothing changed. Infinite if that rebuild had
    /// no skin, if there was none, if the number of lists, their sizes, internal nodes, extents or
    /// kind of support changed, or if a value is bad. While drift <= skin no neighbour is missing
    /// from the lists. Domain and modes are those of the last rebuild. Takes 1 to 2 % of the time
    /// of a rebuild for scalar h.
    double drift(std::span<const NodeList> lists) const;

    /// Whether the lists may miss a neighbour: drift > skin; always without skin. Where it says
    /// false, the host goes on with the lists it has; it is counted. Never throws for bad values:
    /// the rebuild it asks for does. `drift`, if given, receives the drift.
    bool needs_rebuild(std::span<const NodeList> lists, double* drift = nullptr);

    /// Storage-free traversal: f(worker, slot, neighbours) gets what a rebuild with these lists and
    /// options would put in rows, and nothing is stored. `neighbours`, a std::span<const Slot>
    /// valid during the call, are ascending slots, lists one after the other. Each stored node
    /// comes exactly once, also without neighbours, in any order, from several threads at once;
    /// worker < n_workers() numbers them, for private accumulators. options.rows, pairs,
    /// spatial_order and budget do not count here. f must not launch kernels; rebuild,
    /// traversals, drift and needs_rebuild of this map throw Error{callback} there.
    ///
    /// No rebuild: lists, views, generation, drift and options stay those of the last one; the
    /// report gains an entry "traversal". Throws as `rebuild` does, and the first exception that f
    /// throws, which ends the traversal early. Takes no memory for lists; order and scratch memory
    /// of the search are kept and shared with rebuilds.
    void for_each_row(std::span<const NodeList> lists, const MapOptions& options, RowFunction f);

    /// The same with half rows: each slot exactly once with its partners after it, as in pairs().
    /// So every pair comes once. Throws Error{argument} for gather and scatter.
    void for_each_half_row(std::span<const NodeList> lists, const MapOptions& options,
                           RowFunction f);

    const ReuseCounts& reuse() const { return reuse_; }

    Generation generation() const { return generation_; }  ///< 0 before the first rebuild
    const SlotLayout& layout() const { return layout_; }
    const std::vector<std::string>& list_names() const { return list_names_; }
    const std::vector<Offset>& n_internal() const { return n_internal_; }  ///< [n_lists]
    int dim() const { return dim_; }
    const MapOptions& options() const { return options_; }

    /// Throw Error{not_built} if the last rebuild was not asked for them. Views hold their storage:
    /// they stay valid and unchanged through later rebuilds.
    RowsView<> rows() const;
    const NodePairList& pairs() const;
    NodePairList& pairs();

    /// Slots in an order that keeps neighbours close in memory, [n_slots]: a permutation. A host
    /// that reorders its nodes by it (list by list, see below) makes its own loops and later builds
    /// faster. Throws Error{not_built} unless MapOptions::spatial_order was set.
    ConstView<Slot> spatial_order() const;

    /// The same for one list: node ids, internal ones first, then ghosts; a permutation of [0, n).
    /// Throws Error{not_built}, Error{argument} for a list that is none.
    View<Slot> spatial_order(int list) const;

    const Report& report() const { return report_; }

private:
    template <class Body>
    void launch(const char* what, const Body& body) const;
    template <int Dim>
    void rebuild_in(std::span<const NodeList> lists, const MapOptions& options);
    void traverse(const char* call, std::span<const NodeList> lists, const MapOptions& options,
                  RowFunction f);
    template <int Dim>
    void traverse_in(std::span<const NodeList> lists, const MapOptions& options, RowFunction f);
    void reserve_reference(std::span<const NodeList> lists, const MapOptions& options,
                           Report& report);
    void keep_reference(std::span<const NodeList> lists, Report& report);
    void count_reuse(Report& report) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
    Generation generation_ = 0;
    bool traversing_ = false;
    SlotLayout layout_;
    std::vector<std::string> list_names_;
    std::vector<Offset> n_internal_;
    int dim_ = 0;
    MapOptions options_;
    Csr rows_{"map/rows"};
    NodePairList pairs_;
    ConstView<Slot> order_;
    Report report_;
    ReuseCounts reuse_;
};

/// Reorders a host's field of n_components values a node: out[k] = in[order[k]]. `in` and `out`
/// must not overlap.
template <class T>
void reorder_field(ConstView<Slot> order, const T* in, T* out, int n_components = 1) {
    const Slot* const from = order.data();
    Kokkos::parallel_for("map/reorder_field",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, order.size()),
                         [=](const Offset k) {
                             for (int c = 0; c < n_components; ++c)
                                 out[k * n_components + c] =
                                     in[static_cast<Offset>(from[k]) * n_components + c];
                         });
    HostExec().fence();
}

}  // namespace connectivity
