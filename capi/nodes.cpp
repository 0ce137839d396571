// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "arrays.hpp"
#include "guard.hpp"
#include "objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

constexpr std::size_t max_name = 255;

std::string read_name(const char* name) {
    if (name == nullptr) throw Error(Status::null, "name is NULL");
    const std::size_t length = strnlen(name, max_name + 1);
    if (length == 0 || length > max_name)
        throw Error(Status::argument, "name has " + std::string(length == 0 ? "no" : "too many") +
                                          " bytes, must have 1 to " + std::to_string(max_name));
    return {name, length};
}

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

conn_status conn_nodes_size(const conn_nodes* nodes, int64_t* n, int64_t* n_internal) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_nodes>(nodes, "nodes");
        if (n != nullptr) *n = ours.list ? ours.list->n() : 0;
        if (n_internal != nullptr) *n_internal = ours.list ? ours.list->n_internal() : 0;
    });
}
