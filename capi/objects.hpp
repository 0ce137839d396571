// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the opaque handles of connectivity.h are.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <connectivity/boundary/boundaries.hpp>
#include <connectivity/map/connectivity_map.hpp>
#include <connectivity/map/neighbour_query.hpp>
#include <connectivity/map/row_pairs.hpp>

#include "connectivity.h"
#include "pair_values.hpp"
#include "registry.hpp"

struct conn_context final : connectivity::capi::Handle {
    std::int64_t budget_bytes = 0;

    const char* kind() const noexcept override { return "a context"; }
    void drop_views() noexcept override {}
};

struct conn_nodes final : connectivity::capi::Handle {
    std::string name;
    int dim = 3;
    double kernel_extent = 2;
    connectivity::View<double> positions, support;  ///< storage, possibly larger than needed
    std::optional<connectivity::NodeList> list;     ///< on that storage; none before the first set

    const char* kind() const noexcept override { return "a node list"; }
    void drop_views() noexcept override {
        list.reset();
        positions = {};
        support = {};
    }
};

struct conn_map final : connectivity::capi::Handle {
    std::int64_t context_budget = 0;
    connectivity::MapOptions options;                                 ///< of the next rebuild
    std::optional<connectivity::ConnectivityMap> map{std::in_place};  ///< none after Kokkos stopped
    connectivity::RowPairs row_pairs;  ///< of the last sum along rows

    const char* kind() const noexcept override { return "a map"; }
    void drop_views() noexcept override {
        map.reset();
        options.active = {};
        row_pairs = {};
    }
};

struct conn_pair_field final : connectivity::capi::Handle {
    connectivity::capi::PairValues values;

    explicit conn_pair_field(int n_components) : values(n_components) {}
    const char* kind() const noexcept override { return "a pair field"; }
    void drop_views() noexcept override { values.clear(); }
};

struct conn_boundaries final : connectivity::capi::Handle {
    std::optional<connectivity::Boundaries> boundaries;  ///< none after Kokkos stopped

    explicit conn_boundaries(int dim) : boundaries(dim) {}
    const char* kind() const noexcept override { return "boundaries"; }
    void drop_views() noexcept override { boundaries.reset(); }
};

struct conn_query final : connectivity::capi::Handle {
    connectivity::NeighbourQuery query;

    const char* kind() const noexcept override { return "a query"; }
    void drop_views() noexcept override { query = {}; }
};

namespace connectivity::capi {

/// One of CONN_GATHER, ...; `name` is the argument's. Throws Error{argument}.
SearchMode read_mode(std::int32_t mode, const std::string& name);

/// Periodic axes and box alone; NULL means open. Throws Error{argument | struct_size |
/// unsupported}.
Domain read_domain(const conn_map_options* given, const char* name);

/// Checked and copied; NULL means the defaults. Throws Error{argument | null | struct_size |
/// unsupported | memory}.
MapOptions read_options(const conn_map_options* given);

/// Options of the next rebuild, the context's budget where the map has none of its own.
MapOptions options_of(const conn_map& map);

/// The lists of the host, as the C++ side takes them. Throws Error{argument | too_many | null |
/// handle}.
std::vector<NodeList> read_lists(conn_nodes* const* lists, std::int32_t n_lists);

/// Owners of acquired views: they hold the storage and the offsets of the lists.
struct RowsPin final : Handle {
    RowsView<> rows;
    std::vector<Offset> list_offset, row_offset;

    const char* kind() const noexcept override { return "the owner of a rows view"; }
    void drop_views() noexcept override { rows = {}; }
};

struct PairsPin final : Handle {
    NodePairList::View<> pairs;
    std::vector<Offset> list_offset;

    const char* kind() const noexcept override { return "the owner of a pairs view"; }
    void drop_views() noexcept override { pairs = {}; }
};

struct IntersectionPin final : Handle {
    IntersectionView<> nodes;

    const char* kind() const noexcept override { return "the owner of an intersection view"; }
    void drop_views() noexcept override { nodes = {}; }
};

}  // namespace connectivity::capi
