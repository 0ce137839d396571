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

/// An array for some nodes of the list, all of which it must have. Throws Error{argument | ...}.
WholeNumbers read_names(const conn_array& array, Offset n_nodes, const std::string& name) {
    const WholeNumbers numbers(array, name);
    if (numbers.size() != n_nodes)
        throw Error(Status::argument, name + " has " + std::to_string(numbers.size()) +
                                          " values, must have " + std::to_string(n_nodes) +
                                          " as in the list");
    return numbers;
}

View<std::int64_t> read_global_ids(const conn_array& array, const NodeList& list) {
    const WholeNumbers ids = read_names(array, list.n(), "global_ids");
    const auto copy = allocate<std::int64_t>("nodes/global_ids", ids.size());
    for (Offset k = 0; k < ids.size(); ++k) copy(k) = ids[k];
    return copy;
}

/// Throws Error{argument} for the first ghost with an owner that is no internal node, too.
View<Slot> read_owners(const conn_array& array, const NodeList& list) {
    const WholeNumbers owner = read_names(array, list.n_ghosts(), "owner");
    const auto copy = allocate<Slot>("nodes/owners", owner.size());
    for (Offset g = 0; g < owner.size(); ++g) {
        if (owner[g] < -1 || owner[g] >= list.n_internal())
            throw Error(Status::argument,
                        "owner[" + std::to_string(g) + "] = " + std::to_string(owner[g]) +
                            ", must be -1 or an internal node, counted from 0, in [0, " +
                            std::to_string(list.n_internal()) + ")");
        copy(g) = static_cast<Slot>(owner[g]);
    }
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

conn_status conn_nodes_set_ids(conn_nodes* nodes, const conn_array* global_ids,
                               const conn_array* owner) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_nodes>(nodes, "nodes");
        if (!ours.list)
            throw Error(Status::argument,
                        "nodes (\"" + ours.name + "\") was never set; give positions first");
        NodeList list = without_ids(*ours.list);
        if (global_ids != nullptr) list.set_global_ids(read_global_ids(*global_ids, list));
        if (owner != nullptr) list.set_owners(read_owners(*owner, list));
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
