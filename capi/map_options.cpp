// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "arguments.hpp"
#include "callbacks.hpp"
#include "guard.hpp"
#include "objects.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

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

IntersectionKind read_intersection(std::int32_t intersection) {
    switch (intersection) {
        case CONN_INTERSECTION_NONE: return IntersectionKind::none;
        case CONN_INTERSECTION_ALL: return IntersectionKind::all;
        case CONN_INTERSECTION_IN_SEGMENT: return IntersectionKind::in_segment;
        default:
            throw Error(Status::argument,
                        "options->intersection = " + std::to_string(intersection) +
                            ", must be one of CONN_INTERSECTION_*");
    }
}

ListOrder read_order(std::int32_t order) {
    switch (order) {
        case CONN_ORDER_SLOT: return ListOrder::slot;
        case CONN_ORDER_KEY: return ListOrder::key;
        default:
            throw Error(Status::argument, "options->order = " + std::to_string(order) +
                                              ", must be CONN_ORDER_SLOT or CONN_ORDER_KEY");
    }
}

/// Throws Error{argument} for the first value that is neither 0 nor 1.
void check_flags(const std::uint8_t* flags, std::int64_t n, std::int64_t limit,
                 const std::string& name) {
    check_count(flags, n, limit, "options->" + name, "options->n_" + name);
    for (std::int64_t k = 0; k < n; ++k)
        if (flags[k] > 1)
            throw Error(Status::argument, "options->" + name + "[" + std::to_string(k) + "] = " +
                                              std::to_string(flags[k]) + ", must be 0 or 1");
}

Domain domain_of(const conn_map_options& o, const std::string& name) {
    Domain domain;
    for (int d = 0; d < 3; ++d) {
        domain.periodic[d] =
            read_flag(o.periodic[d], name + "->periodic[" + std::to_string(d) + "]");
        domain.lo[d] = o.box_lo[d];
        domain.hi[d] = o.box_hi[d];
    }
    return domain;
}

void read_arrays(const conn_map_options& o, MapOptions& options) {
    check_flags(o.active, o.n_active, max_slots, "active");
    check_flags(o.interactions, o.n_interactions, std::int64_t{max_handles} * max_handles,
                "interactions");
    if (o.interactions != nullptr && o.n_interactions == 0)
        throw Error(Status::argument,
                    "options->n_interactions = 0, must be more where interactions is not NULL");
    if (o.n_active > 0) {
        const auto active = allocate<std::uint8_t>("capi/active", o.n_active);
        std::copy_n(o.active, o.n_active, active.data());
        options.active = active;
    }
    options.interactions.assign(o.interactions, o.interactions + o.n_interactions);
}

/// What no rebuild could do.
void check_combination(const MapOptions& options, bool names_active) {
    const bool intersects = options.intersection != IntersectionKind::none;
    if (options.mode != SearchMode::gather_scatter &&
        (options.pairs || options.overlap || intersects))
        throw Error(Status::argument, std::string("options->") +
                                          (options.pairs     ? "pairs = 1"
                                           : options.overlap ? "overlap = 1"
                                                             : "intersection") +
                                          " needs options->mode = CONN_GATHER_SCATTER");
    if (names_active && (options.overlap || intersects))
        throw Error(Status::argument, std::string("options->") +
                                          (options.overlap ? "overlap = 1" : "intersection") +
                                          " needs all nodes active, options->active = NULL");
}

}  // namespace

SearchMode connectivity::capi::read_mode(std::int32_t mode, const std::string& name) {
    switch (mode) {
        case CONN_GATHER: return SearchMode::gather;
        case CONN_SCATTER: return SearchMode::scatter;
        case CONN_GATHER_SCATTER: return SearchMode::gather_scatter;
        default:
            throw Error(Status::argument,
                        name + " = " + std::to_string(mode) +
                            ", must be CONN_GATHER, CONN_SCATTER or CONN_GATHER_SCATTER");
    }
}

Domain connectivity::capi::read_domain(const conn_map_options* given, const char* name) {
    if (given == nullptr) return {};
    return domain_of(read_struct(given, conn_map_options CONN_MAP_OPTIONS_INIT, name), name);
}

IndexBase connectivity::capi::read_index_base(const conn_map_options* given,
                                              const std::string& name) {
    if (given == nullptr) return {};
    const conn_map_options ours =
        read_struct(given, conn_map_options CONN_MAP_OPTIONS_INIT, name.c_str());
    return {ours.index_base, name + "->index_base"};
}

MapOptions connectivity::capi::read_options(const conn_map_options* given) {
    conn_map_options o = CONN_MAP_OPTIONS_INIT;
    if (given != nullptr) o = read_struct(given, o, "options");
    MapOptions options;
    options.rows = read_flag(o.rows, "options->rows");
    options.pairs = read_flag(o.pairs, "options->pairs");
    options.ghost_rows = read_flag(o.ghost_rows, "options->ghost_rows");
    options.spatial_order = read_flag(o.spatial_order, "options->spatial_order");
    options.overlap = read_flag(o.overlap, "options->overlap");
    options.intersection = read_intersection(o.intersection);
    options.order = read_order(o.order);
    options.mode = read_mode(o.mode, "options->mode");
    options.method = read_method(o.method);
    options.domain = domain_of(o, "options");
    if (o.reserved != 0 || o.reserved_2 != 0 || o.reserved_3 != 0)
        throw Error(Status::unsupported, std::string("options->reserved") +
                                             (o.reserved != 0     ? ""
                                              : o.reserved_2 != 0 ? "_2"
                                                                  : "_3") +
                                             " is set, must be 0");
    if (o.budget_bytes < 0)
        throw Error(Status::argument,
                    "options->budget_bytes = " + std::to_string(o.budget_bytes) + ", must be >= 0");
    options.budget.bytes = o.budget_bytes;
    if (o.skin != 0 && !(o.skin >= 1e-100 && o.skin <= 1e100))
        throw Error(Status::argument, "options->skin = " + std::to_string(o.skin) +
                                          ", must be 0 or in [1e-100, 1e100]");
    options.skin = o.skin;
    read_arrays(o, options);
    check_combination(options, o.active != nullptr);
    return options;
}

bool connectivity::capi::names_active(const conn_map_options* given) {
    return given != nullptr &&
           read_struct(given, conn_map_options CONN_MAP_OPTIONS_INIT, "options").active != nullptr;
}

conn_status conn_map_options_init(conn_map_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_map_options CONN_MAP_OPTIONS_INIT, "options");
    });
}

conn_status conn_map_set_options(conn_map* map, const conn_map_options* options) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        MapOptions next = read_options(options);
        if (options != nullptr && read_index_base(options, "options") != ours.base)
            throw Error(Status::argument,
                        "options->index_base is not that of the map, which keeps it for good: it "
                        "counts from " +
                            std::to_string(ours.base.out(0)));
        next.exclude = ours.options.exclude;
        ours.names_active = names_active(options);
        ours.options = std::move(next);
    });
}

conn_status conn_map_set_exclusion(conn_map* map, conn_pair_predicate predicate, void* user_data) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        if (predicate == nullptr)
            ours.options.exclude = nullptr;
        else
            ours.options.exclude = std::make_shared<const PairPredicate>(
                HostPredicate{predicate, user_data, ours.base});
    });
}
