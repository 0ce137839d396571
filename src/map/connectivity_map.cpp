// SPDX-License-Identifier: BSD-3-Clause
#include "map_impl.hpp"

namespace connectivity {

ConnectivityMap::ConnectivityMap() : impl_(std::make_unique<Impl>()) {}
ConnectivityMap::~ConnectivityMap() = default;
ConnectivityMap::ConnectivityMap(ConnectivityMap&&) noexcept = default;
ConnectivityMap& ConnectivityMap::operator=(ConnectivityMap&&) noexcept = default;

void ConnectivityMap::rebuild(std::span<const NodeList> lists, const MapOptions& options) {
    check_request("rebuild", lists, options);
    launch("rebuild", [&] {
        switch (lists[0].dim()) {
            case 1: return rebuild_in<1>(lists, options);
            case 2: return rebuild_in<2>(lists, options);
            default: return rebuild_in<3>(lists, options);
        }
    });
}

template <int Dim>
void ConnectivityMap::rebuild_in(std::span<const NodeList> lists, const MapOptions& options) {
    const shim::ProfilingRegion region("map/rebuild");
    Report report;
    SlotLayout layout = layout_of(lists, options);
    MapOptions kept = options;
    kept.active = {};  // the layout has a copy
    std::vector<std::string> names;
    std::vector<Offset> n_internal;
    for (const NodeList& list : lists)
        names.push_back(list.name()), n_internal.push_back(list.n_internal());
    announce_derived(options, report);
    ConstView<Slot> order;
    search_in<Dim>(lists, options, layout, order, report);

    const bool patched_before = patched_ || removed_pairs_;
    // Nothing below can fail: this is where the new lists become the map's.
    layout_ = std::move(layout);
    list_names_.swap(names);
    n_internal_.swap(n_internal);
    impl_->keep_only<Dim>(options.is_derived());
    dim_ = Dim;
    patched_ = removed_pairs_ = false;
    std::swap(options_, kept);
    order_ = order;
    keep_reference(lists, report);
    if (!patched_before) impl_->patch.reset();
    std::swap(report_, report);
    order_bytes_ = report_.entry("order").bytes;
    ++generation_;
    publish_pairs();
    pairs_.start_generation(generation_, options.wants_pairs());
    report_bytes();
}

/// Finds the lists; everything that can fail.
template <int Dim>
void ConnectivityMap::search_in(std::span<const NodeList> lists, const MapOptions& options,
                                const SlotLayout& layout, ConstView<Slot>& order, Report& report) {
    const Stopwatch preparing;
    const SearchNodes<Dim> nodes =
        prepare_nodes<Dim>(lists, options.domain, impl_->storage, options.skin);
    report.entry("nodes") = {
        "nodes",
        "search",
        lists.size() == 1 ? "checked where they lie" : "checked and laid end to end",
        true,
        false,
        impl_->storage.bytes(),
        preparing.ms()};
    auto& search = impl_->search<Dim>();
    reserve_reference(lists, options, report);
    if (options.is_derived())
        return impl_->derived<Dim>().run(
            {lists, nodes, layout, options}, search,
            {rows_, pairs_.half_rows_, overlap_, intersection_, key_order_}, order, report);
    if (options.spatial_order) order = search.spatial_order(nodes, report);
    search.run(nodes, layout,
               {options.rows, options.pairs, options.mode, options.method, options.budget,
                options.spatial_order},
               rows_, pairs_.half_rows_, report);
    overlap_.clear(), intersection_.clear(), key_order_.clear();
}

/// What the pair list shows of the order it is in.
void ConnectivityMap::publish_pairs() {
    if (!options_.wants_pairs()) pairs_.first_ = {};
    const bool by_key = options_.order == ListOrder::key;
    const KeyOrderView<> order = by_key ? key_order_.view() : KeyOrderView<>();
    pairs_.slots_ = order.slots;
    pairs_.ranks_ = order.ranks;
}

}  // namespace connectivity
