// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "arguments.hpp"
#include "guard.hpp"
#include "map_work.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

Boundaries& boundaries_of(conn_boundaries* handle) {
    return *Registry::instance().get<conn_boundaries>(handle, "boundaries").boundaries;
}
const Boundaries& boundaries_of(const conn_boundaries* handle) {
    return *Registry::instance().get<const conn_boundaries>(handle, "boundaries").boundaries;
}

/// Plane k of those that stand one after the other: a point and a normal.
Plane read_plane(const double* planes, int dim, int k) {
    const auto n = static_cast<std::size_t>(dim);
    const double* const point = planes + 2 * n * static_cast<std::size_t>(k);
    return Plane(dim, {point, n}, {point + n, n});
}

Boundary read_boundary(std::int32_t kind, const std::string& name, const double* planes, int dim) {
    if (kind != CONN_BOUNDARY_REFLECTING && kind != CONN_BOUNDARY_PERIODIC)
        throw Error(Status::argument,
                    "kind = " + std::to_string(kind) +
                        ", must be CONN_BOUNDARY_REFLECTING or CONN_BOUNDARY_PERIODIC");
    required(planes, "planes");
    const Plane first = read_plane(planes, dim, 0);
    if (kind == CONN_BOUNDARY_REFLECTING) return Boundary::reflecting(name, first);
    return Boundary::periodic(name, first, read_plane(planes, dim, 1));
}

GhostOptions read_ghost_options(std::int32_t how) {
    switch (how) {
        case CONN_GHOSTS_KEEP: return {false, CullRule::controls_as_made};
        case CONN_GHOSTS_CULL: return {true, CullRule::controls_as_made};
        case CONN_GHOSTS_CULL_MOST: return {true, CullRule::controls_of_kept};
        default:
            throw Error(Status::argument,
                        "how = " + std::to_string(how) + ", must be one of CONN_GHOSTS_*");
    }
}

const NodeList& list_of(const Boundaries& boundaries, std::int32_t list) {
    const auto n_lists = static_cast<std::int64_t>(boundaries.lists().size());
    if (list < 0 || list >= n_lists)
        throw Error(Status::argument, "list = " + std::to_string(list) + ", must be in [0, " +
                                          std::to_string(n_lists) +
                                          "), the lists of the last update");
    return boundaries.lists()[static_cast<std::size_t>(list)];
}

FieldKind read_kind(std::int32_t kind) {
    switch (kind) {
        case CONN_FIELD_SCALAR: return FieldKind::scalar;
        case CONN_FIELD_VECTOR: return FieldKind::vector;
        case CONN_FIELD_TENSOR: return FieldKind::tensor;
        default:
            throw Error(Status::argument,
                        "kind = " + std::to_string(kind) + ", must be one of CONN_FIELD_*");
    }
}

void check_components(FieldKind kind, std::int32_t n_components, int dim) {
    const int needed = kind == FieldKind::vector   ? dim
                       : kind == FieldKind::tensor ? n_symmetric(dim)
                                                   : 0;
    if (needed > 0 ? n_components != needed : n_components < 1)
        throw Error(Status::argument, "n_components = " + std::to_string(n_components) +
                                          ", must be " +
                                          (needed > 0 ? std::to_string(needed) : "at least 1"));
}

}  // namespace

conn_status conn_boundaries_create(conn_context* context, int32_t dim,
                                   conn_boundaries** boundaries) {
    return guarded_with_runtime(__func__, [&] {
        Registry::instance().get<conn_context>(context, "context");
        conn_boundaries*& out = required(boundaries, "boundaries");
        out = Registry::instance().add(std::make_unique<conn_boundaries>(dim));
    });
}

conn_status conn_boundaries_destroy(conn_boundaries** boundaries) {
    return guarded(__func__, [&] { Registry::instance().destroy(boundaries, "boundaries"); });
}

conn_status conn_boundaries_add(conn_boundaries* boundaries, int32_t kind, const char* name,
                                const double* planes, int32_t may_cull) {
    return guarded_with_runtime(__func__, [&] {
        Boundaries& ours = boundaries_of(boundaries);
        Boundary boundary = read_boundary(kind, read_name(name), planes, ours.dim());
        if (!read_flag(may_cull, "may_cull")) boundary.keep_all_ghosts();
        ours.add(std::move(boundary));
    });
}

conn_status conn_boundaries_update(conn_boundaries* boundaries, conn_map* map,
                                   conn_nodes* const* lists, int32_t n_lists, int32_t how) {
    return guarded_with_runtime(__func__, [&] {
        Boundaries& ours = boundaries_of(boundaries);
        const std::vector<NodeList> nodes = read_lists(lists, n_lists);
        if (how == CONN_GHOSTS_REFRESH) {
            if (map != nullptr)
                throw Error(Status::argument,
                            "map must be NULL with CONN_GHOSTS_REFRESH: its lists stay");
            return ours.refresh(nodes);
        }
        const GhostOptions ghosts = read_ghost_options(how);
        auto& handle = Registry::instance().get<conn_map>(map, "map");
        work_on(handle, "boundaries", [&] {
            if (handle.names_active)
                throw Error(Status::argument,
                            "the option active of the map must be NULL: it cannot know the ghosts");
            ours.update(*handle.map, nodes, options_of(handle, nodes), ghosts);
        });
    });
}

conn_status conn_boundaries_get_nodes(const conn_boundaries* boundaries, int32_t list,
                                      conn_boundary_nodes* nodes) {
    return guarded_with_runtime(__func__, [&] {
        const NodeList& ours = list_of(boundaries_of(boundaries), list);
        conn_boundary_nodes out =
            read_struct(nodes, conn_boundary_nodes CONN_BOUNDARY_NODES_INIT, "nodes");
        out.n = ours.n();
        out.n_internal = ours.n_internal();
        out.x = ours.positions().data();
        out.h = ours.has_tensor() ? nullptr : ours.h().data();
        out.H = ours.has_tensor() ? ours.H().data() : nullptr;
        out.owner = ours.owners().size() > 0 ? ours.owners().data() : nullptr;
        out.global_id = ours.global_ids().size() > 0 ? ours.global_ids().data() : nullptr;
        write_struct(nodes, out, out.struct_size);
    });
}

conn_status conn_boundaries_fill_ghosts(const conn_boundaries* boundaries, int32_t list,
                                        int32_t kind, double* values, int64_t n,
                                        int32_t n_components) {
    return guarded_with_runtime(__func__, [&] {
        const Boundaries& ours = boundaries_of(boundaries);
        const Offset n_nodes = list_of(ours, list).n();
        const FieldKind how = read_kind(kind);
        check_components(how, n_components, ours.dim());
        if (n != n_nodes)
            throw Error(Status::argument, "n = " + std::to_string(n) + ", must be " +
                                              std::to_string(n_nodes) +
                                              ", all nodes of the list with its ghosts");
        if (n > 0) required(values, "values");
        const View<double> field(values, static_cast<std::size_t>(n * n_components));
        ours.fill_ghosts(list, {how, field, n_components});
    });
}
