// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Who interacts with whom, over node lists: sorted rows, the list of unique pairs, overlap,
/// intersections, an order that does not depend on storage; each only if asked for.
///
/// Invariants: a row is ascending, never names its own node, and j is in row(i) iff i is in row(j)
/// where both are stored; every pair has at least one stored row and stands once. Results are the
/// same bits for any number of threads, any search method and any instruction set. A rebuild or
/// patch that throws leaves everything as it was. Cost: O(N) time for bounded neighbour numbers;
/// rows 4 bytes an entry + 8 per node and list, pairs 4 bytes each + 8 per node; storage is kept
/// from rebuild to rebuild.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <connectivity/base/report.hpp>
#include <connectivity/map/key_order.hpp>
#include <connectivity/map/map_options.hpp>
#include <connectivity/map/node_list.hpp>
#include <connectivity/map/node_pair_list.hpp>
#include <connectivity/map/node_traversal.hpp>
#include <connectivity/map/rows.hpp>

namespace connectivity {

class PairFieldBase;

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

    /// Drops and renumbers nodes, as after culling ghosts: every list becomes what a rebuild on the
    /// nodes that stay would give, without a search; the generation goes on. keep [n_slots] is 0
    /// or 1; old2new [n_slots] has the new node id within the list, of no meaning where keep is 0:
    /// in each list a permutation of those that stay, internal nodes first. Coupling and the
    /// fields handed over keep the values of surviving pairs; fields must belong to the present
    /// pair list, and all others go stale.
    ///
    /// Three differences to a rebuild: overlap forgets dropped nodes but not what they witnessed,
    /// key order keeps the keys of the last rebuild, and where pairs change their orientation a
    /// node whose foot is just on the end of a segment stays in, or out of, its intersection. With
    /// a skin the next needs_rebuild is true. Throws Error: not_built, argument (list, node,
    /// value), stale, memory; the map and the fields are then as before.
    void patch(std::span<const Slot> keep, std::span<const Slot> old2new,
               std::span<PairFieldBase* const> fields = {});

    /// Leaves pairs out of rows and pairs, as if MapOptions::exclude had been set. Throws
    /// Error{argument} where overlap or intersections were built, which would go wrong; otherwise
    /// as `patch`.
    void remove_pairs(const PairPredicate& leave_out, std::span<PairFieldBase* const> fields = {});

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
    /// worker < n_workers() numbers them, for private accumulators. options.rows, pairs, order,
    /// spatial_order and budget do not count here: rows ascend by slot. f must not launch kernels;
    /// rebuild, traversals, drift and needs_rebuild of this map throw Error{callback} there.
    ///
    /// No rebuild: lists, views, generation, drift and options stay those of the last one; the
    /// report gains an entry "traversal". Throws as `rebuild` does, and the first exception that f
    /// throws, which ends the traversal early. Takes no memory for lists; order and scratch memory
    /// of the search are kept and shared with rebuilds.
    void for_each_row(std::span<const NodeList> lists, const MapOptions& options, RowFunction f);

    /// The same with half rows: each slot exactly once with its partners after it, as in pairs() in
    /// slot order. So every pair comes once. Throws Error{argument} for gather and scatter.
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

    /// Rows of all nodes, laid out as rows(): the nodes that see a common node with it, each node
    /// being in its own sight. So a row holds all neighbours, too. Witnesses are nodes, also
    /// ghosts: supports that overlap where no node is do not count.
    RowsView<> overlap() const;

    /// By pair: the common neighbours of the two and both themselves, ascending (key order: by
    /// rank). With IntersectionKind::in_segment those whose perpendicular foot on the line between
    /// the two lies outside the closed segment are left out.
    IntersectionView<> intersection() const;

    /// Common neighbours of any two nodes and both themselves, ascending slots. With `lists` those
    /// of the last rebuild, in_segment only. Throws Error{not_built} without rows, Error{argument}
    /// for a slot that has none.
    std::vector<Slot> common_neighbours(Slot a, Slot b) const;
    std::vector<Slot> common_neighbours(Slot a, Slot b, std::span<const NodeList> lists) const;
    /// Neighbours of a or b, ascending slots. Throws as common_neighbours.
    std::vector<Slot> all_neighbours(Slot a, Slot b) const;

    /// Throws Error{not_built} unless the last rebuild had ListOrder::key.
    KeyOrderView<> key_order() const;

    /// Node ids of a list in the order in force: internal nodes ascending, in key order all nodes
    /// by rank. Throws Error{argument} for a list that is none.
    NodeTraversal traversal(int list) const;

    /// Slots in an order that keeps neighbours close in memory, [n_slots]: a permutation. A host
    /// that reorders its nodes by it (list by list, see below) makes its own loops and later builds
    /// faster. Throws Error{not_built} unless MapOptions::spatial_order was set.
    ConstView<Slot> spatial_order() const;

    /// The same for one list: node ids, internal ones first, then ghosts; a permutation of [0, n).
    /// Throws Error{not_built}, Error{argument} for a list that is none.
    View<Slot> spatial_order(int list) const;

    /// Since the last rebuild: were nodes dropped or renumbered, were pairs removed?
    bool is_patched() const { return patched_; }
    bool has_removed_pairs() const { return removed_pairs_; }

    const Report& report() const { return report_; }

private:
    template <class Body>
    void launch(const char* what, const Body& body) const;
    template <int Dim>
    void rebuild_in(std::span<const NodeList> lists, const MapOptions& options);
    template <int Dim>
    void search_in(std::span<const NodeList> lists, const MapOptions& options,
                   const SlotLayout& layout, ConstView<Slot>& order, Report& report);
    static void announce_derived(const MapOptions& options, Report& report);
    void report_bytes();
    void publish_pairs();
    void check_list(const char* call, int list) const;
    std::span<const Slot> row_of(const char* call, Slot slot) const;
    std::vector<Slot> combined(const char* call, Slot a, Slot b, bool all) const;
    void require_fields(const char* call, std::span<PairFieldBase* const> fields) const;
    void finish_patch(std::span<PairFieldBase* const> fields, double ms);
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
    bool traversing_ = false, patched_ = false, removed_pairs_ = false;
    SlotLayout layout_;
    std::vector<std::string> list_names_;
    std::vector<Offset> n_internal_;
    int dim_ = 0;
    MapOptions options_;
    Csr rows_{"map/rows"}, overlap_{"map/overlap"}, intersection_{"map/intersection"};
    NodePairList pairs_;
    KeyOrder key_order_;
    ConstView<Slot> order_;   // spatial order
    Offset order_bytes_ = 0;  // of the search's own
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
