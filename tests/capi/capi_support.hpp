// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the tests of the C interface share: node sets as plain vectors, their lists by brute force,
/// and the same lists read through the interface. Nothing here includes the library's C++ headers.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity.h>

namespace connectivity::test {

/// A node list; H or h, whichever is not empty. An empty list has neither.
struct NodeSet {
    std::vector<double> x;         ///< [n * dim]
    std::vector<double> h;         ///< [n]
    std::vector<double> H;         ///< [n * dim * (dim + 1) / 2]
    std::int64_t n_internal = -1;  ///< -1: all
    double extent = 2;
    std::string name = "nodes";
};

/// Box of random nodes in [0, 1]^dim with supports that reach a few neighbours.
NodeSet random_nodes(int dim, int n, std::uint64_t seed, bool is_tensor = false);

/// Rows and pairs in slots.
struct Lists {
    std::vector<std::vector<std::int32_t>> rows;               ///< by row number
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  ///< sorted
    bool operator==(const Lists&) const = default;
};

/// Every node against every other, from the definition; rows of internal nodes, open box.
Lists brute_force(int dim, const std::vector<NodeSet>& sets, int mode = CONN_GATHER_SCATTER);

/// What a map holds now. Fails the test if it cannot be read.
Lists read_lists(conn_map* map);

/// Success, or the text of the last error.
::testing::AssertionResult ok(conn_status status);

/// The status that was expected, with these words in the text of the last error.
::testing::AssertionResult fails(conn_status status, conn_status expected,
                                 const std::vector<std::string>& words = {});

/// Owners of handles, for tests that are not about their lives.
struct Context {
    conn_context* handle = nullptr;
    explicit Context(int n_threads = 2);
    ~Context() { conn_context_destroy(&handle); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
};

struct Nodes {
    conn_nodes* handle = nullptr;
    Nodes(const Context& context, int dim, double extent = 2, const char* name = "nodes");
    Nodes(const Context& context, int dim, const NodeSet& set);
    ~Nodes() { conn_nodes_destroy(&handle); }
    Nodes(const Nodes&) = delete;
    Nodes& operator=(const Nodes&) = delete;

    /// Interleaved arrays of the set.
    conn_status set(int dim, const NodeSet& set) const;
};

struct Map {
    conn_map* handle = nullptr;
    explicit Map(const Context& context, const conn_map_options& options = CONN_MAP_OPTIONS_INIT);
    ~Map() { conn_map_destroy(&handle); }
    Map(const Map&) = delete;
    Map& operator=(const Map&) = delete;

    conn_status rebuild(const std::vector<conn_nodes*>& lists) const;
    std::uint64_t generation() const;
};

/// Rebuilds a map over the sets and reads it.
Lists lists_of(const Context& context, int dim, const std::vector<NodeSet>& sets,
               const conn_map_options& options = CONN_MAP_OPTIONS_INIT);

}  // namespace connectivity::test
