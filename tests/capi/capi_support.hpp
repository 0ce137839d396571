// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the tests of the C interface share: node sets as plain vectors, their lists by brute force,
/// and the same lists read through the interface. Nothing here includes the library's C++ headers.

#include <array>
#include <cstdint>
#include <memory>
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

/// What views hold; pairs name their first node, also in key order.
std::vector<std::vector<std::int32_t>> rows_of(const conn_rows_view& view);
std::vector<std::pair<std::int32_t, std::int32_t>> pairs_of(const conn_pairs_view& view);

/// What a map holds now. Fails the test if it cannot be read.
Lists read_lists(conn_map* map);

/// Success, or the text of the last error.
::testing::AssertionResult ok(conn_status status);

/// The status that was expected, with these words in the text of the last error.
::testing::AssertionResult fails(conn_status status, conn_status expected,
                                 const std::vector<std::string>& words = {});

/// A result by the two-call pattern, call(buffer, capacity, count); a buffer that is too small by
/// one is refused and told the size.
template <class T, class Call>
std::vector<T> two_calls(const Call& call) {
    std::int64_t count = -1, again = -1;
    EXPECT_TRUE(ok(call(static_cast<T*>(nullptr), 0, &count)));
    std::vector<T> values(static_cast<std::size_t>(count) + 1);
    if (count > 0) {
        EXPECT_TRUE(
            fails(call(values.data(), count - 1, &again), CONN_E_BUFFER, {std::to_string(count)}));
        EXPECT_EQ(again, count);
    }
    EXPECT_TRUE(ok(call(values.data(), count, &again)));
    values.pop_back();
    return values;
}

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

/// Node lists of the sets and a map that was rebuilt from them.
struct Built {
    int dim;
    std::vector<std::unique_ptr<Nodes>> nodes;
    std::vector<conn_nodes*> lists;
    Map map;
    Built(const Context& context, int dimension, const std::vector<NodeSet>& sets,
          const conn_map_options& options = CONN_MAP_OPTIONS_INIT);

    conn_status rebuild() const { return map.rebuild(lists); }
    conn_status rebuild(const conn_map_options& options) const;
};

/// Names and owners one after the other; none of those that are empty.
conn_status set_ids(conn_nodes* nodes, const std::vector<std::int64_t>& global_ids,
                    const std::vector<std::int32_t>& owner = {});

/// Rebuilds a map over the sets and reads it.
Lists lists_of(const Context& context, int dim, const std::vector<NodeSet>& sets,
               const conn_map_options& options = CONN_MAP_OPTIONS_INIT);

}  // namespace connectivity::test
