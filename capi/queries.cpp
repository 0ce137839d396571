// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/parallel.hpp>

#include "arguments.hpp"
#include "guard.hpp"
#include "objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {
const conn_map& handle_of(const conn_map* handle) {
    return Registry::instance().get<const conn_map>(handle, "map");
}
}  // namespace

conn_status conn_map_key_order(const conn_map* map, int32_t* slots, int32_t* ranks, uint64_t* keys,
                               int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& handle = handle_of(map);
        const KeyOrderView<> order = handle.map->key_order();
        copy_nodes_out(order.slots, handle.base, slots, capacity, count);
        copy_out(order.ranks, ranks, capacity, count);
        copy_out(order.keys, keys, capacity, count);
    });
}

conn_status conn_map_traversal(const conn_map* map, int32_t list, int32_t* nodes, int64_t capacity,
                               int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& handle = handle_of(map);
        required(count, "count");
        const NodeTraversal traversal = handle.map->traversal(list);
        *count = traversal.size();
        if (nodes == nullptr) return;
        check_capacity(capacity, *count);
        std::copy(traversal.begin(), traversal.end(), nodes);
        handle.base.copy_out(nodes, *count, nodes);
    });
}

conn_status conn_map_common_neighbours(const conn_map* map, int32_t a, int32_t b,
                                       conn_nodes* const* lists, int32_t n_lists, int32_t* slots,
                                       int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& handle = handle_of(map);
        const Slot i = handle.base.in(a), j = handle.base.in(b);
        const bool all = lists == nullptr && n_lists == 0;
        const std::vector<Slot> common =
            all ? handle.map->common_neighbours(i, j)
                : handle.map->common_neighbours(i, j, read_lists(lists, n_lists));
        copy_nodes_out(common, handle.base, slots, capacity, count);
    });
}

conn_status conn_map_all_neighbours(const conn_map* map, int32_t a, int32_t b, int32_t* slots,
                                    int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& handle = handle_of(map);
        copy_nodes_out(handle.map->all_neighbours(handle.base.in(a), handle.base.in(b)),
                       handle.base, slots, capacity, count);
    });
}

conn_status conn_map_find_pairs(const conn_map* map, int64_t n, const int32_t* i, const int32_t* j,
                                int64_t* pair) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& handle = handle_of(map);
        const NodePairList::View<> pairs = handle.map->pairs().view();
        const IndexBase base = handle.base;
        const auto number = [=](Offset k) { return pairs.find(base.in(i[k]), base.in(j[k])); };
        constexpr std::int64_t limit = std::int64_t{1} << 48;
        check_count(i, n, limit, "i", "n");
        check_count(j, n, limit, "j", "n");
        check_count(pair, n, limit, "pair", "n");
        if (n <= few_items) {
            for (std::int64_t k = 0; k < n; ++k) pair[k] = number(k);
            return;
        }
        Kokkos::parallel_for("capi/find_pairs",
                             Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                             [=](const Offset k) { pair[k] = number(k); });
        HostExec().fence();
    });
}
