// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the opaque handles of connectivity.h are.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <connectivity/map/connectivity_map.hpp>

#include "connectivity.h"
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

    const char* kind() const noexcept override { return "a map"; }
    void drop_views() noexcept override { map.reset(); }
};

namespace connectivity::capi {

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

}  // namespace connectivity::capi
