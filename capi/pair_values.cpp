// SPDX-License-Identifier: BSD-3-Clause
#include "pair_values.hpp"

namespace connectivity::capi {

namespace {
constexpr const char* label = "capi/pair_field";
}

void PairValues::reset(const NodePairList& pairs) {
    require_built(pairs);
    const Offset n_values = pairs.size() * n_components_;
    const bool fits = n_values <= static_cast<Offset>(values_.size());
    const View<double> values = fits ? values_ : allocate<double>(label, n_values);
    detail::fill_pairs(values.data(), n_values, 0.0);
    values_ = values;
    abandon_remap();
    belong_to(pairs.stamp(), pairs.size());
}

void PairValues::clear() noexcept {
    values_ = {};
    abandon_remap();
    belong_to(0, 0);
}

Offset PairValues::bytes() const {
    return static_cast<Offset>((values_.size() + pending_.size()) * sizeof(double));
}

void PairValues::prepare_remap(const ConstView<Offset>& new_to_old) {
    pending_ = detail::remapped<double>(label, data(), n_components_, new_to_old);
    is_prepared_ = true;
}

void PairValues::commit_remap(Stamp stamp) noexcept {
    if (!is_prepared_) return;
    values_ = pending_;
    belong_to(stamp, static_cast<Offset>(values_.size()) / n_components_);
    abandon_remap();
}

void PairValues::abandon_remap() noexcept {
    pending_ = {};
    is_prepared_ = false;
}

}  // namespace connectivity::capi
