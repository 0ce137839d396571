// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include <connectivity/map/estimate.hpp>

#include "arguments.hpp"
#include "guard.hpp"
#include "map_work.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

std::uint64_t next_number() {
    static std::uint64_t last = 0;  // under the call mutex
    return ++last;
}

MapOptions options_with_budget(const conn_map& map) {
    MapOptions options = map.options;
    if (options.budget.bytes == 0) options.budget.bytes = map.context_budget;
    return options;
}

const ConnectivityMap& map_of(const conn_map* handle) {
    return *Registry::instance().get<const conn_map>(handle, "map").map;
}

/// Whether the lists of the map were made with the options that the next rebuild will have.
bool has_same_options(const conn_map& map) {
    MapOptions next = options_with_budget(map);
    const ConstView<std::uint8_t> active = std::exchange(next.active, {}),
                                  before = map.map->layout().active();
    return map.map->options() == next && std::equal(active.data(), active.data() + active.size(),
                                                    before.data(), before.data() + before.size());
}

}  // namespace

conn_map::conn_map(const conn_context& context, IndexBase index_base)
    : number(next_number()),
      base(index_base),
      log(context.log),
      context_budget(context.budget_bytes) {}

namespace connectivity::capi {

MapOptions options_of(const conn_map& map, std::span<const NodeList> lists) {
    Offset n = 0;
    for (const NodeList& list : lists) n += list.n();
    if (map.names_active && map.options.active.size() == 0 && n > 0)
        throw Error(Status::argument, "options->n_active = 0, must be " + std::to_string(n) +
                                          ", one for each node, where active is not NULL");
    return options_with_budget(map);
}

std::vector<NodeList> read_lists(conn_nodes* const* lists, std::int32_t n_lists) {
    if (n_lists < 1 || n_lists > max_handles)
        throw Error(n_lists < 1 ? Status::argument : Status::too_many,
                    "n_lists = " + std::to_string(n_lists) + ", must be in [1, " +
                        std::to_string(max_handles) + "]");
    if (lists == nullptr) throw Error(Status::null, "lists is NULL");
    std::vector<NodeList> ours;
    for (int k = 0; k < n_lists; ++k) {
        const std::string name = "lists[" + std::to_string(k) + "]";
        const auto& nodes = Registry::instance().get<const conn_nodes>(lists[k], name);
        if (!nodes.list)
            throw Error(Status::argument, name + " (\"" + nodes.name +
                                              "\") was never set; an empty list is set with "
                                              "arrays of 0 nodes");
        ours.push_back(*nodes.list);
    }
    return ours;
}

}  // namespace connectivity::capi

conn_status conn_map_create(conn_context* context, const conn_map_options* options,
                            conn_map** map) {
    return guarded_with_runtime(__func__, [&] {
        const auto& in = Registry::instance().get<conn_context>(context, "context");
        if (map == nullptr) throw Error(Status::null, "map is NULL");
        auto made = std::make_unique<conn_map>(in, read_index_base(options, "options"));
        made->options = read_options(options);
        made->names_active = names_active(options);
        *map = Registry::instance().add(std::move(made));
    });
}

conn_status conn_map_destroy(conn_map** map) {
    return guarded(__func__, [&] { Registry::instance().destroy(map, "map"); });
}

conn_status conn_map_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        work_on(ours, "rebuild", [&] {
            const std::vector<NodeList> nodes = read_lists(lists, n_lists);
            ours.map->rebuild(nodes, options_of(ours, nodes));
        });
    });
}

conn_status conn_map_needs_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                                   int32_t* needed, double* drift) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        if (needed == nullptr) throw Error(Status::null, "needed is NULL");
        const std::vector<NodeList> nodes = read_lists(lists, n_lists);
        const bool same_options = has_same_options(ours);
        double now = 0;
        *needed = !same_options || ours.map->needs_rebuild(nodes, &now) ? 1 : 0;
        if (!same_options) now = ours.map->drift(nodes);
        if (drift != nullptr) *drift = now;
    });
}

conn_status conn_map_generation(const conn_map* map, uint64_t* generation) {
    return guarded_with_runtime(__func__, [&] {
        const ConnectivityMap& ours = map_of(map);
        if (generation == nullptr) throw Error(Status::null, "generation is NULL");
        *generation = ours.generation();
    });
}

conn_status conn_map_get_info(const conn_map* map, conn_map_info* info) {
    return guarded_with_runtime(__func__, [&] {
        const auto& handle = Registry::instance().get<const conn_map>(map, "map");
        const ConnectivityMap& ours = *handle.map;
        conn_map_info out = read_struct(info, conn_map_info CONN_MAP_INFO_INIT, "info");
        const bool is_built = ours.generation() > 0;
        out.generation = ours.generation();
        out.n_slots = ours.layout().n_slots();
        out.n_rows = ours.layout().n_rows();
        out.n_entries = is_built && ours.options().rows ? ours.rows().size() : 0;
        out.n_pairs = is_built && ours.options().wants_pairs() ? ours.pairs().size() : 0;
        out.bytes = held_bytes(handle);
        out.dim = ours.dim();
        out.n_lists = ours.layout().n_lists();
        out.n_report_entries = static_cast<std::int32_t>(ours.report().entries().size());
        out.n_report_counters = static_cast<std::int32_t>(ours.report().counters().size());
        write_struct(info, out, out.struct_size);
    });
}

conn_status conn_map_memory(const conn_map* map, int32_t space, int64_t* bytes,
                            int64_t* high_water) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        check_space(space);
        const Offset now = memory_now(ours);
        if (bytes != nullptr) *bytes = now;
        if (high_water != nullptr) *high_water = ours.high_water;
    });
}

conn_status conn_map_estimate(const conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                              conn_estimate* estimate) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        conn_estimate out = read_struct(estimate, conn_estimate CONN_ESTIMATE_INIT, "estimate");
        const std::vector<NodeList> nodes = read_lists(lists, n_lists);
        const MapEstimate found = connectivity::estimate(nodes, options_of(ours, nodes));
        out.n_entries = found.n_entries;
        out.n_pairs = found.n_pairs;
        out.bytes = found.bytes;
        // The handle keeps a copy of the active nodes, too.
        out.peak_bytes = found.peak_bytes + static_cast<Offset>(ours.options.active.size());
        out.n_sampled = found.n_sampled;
        out.relative_error = found.relative_error;
        out.is_lower_bound = found.is_lower_bound ? 1 : 0;
        write_struct(estimate, out, out.struct_size);
    });
}

conn_status conn_map_offsets(const conn_map* map, int64_t* list_offset, int64_t* row_offset,
                             int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const SlotLayout& layout = map_of(map).layout();
        if (count == nullptr) throw Error(Status::null, "count is NULL");
        *count = layout.n_lists() + 1;
        if (list_offset == nullptr && row_offset == nullptr) return;
        check_capacity(capacity, *count);
        if (list_offset != nullptr) std::ranges::copy(layout.list_offset(), list_offset);
        if (row_offset != nullptr) std::ranges::copy(layout.row_offset(), row_offset);
    });
}

conn_status conn_map_spatial_order(const conn_map* map, int32_t list, int32_t* nodes,
                                   int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        if (count == nullptr) throw Error(Status::null, "count is NULL");
        copy_nodes_out(ours.map->spatial_order(list), ours.base, nodes, capacity, count);
    });
}
