// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the opaque handles of connectivity.h are.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include <connectivity/boundary/boundaries.hpp>
#include <connectivity/map/connectivity_map.hpp>
#include <connectivity/map/neighbour_query.hpp>
#include <connectivity/map/row_pairs.hpp>

#include "connectivity_boundary.h"
#include "index_base.hpp"
#include "log.hpp"
#include "pair_values.hpp"
#include "registry.hpp"

struct conn_context final : connectivity::capi::Handle {
    std::int64_t budget_bytes = 0;
    std::shared_ptr<connectivity::capi::Log> log = std::make_shared<connectivity::capi::Log>();

    ~conn_context() override { *log = {}; }
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
    const std::uint64_t number;  ///< unique in the process
    const connectivity::capi::IndexBase base;
    const std::shared_ptr<const connectivity::capi::Log> log;
    const std::int64_t context_budget;
    connectivity::MapOptions options;  ///< of the next rebuild
    bool names_active = false;         ///< the host gave active nodes, perhaps none
    std::optional<connectivity::ConnectivityMap> map{std::in_place};  ///< none after Kokkos stopped
    connectivity::RowPairs row_pairs;  ///< of the last sum along rows
    mutable connectivity::capi::BasedLists based;
    mutable connectivity::Offset high_water = 0;       ///< bytes
    mutable connectivity::Offset held_when_noted = 0;  ///< bytes without those of old views

    conn_map(const conn_context& context, connectivity::capi::IndexBase index_base);
    const char* kind() const noexcept override { return "a map"; }
    void drop_views() noexcept override {
        map.reset();
        options.active = {};
        row_pairs = {};
        based = {};
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
    connectivity::capi::IndexBase base;  ///< of the last update

    const char* kind() const noexcept override { return "a query"; }
    void drop_views() noexcept override { query = {}; }
};

namespace connectivity::capi {

/// One of CONN_GATHER, ...; `name` is the argument's. Throws Error{argument}.
SearchMode read_mode(std::int32_t mode, const std::string& name);

/// Periodic axes and box alone; NULL means open. Throws Error{argument | struct_size |
/// unsupported}.
Domain read_domain(const conn_map_options* given, const char* name);

/// The index_base alone; NULL means 0. Throws as read_domain.
IndexBase read_index_base(const conn_map_options* given, const std::string& name);

/// Checked and copied; NULL means the defaults. Throws Error{argument | null | struct_size |
/// unsupported | memory}.
MapOptions read_options(const conn_map_options* given);

/// Whether active nodes are given: on a rank without nodes, an array of none.
bool names_active(const conn_map_options* given);

/// Options of the next rebuild, the context's budget where the map has none of its own. Throws
/// Error{argument} if an array of no active nodes stands beside lists that have some.
MapOptions options_of(const conn_map& map, std::span<const NodeList> lists);

/// The lists of the host, as the C++ side takes them. Throws Error{argument | too_many | null |
/// handle}.
std::vector<NodeList> read_lists(conn_nodes* const* lists, std::int32_t n_lists);

/// Throws Error{argument}, Error{unsupported} for a space that no list of this build is in.
void check_space(std::int32_t space);

/// i [n_pairs]: the first node of every pair.
void write_first_nodes(const NodePairList::View<>& pairs, IndexBase base, Slot* i);

/// Owners of acquired views: they hold the storage and the offsets of the lists.
struct ViewPin : Handle {
    std::uint64_t map_number = 0;
    Generation generation = 0;

    ViewPin() { live().insert(this); }
    ~ViewPin() override { live().erase(this); }
    ViewPin(const ViewPin&) = delete;
    ViewPin& operator=(const ViewPin&) = delete;
    /// All there are, of all maps; used under the call mutex.
    static std::unordered_set<const ViewPin*>& live() {
        static auto* const leaked = new std::unordered_set<const ViewPin*>;
        return *leaked;
    }

    using ArrayFunction = std::function<void(const void* data, std::size_t bytes)>;
    /// f for every array it holds.
    virtual void for_each_array(const ArrayFunction& f) const = 0;

protected:
    template <class Array>
    static void tell(const ArrayFunction& f, const Array& array) {
        f(array.data(), array.size() * sizeof *array.data());
    }
};

struct RowsPin final : ViewPin {
    RowsView<> rows;
    std::vector<Offset> list_offset, row_offset;

    const char* kind() const noexcept override { return "the owner of a rows view"; }
    void drop_views() noexcept override { rows = {}; }
    void for_each_array(const ArrayFunction& f) const override {
        tell(f, rows.offsets), tell(f, rows.slots);
    }
};

struct PairsPin final : ViewPin {
    NodePairList::View<> pairs;
    std::vector<Offset> list_offset;

    const char* kind() const noexcept override { return "the owner of a pairs view"; }
    void drop_views() noexcept override { pairs = {}; }
    void for_each_array(const ArrayFunction& f) const override {
        tell(f, pairs.offsets), tell(f, pairs.i), tell(f, pairs.j), tell(f, pairs.coupling);
        tell(f, pairs.slots), tell(f, pairs.ranks);
    }
};

struct IntersectionPin final : ViewPin {
    IntersectionView<> nodes;

    const char* kind() const noexcept override { return "the owner of an intersection view"; }
    void drop_views() noexcept override { nodes = {}; }
    void for_each_array(const ArrayFunction& f) const override {
        tell(f, nodes.offsets), tell(f, nodes.slots);
    }
};

}  // namespace connectivity::capi
