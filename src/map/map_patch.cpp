// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/pair_field_base.hpp>

#include "map_impl.hpp"

namespace connectivity {

namespace {

BuiltLists built_lists(const MapOptions& options) {
    return {options.rows, options.wants_pairs(), options.overlap,
            options.intersection != IntersectionKind::none, options.order == ListOrder::key};
}

/// The first step of all fields, or of none.
void prepare_fields(std::span<PairFieldBase* const> fields, PairCoupling& coupling,
                    const ConstView<Offset>& new_to_old) {
    try {
        if (coupling.exists()) coupling.prepare_remap(new_to_old);
        for (PairFieldBase* field : fields) field->prepare_remap(new_to_old);
    } catch (...) {
        coupling.abandon_remap();
        for (PairFieldBase* field : fields) field->abandon_remap();
        throw;
    }
}

/// Slots in an order, after a renumbering.
ConstView<Slot> renumbered(const ConstView<Slot>& order, const Renumbering& now) {
    if (order.size() == 0) return {};
    const auto out = allocate<Slot>("map/spatial_order", now.layout.n_slots());
    Offset at = 0;
    for (std::size_t k = 0; k < order.size(); ++k)
        if (const Slot slot = now.new_slot(order(k)); slot >= 0) out(at++) = slot;
    return out;
}

}  // namespace

void ConnectivityMap::require_fields(const char* call,
                                     std::span<PairFieldBase* const> fields) const {
    if (generation_ == 0)
        throw Error(Status::not_built, std::string(call) + ": the map was never rebuilt");
    for (std::size_t k = 0; k < fields.size(); ++k) {
        if (fields[k] == nullptr)
            throw Error(Status::null,
                        std::string(call) + ": fields[" + std::to_string(k) + "] is null");
        fields[k]->require_current(pairs());
    }
}

void ConnectivityMap::patch(std::span<const Slot> keep, std::span<const Slot> old2new,
                            std::span<PairFieldBase* const> fields) {
    require_fields("patch", fields);
    launch("patch", [&] {
        const shim::ProfilingRegion region("map/patch");
        const Stopwatch watch;
        Report report = report_;
        report.entry("patch") = {
            "patch", "caller", "the lists before, kept for the next patch", true, false, 0, 0};
        Renumbering now = read_renumbering(
            {layout_, n_internal_, list_names_, options_.stores_all_rows()}, keep, old2new);
        const MapLists lists{rows_, pairs_.half_rows_, overlap_, intersection_, key_order_};
        ConstView<Slot> order = renumbered(order_, now);
        impl_->patches().prepare_nodes(now, layout_, lists, built_lists(options_));
        if (options_.wants_pairs())
            prepare_fields(fields, pairs_.coupling_, impl_->patch->new_to_old());
        layout_ = std::move(now.layout);
        n_internal_.swap(now.n_internal);
        order_ = order;
        impl_->reference.clear();
        patched_ = true;
        std::swap(report_, report);
        finish_patch(fields, watch.ms());
    });
}

void ConnectivityMap::remove_pairs(const PairPredicate& leave_out,
                                   std::span<PairFieldBase* const> fields) {
    require_fields("remove_pairs", fields);
    if (!leave_out) throw Error(Status::argument, "remove_pairs: the predicate is empty");
    if (options_.overlap || options_.intersection != IntersectionKind::none)
        throw Error(Status::argument,
                    "remove_pairs: overlap or intersections were built from these pairs; set "
                    "MapOptions::exclude and rebuild");
    launch("remove_pairs", [&] {
        const shim::ProfilingRegion region("map/remove_pairs");
        const Stopwatch watch;
        Report report = report_;
        report.entry("patch") = {
            "patch", "caller", "the lists before, kept for the next patch", true, false, 0, 0};
        MapOptions filter_options;
        filter_options.exclude = std::make_shared<const PairPredicate>(leave_out);
        const PairFilter filter(layout_, filter_options);
        const MapLists lists{rows_, pairs_.half_rows_, overlap_, intersection_, key_order_};
        impl_->patches().prepare_pairs(filter, layout_, lists, built_lists(options_));
        if (options_.wants_pairs())
            prepare_fields(fields, pairs_.coupling_, impl_->patch->new_to_old());
        removed_pairs_ = true;
        std::swap(report_, report);
        finish_patch(fields, watch.ms());
    });
}

/// Cannot fail.
void ConnectivityMap::finish_patch(std::span<PairFieldBase* const> fields, double ms) {
    impl_->patch->commit({rows_, pairs_.half_rows_, overlap_, intersection_, key_order_},
                         built_lists(options_));
    ++generation_;
    publish_pairs();
    if (options_.wants_pairs())
        pairs_.continue_generation(generation_);
    else
        pairs_.start_generation(generation_, false);
    for (PairFieldBase* field : fields) field->commit_remap(pairs_.stamp());
    report_.entry("patch").ms = ms;
    report_bytes();
}

}  // namespace connectivity
