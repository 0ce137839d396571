// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "guard.hpp"
#include "objects.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

constexpr std::int32_t max_lists = 65536;

SearchMode read_mode(std::int32_t mode) {
    switch (mode) {
        case CONN_GATHER: return SearchMode::gather;
        case CONN_SCATTER: return SearchMode::scatter;
        case CONN_GATHER_SCATTER: return SearchMode::gather_scatter;
        default:
            throw Error(Status::argument,
                        "options->mode = " + std::to_string(mode) +
                            ", must be CONN_GATHER, CONN_SCATTER or CONN_GATHER_SCATTER");
    }
}

SearchMethod read_method(std::int32_t method) {
    switch (method) {
        case CONN_METHOD_AUTOMATIC: return SearchMethod::automatic;
        case CONN_METHOD_BRUTE: return SearchMethod::brute;
        case CONN_METHOD_CELLS: return SearchMethod::cells;
        case CONN_METHOD_GROUPS: return SearchMethod::groups;
        case CONN_METHOD_DEVICE: return SearchMethod::device;
        default:
            throw Error(Status::argument, "options->method = " + std::to_string(method) +
                                              ", must be one of CONN_METHOD_*");
    }
}

MapOptions read_options(const conn_map_options* given) {
    conn_map_options o = CONN_MAP_OPTIONS_INIT;
    if (given != nullptr) o = read_struct(given, o, "options");
    MapOptions options;
    options.rows = read_flag(o.rows, "options->rows");
    options.pairs = read_flag(o.pairs, "options->pairs");
    options.ghost_rows = read_flag(o.ghost_rows, "options->ghost_rows");
    options.spatial_order = read_flag(o.spatial_order, "options->spatial_order");
    options.mode = read_mode(o.mode);
    options.method = read_method(o.method);
    for (int d = 0; d < 3; ++d) {
        options.domain.periodic[d] =
            read_flag(o.periodic[d], "options->periodic[" + std::to_string(d) + "]");
        options.domain.lo[d] = o.box_lo[d];
        options.domain.hi[d] = o.box_hi[d];
    }
    if (o.reserved != 0) throw Error(Status::unsupported, "options->reserved is set, must be 0");
    if (options.pairs && options.mode != SearchMode::gather_scatter)
        throw Error(Status::argument,
                    "options->pairs = 1 needs options->mode = CONN_GATHER_SCATTER");
    if (o.budget_bytes < 0)
        throw Error(Status::argument,
                    "options->budget_bytes = " + std::to_string(o.budget_bytes) + ", must be >= 0");
    options.budget.bytes = o.budget_bytes;
    if (o.skin != 0 && !(o.skin >= 1e-100 && o.skin <= 1e100))
        throw Error(Status::argument, "options->skin = " + std::to_string(o.skin) +
                                          ", must be 0 or in [1e-100, 1e100]");
    options.skin = o.skin;
    return options;
}

const ConnectivityMap& map_of(const conn_map* handle) {
    return *Registry::instance().get<const conn_map>(handle, "map").map;
}

void check_capacity(std::int64_t capacity, std::int64_t needed) {
    if (capacity < needed)
        throw Error(Status::buffer, "capacity = " + std::to_string(capacity) +
                                        ", must be at least " + std::to_string(needed));
}

}  // namespace

namespace connectivity::capi {

MapOptions options_of(const conn_map& map) {
    MapOptions options = map.options;
    if (options.budget.bytes == 0) options.budget.bytes = map.context_budget;
    return options;
}

std::vector<NodeList> read_lists(conn_nodes* const* lists, std::int32_t n_lists) {
    if (n_lists < 1 || n_lists > max_lists)
        throw Error(n_lists < 1 ? Status::argument : Status::too_many,
                    "n_lists = " + std::to_string(n_lists) + ", must be in [1, " +
                        std::to_string(max_lists) + "]");
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

conn_status conn_map_options_init(conn_map_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_map_options CONN_MAP_OPTIONS_INIT, "options");
    });
}

conn_status conn_map_create(conn_context* context, const conn_map_options* options,
                            conn_map** map) {
    return guarded_with_runtime(__func__, [&] {
        const auto& in = Registry::instance().get<conn_context>(context, "context");
        if (map == nullptr) throw Error(Status::null, "map is NULL");
        auto made = std::make_unique<conn_map>();
        made->options = read_options(options);
        made->context_budget = in.budget_bytes;
        *map = Registry::instance().add(std::move(made));
    });
}

conn_status conn_map_destroy(conn_map** map) {
    return guarded(__func__, [&] { Registry::instance().destroy(map, "map"); });
}

conn_status conn_map_set_options(conn_map* map, const conn_map_options* options) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        ours.options = read_options(options);
    });
}

conn_status conn_map_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        const std::vector<NodeList> nodes = read_lists(lists, n_lists);
        ours.map->rebuild(nodes, options_of(ours));
    });
}

conn_status conn_map_needs_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                                   int32_t* needed, double* drift) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        if (needed == nullptr) throw Error(Status::null, "needed is NULL");
        const std::vector<NodeList> nodes = read_lists(lists, n_lists);
        const bool same_options = ours.map->options() == options_of(ours);
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
        const ConnectivityMap& ours = map_of(map);
        conn_map_info out = read_struct(info, conn_map_info CONN_MAP_INFO_INIT, "info");
        const bool is_built = ours.generation() > 0;
        out.generation = ours.generation();
        out.n_slots = ours.layout().n_slots();
        out.n_rows = ours.layout().n_rows();
        out.n_entries = is_built && ours.options().rows ? ours.rows().size() : 0;
        out.n_pairs = is_built && ours.options().pairs ? ours.pairs().size() : 0;
        out.bytes = ours.report().total_bytes();
        out.dim = ours.dim();
        out.n_lists = ours.layout().n_lists();
        out.n_report_entries = static_cast<std::int32_t>(ours.report().entries().size());
        out.n_report_counters = static_cast<std::int32_t>(ours.report().counters().size());
        write_struct(info, out, out.struct_size);
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
        const ConnectivityMap& ours = map_of(map);
        if (count == nullptr) throw Error(Status::null, "count is NULL");
        const View<Slot> order = ours.spatial_order(list);
        *count = static_cast<std::int64_t>(order.size());
        if (nodes == nullptr) return;
        check_capacity(capacity, *count);
        std::copy_n(order.data(), order.size(), nodes);
    });
}
