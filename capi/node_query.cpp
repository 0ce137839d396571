// SPDX-License-Identifier: BSD-3-Clause
#include "connectivity_query.h"

#include <connectivity/map/validate.hpp>

#include "arguments.hpp"
#include "guard.hpp"
#include "objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

const conn_query& handle_of(const conn_query* handle) {
    return Registry::instance().get<const conn_query>(handle, "query");
}

/// An array [n] of the host.
std::span<const double> read_values(const double* values, int n, const std::string& name) {
    return {&required(values, name), static_cast<std::size_t>(n)};
}

QueryPoint read_point(int dim, const double* x, double h, const double* tensor) {
    QueryPoint point;
    std::ranges::copy(read_values(x, dim, "x"), point.x.begin());
    if (tensor == nullptr)
        point.h = h;
    else
        point.H = {tensor, static_cast<std::size_t>(n_symmetric(dim))};
    return point;
}

/// `who` is a slot or a point; their number alone needs no list.
template <class Who>
void neighbours_out(const conn_query& handle, const Who& who, SearchMode mode, int32_t* slots,
                    int64_t capacity, int64_t* count) {
    required(count, "count");
    if (slots == nullptr)
        *count = handle.query.count(who, mode);
    else
        copy_nodes_out(handle.query.neighbours(who, mode), handle.base, slots, capacity, count);
}

std::vector<Slot> QueryCandidates::*read_which(std::int32_t which) {
    switch (which) {
        case CONN_CANDIDATES_MASTER: return &QueryCandidates::master;
        case CONN_CANDIDATES_COARSE: return &QueryCandidates::coarse;
        case CONN_CANDIDATES_REFINE: return &QueryCandidates::refine;
        default:
            throw Error(Status::argument,
                        "which = " + std::to_string(which) + ", must be one of CONN_CANDIDATES_*");
    }
}

std::string text_of(const std::vector<MapCheck>& checks) {
    std::string text;
    for (const MapCheck& check : checks)
        text += check.passed ? "ok " + check.name + "\n"
                             : "FAILED " + check.name + ": " + check.first + "\n";
    return text;
}

}  // namespace

conn_status conn_map_validate(const conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                              int32_t* n_failed, char* text, int64_t capacity, int64_t* length) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_map>(map, "map");
        required(n_failed, "n_failed");
        const std::vector<MapCheck> checks = validate(*ours.map, read_lists(lists, n_lists));
        const std::string lines = text_of(checks);
        const auto n_bytes = static_cast<std::int64_t>(lines.size());
        *n_failed = static_cast<std::int32_t>(std::ranges::count(checks, false, &MapCheck::passed));
        if (length != nullptr) *length = n_bytes;
        if (text == nullptr) return;
        check_capacity(capacity, n_bytes + 1);
        std::copy_n(lines.c_str(), n_bytes + 1, text);
    });
}

conn_status conn_query_create(conn_context* context, conn_query** query) {
    return guarded_with_runtime(__func__, [&] {
        Registry::instance().get<conn_context>(context, "context");
        required(query, "query") = Registry::instance().add(std::make_unique<conn_query>());
    });
}

conn_status conn_query_destroy(conn_query** query) {
    return guarded(__func__, [&] { Registry::instance().destroy(query, "query"); });
}

conn_status conn_query_update(conn_query* query, conn_nodes* const* lists, int32_t n_lists,
                              const conn_map_options* domain) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_query>(query, "query");
        const IndexBase base = read_index_base(domain, "domain");
        ours.query.update(read_lists(lists, n_lists), read_domain(domain, "domain"));
        ours.base = base;
    });
}

conn_status conn_query_neighbours(const conn_query* query, int32_t node_slot, int32_t mode,
                                  int32_t* slots, int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        neighbours_out(ours, ours.base.in(node_slot), read_mode(mode, "mode"), slots, capacity,
                       count);
    });
}

conn_status conn_query_neighbours_at(const conn_query* query, const double* x, double h,
                                     const double* tensor, int32_t mode, int32_t* slots,
                                     int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        neighbours_out(ours, read_point(ours.query.dim(), x, h, tensor), read_mode(mode, "mode"),
                       slots, capacity, count);
    });
}

conn_status conn_query_candidates(const conn_query* query, int32_t node_slot, int32_t mode,
                                  int32_t which, int32_t* slots, int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        const auto step = read_which(which);
        copy_nodes_out(
            ours.query.candidates(ours.base.in(node_slot), read_mode(mode, "mode")).*step,
            ours.base, slots, capacity, count);
    });
}

conn_status conn_query_near_box(const conn_query* query, const double* lo, const double* hi,
                                int32_t mode, int32_t* slots, int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        const int dim = ours.query.dim();
        copy_nodes_out(ours.query.near_box(read_values(lo, dim, "lo"), read_values(hi, dim, "hi"),
                                           read_mode(mode, "mode")),
                       ours.base, slots, capacity, count);
    });
}

conn_status conn_query_near_plane(const conn_query* query, const double* point,
                                  const double* normal, double distance, int32_t mode,
                                  int32_t* slots, int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        const int dim = ours.query.dim();
        copy_nodes_out(ours.query.near_plane(read_values(point, dim, "point"),
                                             read_values(normal, dim, "normal"), distance,
                                             read_mode(mode, "mode")),
                       ours.base, slots, capacity, count);
    });
}

conn_status conn_query_periodic_shift(const conn_query* query, int32_t i, int32_t j,
                                      double shift[3]) {
    return guarded_with_runtime(__func__, [&] {
        const conn_query& ours = handle_of(query);
        required(shift, "shift");
        std::ranges::copy(ours.query.periodic_shift(ours.base.in(i), ours.base.in(j)), shift);
    });
}
