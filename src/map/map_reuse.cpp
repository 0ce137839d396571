// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "map_impl.hpp"

namespace connectivity {

/// All that may fail; the lists are still the old ones.
void ConnectivityMap::reserve_reference(std::span<const NodeList> lists, const MapOptions& options,
                                        Report& report) {
    auto& entry = report.entry("skin");
    if (options.skin == 0) return;
    count_reuse(report);
    entry.asked_by = "caller";
    entry.reason = "positions and supports to measure drift from";
    entry.built = true;
    const Stopwatch reserving;
    const Offset held = impl_->reference.bytes();
    impl_->reference.reserve(lists);
    entry.reused = held > 0 && impl_->reference.bytes() == held;
    entry.ms = reserving.ms();
}

void ConnectivityMap::keep_reference(std::span<const NodeList> lists, Report& report) {
    const Stopwatch keeping;
    auto& entry = report.entry("skin");
    if (options_.skin > 0) {
        impl_->reference.keep(lists, options_.domain);
        entry.bytes = impl_->reference.bytes();
        entry.ms += keeping.ms();
    } else {
        impl_->reference.clear();
    }
    ++reuse_.rebuilds;
    if (options_.skin > 0) count_reuse(report);
}

/// Counters are whole numbers: the drift goes in as millionths of the skin.
void ConnectivityMap::count_reuse(Report& report) const {
    report.counter("rebuilds") = reuse_.rebuilds;
    report.counter("reuses") = reuse_.reuses;
    report.counter("max_drift_ppm") =
        options_.skin > 0 ? std::llround(std::min(1e6 * (reuse_.max_drift / options_.skin), 1e18))
                          : 0;
}

double ConnectivityMap::drift(std::span<const NodeList> lists) const {
    if (generation_ == 0 || options_.skin == 0) return std::numeric_limits<double>::infinity();
    double drift = 0;
    launch("drift", [&] { drift = impl_->reference.drift(lists); });
    return drift;
}

bool ConnectivityMap::needs_rebuild(std::span<const NodeList> lists, double* drift) {
    const double now = this->drift(lists);
    if (drift != nullptr) *drift = now;
    if (!(now <= options_.skin)) return true;
    ++reuse_.reuses;
    reuse_.max_drift = std::max(reuse_.max_drift, now);
    count_reuse(report_);
    return false;
}

}  // namespace connectivity
