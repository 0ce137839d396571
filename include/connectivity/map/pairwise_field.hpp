// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Values of pairs: n of them for each pair of one pair list, in its order.
///
/// Invariants: a field belongs to one generation of one pair list and knows its stamp; what names
/// another list, or the same one after a rebuild, ends in Error{stale}, in release builds too. Only
/// fields that a patch is given go on with the new list. Copies are deep; what was moved from is
/// empty. Cost: n values a pair.

#include <type_traits>
#include <utility>

#include <connectivity/map/pair_field_base.hpp>

namespace connectivity {

namespace detail {
/// Pair k of blocks of n: a reference, or for n > 1 a pointer to the block.
template <int n, class T>
KOKKOS_INLINE_FUNCTION decltype(auto) pair_block(T* data, Offset k) {
    if constexpr (n == 1)
        return (data[k]);
    else
        return data + k * n;
}
}  // namespace detail

/// A field as kernels see it: a counted handle, captured by value. T is Value or const Value.
template <class T, int n = 1, class Space = HostMemory>
struct PairwiseFieldView {
    View<T, Space> values;  ///< [n_pairs * n]: values of pair k are [k*n, (k+1)*n)
    Offset n_pairs = 0;
    Stamp stamp = 0;  ///< of the pair list

    KOKKOS_INLINE_FUNCTION Offset size() const { return n_pairs; }
    KOKKOS_INLINE_FUNCTION T* data() const { return values.data(); }
    /// Pair k: a reference, or for n > 1 a pointer to its n values.
    KOKKOS_INLINE_FUNCTION decltype(auto) operator[](Offset k) const {
        return detail::pair_block<n>(values.data(), k);
    }

    operator PairwiseFieldView<const T, n, Space>() const requires(!std::is_const_v<T>) {
        return {values, n_pairs, stamp};
    }
};

template <class Value, int n = 1>
class PairwiseField final : public PairFieldBase {
    static_assert(n >= 1 && std::is_trivially_copyable_v<Value> &&
                  std::is_default_constructible_v<Value>);

public:
    template <class Space = HostMemory>
    using View = PairwiseFieldView<Value, n, Space>;
    template <class Space = HostMemory>
    using ConstView = PairwiseFieldView<const Value, n, Space>;
    using Reference = std::conditional_t<n == 1, Value&, Value*>;
    using ConstReference = std::conditional_t<n == 1, const Value&, const Value*>;

    PairwiseField() = default;  ///< of no pair list, no values
    /// Value{} for every pair. Throws Error{not_built} if the list was never built, Error{memory}.
    explicit PairwiseField(const NodePairList& pairs) { reset(pairs); }

    PairwiseField(const PairwiseField& other);  ///< Throws Error{memory}.
    PairwiseField(PairwiseField&& other) noexcept : PairwiseField() { swap(other); }
    PairwiseField& operator=(const PairwiseField& other);
    PairwiseField& operator=(PairwiseField&& other) noexcept;
    ~PairwiseField() override = default;
    void swap(PairwiseField& other) noexcept;

    /// Begins anew for this list: Value{} for every pair, in the memory it has where that suffices.
    /// Throws as the constructor does, and then stays as it was.
    void reset(const NodePairList& pairs);

    /// Pair k of [0, size()), unchecked: a reference, or for n > 1 a pointer to its n values. Does
    /// not know whether the list changed: take k from the list the field was made for.
    Reference operator[](Offset k) { return detail::pair_block<n>(data(), k); }
    ConstReference operator[](Offset k) const { return detail::pair_block<n>(data(), k); }
    Reference operator()(Offset k) { return detail::pair_block<n>(data(), k); }
    ConstReference operator()(Offset k) const { return detail::pair_block<n>(data(), k); }

    /// The pair of slots {i, j}, in either orientation, by binary search in a half row. Throws
    /// Error{stale}, Error{argument} if they are no pair.
    Reference operator()(const NodePairList& pairs, Slot i, Slot j) {
        return (*this)[require_pair(pairs, i, j)];
    }
    ConstReference operator()(const NodePairList& pairs, Slot i, Slot j) const {
        return (*this)[require_pair(pairs, i, j)];
    }
    /// The same; nullptr if they are no pair. Throws Error{stale}.
    Value* find(const NodePairList& pairs, Slot i, Slot j) {
        const Offset k = find_pair(pairs, i, j);
        return k < 0 ? nullptr : data() + k * n;
    }
    const Value* find(const NodePairList& pairs, Slot i, Slot j) const {
        return const_cast<PairwiseField*>(this)->find(pairs, i, j);
    }

    Value* data() { return values_.data(); }  ///< [size() * n]
    const Value* data() const { return values_.data(); }

    /// Host views. They hold the storage: a reset, patch or assignment leaves them as they are.
    View<> view() { return {values_, size(), stamp()}; }
    ConstView<> view() const { return {values_, size(), stamp()}; }
    /// The same, for loops over this list. Throw Error{stale}.
    View<> view(const NodePairList& pairs) {
        require_current(pairs);
        return view();
    }
    ConstView<> view(const NodePairList& pairs) const {
        require_current(pairs);
        return view();
    }

    Offset bytes() const override;
    void prepare_remap(const connectivity::ConstView<Offset>& new_to_old) override;
    void commit_remap(Stamp stamp) noexcept override;
    void abandon_remap() noexcept override { pending_ = {}, is_prepared_ = false; }

private:
    static constexpr const char* label = "map/pair_field";
    using Storage = connectivity::View<Value>;
    Storage values_, pending_;  // values_ may be larger than size() * n
    bool is_prepared_ = false;
};

template <class Value, int n>
PairwiseField<Value, n>::PairwiseField(const PairwiseField& other) : PairFieldBase(other) {
    values_ = allocate<Value>(label, size() * n);
    detail::copy_pairs(other.data(), size() * n, data());
}

template <class Value, int n>
PairwiseField<Value, n>& PairwiseField<Value, n>::operator=(const PairwiseField& other) {
    PairwiseField(other).swap(*this);
    return *this;
}

template <class Value, int n>
PairwiseField<Value, n>& PairwiseField<Value, n>::operator=(PairwiseField&& other) noexcept {
    PairwiseField(std::move(other)).swap(*this);
    return *this;
}

template <class Value, int n>
void PairwiseField<Value, n>::swap(PairwiseField& other) noexcept {
    swap_base(other);
    std::swap(values_, other.values_);
    std::swap(pending_, other.pending_);
    std::swap(is_prepared_, other.is_prepared_);
}

template <class Value, int n>
void PairwiseField<Value, n>::reset(const NodePairList& pairs) {
    require_built(pairs);
    const Offset n_values = pairs.size() * n;
    const bool fits = n_values <= static_cast<Offset>(values_.size()) && values_.use_count() <= 1;
    Storage values = fits ? values_ : allocate<Value>(label, n_values);
    detail::fill_pairs(values.data(), n_values, Value{});
    values_ = values;
    abandon_remap();
    belong_to(pairs.stamp(), pairs.size());
}

template <class Value, int n>
Offset PairwiseField<Value, n>::bytes() const {
    return static_cast<Offset>((values_.size() + pending_.size()) * sizeof(Value));
}

template <class Value, int n>
void PairwiseField<Value, n>::prepare_remap(const connectivity::ConstView<Offset>& new_to_old) {
    pending_ = detail::remapped<Value>(label, data(), n, new_to_old);
    is_prepared_ = true;
}

template <class Value, int n>
void PairwiseField<Value, n>::commit_remap(Stamp stamp) noexcept {
    if (!is_prepared_) return;
    values_ = pending_;
    belong_to(stamp, static_cast<Offset>(values_.size()) / n);
    abandon_remap();
}

}  // namespace connectivity
