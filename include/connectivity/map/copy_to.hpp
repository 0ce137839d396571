// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Copies of lists and fields in another memory space, for kernels there: copy_to<Space>(x).
///
/// Invariants: a copy owns its memory and carries generation and stamp of what it was made from.
/// Copies are complete when the call returns. Cost: one pass over the bytes; Error{memory}.

#include <connectivity/map/pairwise_field.hpp>
#include <connectivity/map/rows.hpp>

namespace connectivity {

namespace detail {
template <class Space, class T>
View<T, Space> copied(const char* label, const ConstView<T>& from) {
    const auto to = allocate<T, Space>(label, static_cast<Offset>(from.size()));
    if (from.size() > 0) Kokkos::deep_copy(to, from);
    return to;
}
}  // namespace detail

template <class Space>
RowsView<Space> copy_to(const RowsView<>& rows) {
    return {detail::copied<Space>("map/rows/copy/offsets", rows.offsets),
            detail::copied<Space>("map/rows/copy/slots", rows.slots), rows.n_lists,
            rows.generation};
}

template <class Space>
NodePairList::View<Space> copy_to(const NodePairList::View<>& pairs) {
    return {detail::copied<Space>("map/pairs/copy/offsets", pairs.offsets),
            detail::copied<Space>("map/pairs/copy/j", pairs.j),
            detail::copied<Space>("map/pairs/copy/i", pairs.i),
            pairs.generation,
            pairs.stamp,
            detail::copied<Space>("map/pairs/copy/coupling", pairs.coupling),
            detail::copied<Space>("map/pairs/copy/nodes", pairs.slots),
            detail::copied<Space>("map/pairs/copy/ranks", pairs.ranks)};
}

template <class Space, class Value, int n>
PairwiseFieldView<Value, n, Space> copy_to(const PairwiseField<Value, n>& field) {
    const ConstView<Value> values(field.data(), static_cast<std::size_t>(field.size() * n));
    return {detail::copied<Space>("map/pair_field/copy", values), field.size(), field.stamp()};
}

/// The other way: values of a copy into the field it was made from. Throws Error{stale} if that
/// belongs to another pair list by now.
template <class Value, int n, class Space>
void copy_back(const PairwiseFieldView<Value, n, Space>& copy, PairwiseField<Value, n>& field) {
    if (copy.stamp != field.stamp() || copy.size() != field.size())
        throw Error(Status::stale, "copy_back: the copy and the field belong to different lists");
    const View<Value> values(field.data(), static_cast<std::size_t>(field.size() * n));
    if (values.size() > 0) Kokkos::deep_copy(values, copy.values);
}

}  // namespace connectivity
