// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "arguments.hpp"
#include "arrays.hpp"
#include "guard.hpp"
#include "objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

/// The storage itself if it is large enough, else a larger one.
View<double> with_room(const View<double>& storage, const char* label, Offset n) {
    const auto capacity = static_cast<Offset>(storage.size());
    if (n <= capacity) return storage;
    return allocate<double>(label, capacity > 0 ? n + n / 4 : n);
}

ConstView<double> front(const View<double>& storage, Offset n) {
    return Kokkos::subview(storage, std::pair<std::size_t, std::size_t>(0, n));
}

/// Everything that can fail happens before the first byte is overwritten.
void set_nodes(conn_nodes& nodes, Offset n_internal, const Columns& x, const Columns& support,
               bool is_tensor) {
    if (support.n != x.n)
        throw Error(Status::argument, std::string(is_tensor ? "tensor" : "h") + " has " +
                                          std::to_string(support.n) + " nodes, must have " +
                                          std::to_string(x.n) + " as positions");
    const View<double> positions =
        with_room(nodes.positions, "nodes/positions", x.n * x.n_components);
    const View<double> supports =
        with_room(nodes.support, "nodes/support", x.n * support.n_components);
    const auto shape = is_tensor ? NodeList::with_H : NodeList::with_h;
    NodeList list = shape(nodes.name, nodes.dim, n_internal, front(positions, x.n * x.n_components),
                          front(supports, x.n * support.n_components), nodes.kernel_extent);
    copy_columns(x, positions.data());
    copy_columns(support, supports.data());
    nodes.positions = positions;
    nodes.support = supports;
    nodes.list = std::move(list);
}

/// The same nodes on the same storage.
NodeList without_ids(const NodeList& list) {
    return list.has_tensor() ? NodeList::with_H(list.name(), list.dim(), list.n_internal(),
                                                list.positions(), list.H(), list.kernel_extent())
                             : NodeList::with_h(list.name(), list.dim(), list.n_internal(),
                                                list.positions(), list.h(), list.kernel_extent());
}

/// One for each, or none at all. Throws Error{argument | null}.
void check_names(const void* values, std::int64_t n, Offset n_nodes, const std::string& name,
                 const std::string& count) {
    check_count(values, n, max_slots, name, count);
    if (n != 0 && n != n_nodes)
        throw Error(Status::argument, count + " = " + std::to_string(n) + ", must be 0 or " +
                                          std::to_string(n_nodes) + " as in the list");
}

/// Throws Error{argument} for the first ghost with an owner that is no internal node.
void check_owners(const NodeList& list, const std::int32_t* owner, std::int64_t n_ghosts) {
    for (std::int64_t g = 0; g < n_ghosts; ++g)
        if (owner[g] < -1 || owner[g] >= list.n_internal())
            throw Error(Status::argument, "owner[" + std::to_string(g) +
                                              "] = " + std::to_string(owner[g]) +
                                              ", must be -1 or an internal node, in [0, " +
                                              std::to_string(list.n_internal()) + ")");
}

template <class T>
View<T> copy_of(const char* label, const T* values, std::int64_t n) {
    const View<T> copy = allocate<T>(label, n);
    std::copy_n(values, n, copy.data());
    return copy;
}

}  // namespace

conn_status conn_nodes_create(conn_context* context, const char* name, int32_t dim,
                              double kernel_extent, conn_nodes** nodes) {
    return guarded_with_runtime(__func__, [&] {
        Registry::instance().get<conn_context>(context, "context");
        if (nodes == nullptr) throw Error(Status::null, "nodes is NULL");
        auto made = std::make_unique<conn_nodes>();
        made->name = read_name(name);
        if (dim < 1 || dim > 3)
            throw Error(Status::argument, "dim = " + std::to_string(dim) + ", must be 1, 2 or 3");
        check_kernel_extent(made->name, kernel_extent);
        made->dim = dim;
        made->kernel_extent = kernel_extent;
        *nodes = Registry::instance().add(std::move(made));
    });
}

conn_status conn_nodes_destroy(conn_nodes** nodes) {
    return guarded(__func__, [&] { Registry::instance().destroy(nodes, "nodes"); });
}

conn_status conn_nodes_set_h(conn_nodes* nodes, int64_t n_internal, const conn_array* positions,
                             int32_t n_positions, const conn_array* h) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_nodes>(nodes, "nodes");
        const Columns x = read_columns(positions, n_positions, ours.dim, "positions");
        set_nodes(ours, n_internal, x, read_columns(h, 1, 1, "h"), false);
    });
}

conn_status conn_nodes_set_tensor(conn_nodes* nodes, int64_t n_internal,
                                  const conn_array* positions, int32_t n_positions,
                                  const conn_array* tensor, int32_t n_tensor) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_nodes>(nodes, "nodes");
        const Columns x = read_columns(positions, n_positions, ours.dim, "positions");
        set_nodes(ours, n_internal, x,
                  read_columns(tensor, n_tensor, n_symmetric(ours.dim), "tensor"), true);
    });
}

conn_status conn_nodes_set_ids(conn_nodes* nodes, const int64_t* global_ids, int64_t n,
                               const int32_t* owner, int64_t n_ghosts) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_nodes>(nodes, "nodes");
        if (!ours.list)
            throw Error(Status::argument,
                        "nodes (\"" + ours.name + "\") was never set; give positions first");
        NodeList list = without_ids(*ours.list);
        check_names(global_ids, n, list.n(), "global_ids", "n");
        check_names(owner, n_ghosts, list.n_ghosts(), "owner", "n_ghosts");
        check_owners(list, owner, n_ghosts);
        if (n > 0) list.set_global_ids(copy_of("nodes/global_ids", global_ids, n));
        if (n_ghosts > 0) list.set_owners(copy_of("nodes/owners", owner, n_ghosts));
        ours.list = std::move(list);
    });
}

conn_status conn_nodes_size(const conn_nodes* nodes, int64_t* n, int64_t* n_internal) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_nodes>(nodes, "nodes");
        if (n != nullptr) *n = ours.list ? ours.list->n() : 0;
        if (n_internal != nullptr) *n_internal = ours.list ? ours.list->n_internal() : 0;
    });
}
