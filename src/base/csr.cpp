// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/csr.hpp>

namespace connectivity {

ConstView<Offset> Csr::offsets() const {
    if (offsets_.size() == 0) return {};
    return Kokkos::subview(offsets_, range(n_rows_ + 1));
}

Offset Csr::bytes() const {
    return static_cast<Offset>((offsets_.size() + spare_.size()) * sizeof(Offset) +
                               (values_.size() + grown_.size()) * sizeof(Slot));
}

void Csr::take_spare(Offset n_rows) {
    ensure_capacity(spare_, label_ + "/offsets", n_rows + 1);
    pending_rows_ = n_rows;
}

/// Ends the counting; returns the bytes that the rows will hold.
Offset Csr::set_total(Offset n_rows, Offset total) {
    spare_(n_rows) = total;
    pending_values_ = total;
    return total * static_cast<Offset>(sizeof(Slot)) +
           (n_rows + 1) * static_cast<Offset>(sizeof(Offset));
}

Offset Csr::prepare_sizes(Offset n_rows, Offset n_values) {
    take_spare(n_rows);
    return set_total(n_rows, n_values);
}

void Csr::reserve() {
    const bool shared = values_.use_count() > 1;
    grown_ = {};
    if (pending_values_ <= static_cast<Offset>(values_.size()) && !shared) return;
    const bool growing =
        values_.size() > 0 && pending_values_ > static_cast<Offset>(values_.size());
    // A sixteenth more, so that a slowly growing list does not allocate in every build.
    grown_ =
        allocate<Slot>(label_ + "/values", pending_values_ + (growing ? pending_values_ / 16 : 0));
}

void Csr::publish() {
    if (grown_.size() > 0) values_ = grown_;
    grown_ = {};
    std::swap(offsets_, spare_);
    n_rows_ = pending_rows_;
    n_values_ = pending_values_;
}

void Csr::abandon() {
    grown_ = {};
    spare_ = {};
    pending_rows_ = pending_values_ = 0;
}

void Csr::clear() {
    offsets_ = spare_ = {};
    values_ = grown_ = {};
    n_rows_ = n_values_ = pending_rows_ = pending_values_ = 0;
}

}  // namespace connectivity
