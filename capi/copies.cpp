// SPDX-License-Identifier: BSD-3-Clause
// Lists copied into arrays of the host.

#include "arguments.hpp"
#include "guard.hpp"
#include "objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

/// Values [n] into an array that may be NULL.
template <class T>
void copy_values(const T* from, Offset n, T* to) {
    if (to == nullptr) return;
    Kokkos::parallel_for("capi/copy_out",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=](const Offset k) { to[k] = from[k]; });
    HostExec().fence();
}

void copy_coupling(const NodePairList::View<>& pairs, double* to) {
    if (pairs.coupling.size() > 0) return copy_values(pairs.coupling.data(), pairs.size(), to);
    if (to != nullptr) detail::fill_pairs(to, pairs.size(), 1.0);
}

}  // namespace

conn_status conn_map_rows_copy(const conn_map* map, int64_t* offsets, int64_t offsets_capacity,
                               int64_t* n_offsets, int32_t* slots, int64_t slots_capacity,
                               int64_t* n_slots) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        const RowsView<> rows = ours.map->rows();
        required(n_offsets, "n_offsets");
        required(n_slots, "n_slots");
        *n_offsets = static_cast<std::int64_t>(rows.offsets.size());
        *n_slots = rows.size();
        if (offsets != nullptr) check_capacity(offsets_capacity, *n_offsets, "offsets_capacity");
        if (slots != nullptr) check_capacity(slots_capacity, *n_slots, "slots_capacity");
        copy_values(rows.offsets.data(), *n_offsets, offsets);
        if (slots != nullptr) ours.base.copy_out(rows.slots.data(), *n_slots, slots);
    });
}

conn_status conn_map_pairs_copy(const conn_map* map, int32_t* i, int32_t* j, double* coupling,
                                int64_t capacity, int64_t* n_pairs) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        const NodePairList::View<> pairs = std::as_const(*ours.map).pairs().view();
        required(n_pairs, "n_pairs") = pairs.size();
        if (i == nullptr && j == nullptr && coupling == nullptr) return;
        check_capacity(capacity, pairs.size());
        if (i != nullptr) write_first_nodes(pairs, ours.base, i);
        if (j != nullptr) ours.base.copy_out(pairs.j.data(), pairs.size(), j);
        copy_coupling(pairs, coupling);
    });
}
