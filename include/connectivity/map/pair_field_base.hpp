// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What all fields over pairs share: which pair list they belong to, and how they follow a patch.
///
/// Invariant: stamp() is that of the list the values were made for, so that a field of another map
/// or of an older generation is recognised. Cost: one comparison a check.

#include <algorithm>
#include <string>
#include <utility>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/parallel.hpp>
#include <connectivity/map/node_pair_list.hpp>

namespace connectivity {

namespace detail {
using Pairs = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// data[0 .. n) = value, by all threads.
template <class Value>
void fill_pairs(Value* data, Offset n, const Value& value) {
    if (n <= few_items) return void(std::fill_n(data, n, value));
    shim::outside_parallel_region([&] {
        Kokkos::parallel_for("map/pairs/fill", Pairs(0, n),
                             [=](const Offset k) { data[k] = value; });
        HostExec().fence();
    });
}

template <class Value>
void copy_pairs(const Value* from, Offset n, Value* to) {
    if (n <= few_items) return void(std::copy_n(from, n, to));
    shim::outside_parallel_region([&] {
        Kokkos::parallel_for("map/pairs/copy", Pairs(0, n),
                             [=](const Offset k) { to[k] = from[k]; });
        HostExec().fence();
    });
}

/// Blocks of n values in a new order: block k is block new_to_old(k) of old. Throws Error{memory}.
template <class Value>
View<Value> remapped(const std::string& label, const Value* old, int n,
                     const ConstView<Offset>& new_to_old) {
    const auto n_pairs = static_cast<Offset>(new_to_old.size());
    auto values = allocate<Value>(label, n_pairs * n);
    Value* const out = values.data();
    const Offset* const from = new_to_old.data();
    shim::outside_parallel_region([&] {
        Kokkos::parallel_for("map/pairs/remap", Pairs(0, n_pairs), [=](const Offset k) {
            for (int c = 0; c < n; ++c) out[k * n + c] = old[from[k] * n + c];
        });
        HostExec().fence();
    });
    return values;
}
}  // namespace detail

/// What the map needs to carry fields of any value through a patch.
class PairFieldBase {
public:
    virtual ~PairFieldBase() = default;

    Offset size() const { return n_pairs_; }  ///< pairs
    Stamp stamp() const { return stamp_; }    ///< of the pair list it belongs to; 0: of none
    bool is_current(const NodePairList& pairs) const {
        return stamp_ != 0 && stamp_ == pairs.stamp();
    }
    /// Throws Error{stale} unless it belongs to this list in its present generation.
    void require_current(const NodePairList& pairs) const;

    virtual Offset bytes() const = 0;

    /// For ConnectivityMap::patch. First step: computes the values of the surviving pairs,
    /// new_to_old [n_new_pairs] being their old numbers, in memory of its own; nothing visible
    /// changes. Throws Error{memory}.
    virtual void prepare_remap(const ConstView<Offset>& new_to_old) = 0;
    /// Second step: these become the values, of the pair list with that stamp. Without a first step
    /// it does nothing.
    virtual void commit_remap(Stamp stamp) noexcept = 0;
    /// Forgets the first step.
    virtual void abandon_remap() noexcept = 0;

protected:
    PairFieldBase() = default;
    PairFieldBase(const PairFieldBase&) = default;
    PairFieldBase& operator=(const PairFieldBase&) = default;

    static void require_built(const NodePairList& pairs);  ///< Throws Error{not_built}.
    void belong_to(Stamp stamp, Offset n_pairs) noexcept { stamp_ = stamp, n_pairs_ = n_pairs; }
    void swap_base(PairFieldBase& other) noexcept {
        std::swap(stamp_, other.stamp_);
        std::swap(n_pairs_, other.n_pairs_);
    }
    /// Number of pair {i, j}, -1 if there is none. Throws Error{stale}.
    Offset find_pair(const NodePairList& pairs, Slot i, Slot j) const;
    /// Throws Error{argument} too if there is none.
    Offset require_pair(const NodePairList& pairs, Slot i, Slot j) const;

private:
    Stamp stamp_ = 0;
    Offset n_pairs_ = 0;
};

}  // namespace connectivity
