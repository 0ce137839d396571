// SPDX-License-Identifier: BSD-3-Clause
#include "map_impl.hpp"

namespace connectivity {

namespace {

const char* reason_for_derived(const MapOptions& options) {
    if (options.order == ListOrder::key) return "lists by rank, before they get slots";
    if (options.overlap) return "who is seen by a node, and who sees it";
    if (options.intersection != IntersectionKind::none) return "rows of all nodes";
    return "lists before pairs are left out";
}

}  // namespace

/// Entries are made before the work: nothing may fail once the new lists are out.
void ConnectivityMap::announce_derived(const MapOptions& options, Report& report) {
    const auto announce = [&report](const char* product, bool asked, const char* reason) {
        report.entry(product) = {
            product, asked ? "caller" : "", asked ? reason : "", asked, false, 0, 0};
    };
    for (const char* made_by_search : {"nodes", "order", "rows", "pairs"})
        report.entry(made_by_search);
    announce("key_order", options.order == ListOrder::key, "Morton keys and ranks");
    announce("overlap", options.overlap, "union of the rows of all that a node sees");
    announce("intersection", options.intersection != IntersectionKind::none,
             options.intersection == IntersectionKind::in_segment
                 ? "common neighbours between the two"
                 : "all common neighbours");
    announce("derived", options.is_derived(), reason_for_derived(options));
    announce("patch", false, "");
}

/// What is held now; all entries exist. What the search made only for other lists is theirs.
void ConnectivityMap::report_bytes() {
    const auto unasked = [this](const char* product) {
        ReportEntry& entry = report_.entry(product);
        report_.entry("derived").ms += entry.ms;
        entry.asked_by.clear(), entry.reason.clear();
        entry.built = entry.reused = false;
        entry.ms = 0;
    };
    if (!options_.rows) unasked("rows");
    if (!options_.wants_pairs()) unasked("pairs");
    report_.entry("rows").bytes = rows_.bytes();
    report_.entry("pairs").bytes = pairs_.bytes();
    report_.entry("overlap").bytes = overlap_.bytes();
    report_.entry("intersection").bytes = intersection_.bytes();
    report_.entry("key_order").bytes = key_order_.bytes();
    report_.entry("derived").bytes = impl_->derived_bytes();
    report_.entry("patch").bytes = impl_->patch ? impl_->patch->bytes() : 0;
    report_.entry("skin").bytes = impl_->reference.bytes();
    report_.entry("order").bytes = order_bytes_ + static_cast<Offset>(order_.size() * sizeof(Slot));
    report_.entry("nodes").bytes =
        impl_->storage.bytes() + static_cast<Offset>(layout_.active().size());
}

}  // namespace connectivity
