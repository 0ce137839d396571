// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// PairwiseField<double, n> with an n that is known at run time only.
///
/// Invariants: those of PairFieldBase; the memory of a field that is reset stays where it is if it
/// suffices. Cost: 8 n bytes a pair.

#include <connectivity/map/pair_field_base.hpp>

namespace connectivity::capi {

class PairValues final : public PairFieldBase {
public:
    static constexpr int max_components = 256;

    explicit PairValues(int n_components) : n_components_(n_components) {}
    PairValues(const PairValues&) = delete;
    PairValues& operator=(const PairValues&) = delete;

    /// Begins anew for this list, with zeros. Throws Error{not_built}, Error{memory}; the field is
    /// then as it was.
    void reset(const NodePairList& pairs);
    /// Of no list, without memory.
    void clear() noexcept;

    int n_components() const { return n_components_; }
    double* data() { return values_.data(); }  ///< [size() * n_components()]
    const double* data() const { return values_.data(); }

    Offset bytes() const override;
    void prepare_remap(const ConstView<Offset>& new_to_old) override;
    void commit_remap(Stamp stamp) noexcept override;
    void abandon_remap() noexcept override;

private:
    int n_components_;
    View<double> values_, pending_;  // values_ may be larger than needed
    bool is_prepared_ = false;
};

}  // namespace connectivity::capi
