// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Lists that the search does not find by itself: key order, pairs left out, overlap,
/// intersections.
///
/// The search works on labels (labels.hpp): slots, or ranks in key order, for which nodes are
/// gathered by rank. Its lists stay here, pairs are left out, everything else is counted from them
/// and checked against the budget, and only then filled. Invariant: until all of that is done the
/// map's lists are untouched, and what comes then cannot fail. Memory beside the result: the
/// search's own lists, in key order a copy of the nodes.

#include <optional>

#include <connectivity/map/key_order.hpp>
#include <connectivity/map/map_options.hpp>

#include "intersection.hpp"
#include "labels.hpp"
#include "overlap.hpp"
#include "pair_filter.hpp"

namespace connectivity {

/// The lists of a map.
struct MapLists {
    Csr &rows, &half_rows, &overlap, &intersection;
    KeyOrder& key_order;
};

template <int Dim>
struct DerivedRequest {
    std::span<const NodeList> lists;
    const SearchNodes<Dim>& nodes;  ///< by slot
    const SlotLayout& layout;
    const MapOptions& options;
};

template <int Dim>
class DerivedBuild {
public:
    /// Builds what the options ask for; what they do not ask for is cleared. Strong guarantee.
    /// Throws Error: argument (owners), budget, memory. `order` receives the spatial order by slot,
    /// if asked for.
    void run(const DerivedRequest<Dim>& request, Search<Dim>& search, MapLists lists,
             ConstView<Slot>& order, Report& report);

    Offset bytes() const;

private:
    void take_labels(const DerivedRequest<Dim>& request);
    void gather_nodes(const SearchNodes<Dim>& nodes);
    template <class T>
    ConstView<T> in_order(const ConstView<T>& in, int n_components, View<T>& storage) const;
    void search_rows(const DerivedRequest<Dim>& request, const Labels& labels, Search<Dim>& search,
                     Report& report);
    void search_one_sided(const DerivedRequest<Dim>& request, const Labels& labels, bool ordered,
                          Search<Dim>& search, Report& report);
    void leave_out(const PairFilter& filter, const Labels& labels, Csr& list, int n_segments);
    void count_relabelled(const DerivedRequest<Dim>& request, const Labels& labels, MapLists lists);
    void prepare(const DerivedRequest<Dim>& request, const Labels& labels, MapLists lists,
                 Report& report);
    void commit(const DerivedRequest<Dim>& request, const Labels& labels, MapLists lists,
                Report& report);
    void forget(const MapOptions& options);
    ConstView<Slot> as_slots(const Labels& labels);
    void commit_rows(const DerivedRequest<Dim>& request, const Labels& labels, MapLists lists);

    SearchNodes<Dim> nodes_;  // by label
    SlotLayout layout_;       // of labels
    View<Slot> near_order_;   // labels, close ones together
    bool uniform_ = false;    // gather and scatter are the rows
    Csr rows_{"map/derived/rows"}, half_rows_{"map/derived/pairs"};
    Csr gather_{"map/derived/gather"}, scatter_{"map/derived/scatter"}, spare_{"map/derived/spare"};
    View<double> positions_, reach2_, H_;  // by rank
    View<std::uint8_t> active_;            // by rank
    View<Slot> by_list_;                   // [n_slots * n_lists] entries of rows, in key order
    KeyOrder next_order_;
    std::optional<OverlapBuild> overlap_;
    std::optional<IntersectionBuild<Dim>> intersection_;
};

extern template class DerivedBuild<1>;
extern template class DerivedBuild<2>;
extern template class DerivedBuild<3>;

}  // namespace connectivity
