// SPDX-License-Identifier: BSD-3-Clause
#include "capi_support.hpp"

#include <algorithm>
#include <cmath>

#include <support/random.hpp>

namespace connectivity::test {

namespace {

/// All sets laid end to end.
struct Joined {
    int dim;
    double extent = 0;
    std::vector<const double*> x, h, H;  ///< by slot; h or H is NULL
    std::vector<bool> is_internal;

    Joined(int dimension, const std::vector<NodeSet>& sets) : dim(dimension) {
        const std::size_t d = dimension, n_tensor = d * (d + 1) / 2;
        for (const NodeSet& set : sets) {
            extent = std::max(extent, set.extent);
            const std::size_t n = set.x.size() / d;
            for (std::size_t a = 0; a < n; ++a) {
                x.push_back(&set.x[a * d]);
                h.push_back(set.h.empty() ? nullptr : &set.h[a]);
                H.push_back(set.H.empty() ? nullptr : &set.H[a * n_tensor]);
                is_internal.push_back(set.n_internal < 0 ||
                                      a < static_cast<std::size_t>(set.n_internal));
            }
        }
    }

    bool sees(std::size_t i, std::size_t j) const {
        double r[3], r2 = 0, eta2 = 0;
        for (int d = 0; d < dim; ++d) {
            r[d] = x[i][d] - x[j][d];
            r2 = d == 0 ? r[d] * r[d] : r2 + r[d] * r[d];
        }
        if (h[i] != nullptr) {
            const double reach = extent * *h[i];
            return *h[i] > 0 && r2 <= reach * reach;
        }
        for (int a = 0; a < dim; ++a) {
            double e = 0;
            for (int b = 0; b < dim; ++b) {
                const int lo = std::min(a, b), hi = std::max(a, b);
                const double term = H[i][lo * dim - lo * (lo - 1) / 2 + hi - lo] * r[b];
                e = b == 0 ? term : e + term;
            }
            eta2 = a == 0 ? e * e : eta2 + e * e;
        }
        return eta2 <= extent * extent;
    }
};

}  // namespace

NodeSet random_nodes(int dim, int n, std::uint64_t seed, bool is_tensor) {
    Random random(seed);
    NodeSet set;
    const double spacing = 1 / std::pow(n, 1.0 / dim);
    for (int k = 0; k < n * dim; ++k) set.x.push_back(random.uniform());
    for (int a = 0; a < n; ++a) {
        const double h = spacing * random.uniform(0.4, 1.2);
        if (!is_tensor) {
            set.h.push_back(h);
            continue;
        }
        for (int i = 0; i < dim; ++i)  // diagonally dominant, hence positive definite
            for (int j = i; j < dim; ++j)
                set.H.push_back(i == j ? random.uniform(1, 2) / h : random.uniform(-0.4, 0.4) / h);
    }
    return set;
}

Lists brute_force(int dim, const std::vector<NodeSet>& sets, int mode) {
    const Joined all(dim, sets);
    Lists lists;
    for (std::size_t i = 0; i < all.x.size(); ++i) {
        std::vector<std::int32_t> row;
        for (std::size_t j = 0; j < all.x.size(); ++j) {
            if (j == i) continue;
            const bool gather = (mode & CONN_GATHER) != 0 && all.sees(i, j);
            const bool scatter = (mode & CONN_SCATTER) != 0 && all.sees(j, i);
            if (!gather && !scatter) continue;
            row.push_back(static_cast<std::int32_t>(j));
            if (j > i && (all.is_internal[i] || all.is_internal[j]))
                lists.pairs.emplace_back(static_cast<std::int32_t>(i), row.back());
        }
        if (all.is_internal[i]) lists.rows.push_back(row);
    }
    if (mode != CONN_GATHER_SCATTER) lists.pairs.clear();
    return lists;
}

std::vector<std::vector<std::int32_t>> rows_of(const conn_rows_view& view) {
    std::vector<std::vector<std::int32_t>> rows;
    for (std::int64_t r = 0; r < view.n_rows; ++r)
        rows.emplace_back(view.slots + view.offsets[r * view.n_lists],
                          view.slots + view.offsets[(r + 1) * view.n_lists]);
    return rows;
}

std::vector<std::pair<std::int32_t, std::int32_t>> pairs_of(const conn_pairs_view& view) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::int64_t r = 0; r < view.n_slots; ++r)
        for (std::int64_t k = view.offsets[r]; k < view.offsets[r + 1]; ++k)
            pairs.emplace_back(view.slots == nullptr ? static_cast<std::int32_t>(r) : view.slots[r],
                               view.j[k]);
    EXPECT_EQ(static_cast<std::int64_t>(pairs.size()), view.n_pairs);
    return pairs;
}

Lists read_lists(conn_map* map) {
    Lists lists;
    conn_rows_view rows = CONN_ROWS_VIEW_INIT;
    EXPECT_TRUE(ok(conn_map_rows_acquire(map, CONN_SPACE_HOST, &rows)));
    lists.rows = rows_of(rows);
    EXPECT_TRUE(ok(conn_map_rows_release(&rows)));
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    const conn_status status = conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &pairs);
    if (status == CONN_E_NOT_BUILT) return lists;
    EXPECT_TRUE(ok(status));
    lists.pairs = pairs_of(pairs);
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
    return lists;
}

::testing::AssertionResult ok(conn_status status) {
    if (status == CONN_OK) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "status " << status << ": " << conn_last_error();
}

::testing::AssertionResult fails(conn_status status, conn_status expected,
                                 const std::vector<std::string>& words) {
    const std::string text = conn_last_error();
    if (status != expected)
        return ::testing::AssertionFailure() << "status " << status << ", not " << expected << " ("
                                             << conn_status_text(expected) << "): " << text;
    if (text.empty()) return ::testing::AssertionFailure() << "the error has no text";
    for (const std::string& word : words)
        if (text.find(word) == std::string::npos)
            return ::testing::AssertionFailure() << "no \"" << word << "\" in: " << text;
    return ::testing::AssertionSuccess();
}

Context::Context(int n_threads) {
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.n_threads = n_threads;
    EXPECT_TRUE(ok(conn_context_create(&options, &handle)));
}

Nodes::Nodes(const Context& context, int dim, double extent, const char* name) {
    EXPECT_TRUE(ok(conn_nodes_create(context.handle, name, dim, extent, &handle)));
}

Nodes::Nodes(const Context& context, int dim, const NodeSet& from)
    : Nodes(context, dim, from.extent, from.name.c_str()) {
    EXPECT_TRUE(ok(set(dim, from)));
}

conn_status Nodes::set(int dim, const NodeSet& from) const {
    const std::int64_t n = static_cast<std::int64_t>(from.x.size()) / dim;
    const std::int64_t n_internal = from.n_internal < 0 ? n : from.n_internal;
    const conn_array x = conn_array_matrix(from.x.data(), n, dim);
    if (from.H.empty()) {
        const conn_array h = conn_array_vector(from.h.data(), n);
        return conn_nodes_set_h(handle, n_internal, &x, 1, &h);
    }
    const conn_array H = conn_array_matrix(from.H.data(), n, dim * (dim + 1) / 2);
    return conn_nodes_set_tensor(handle, n_internal, &x, 1, &H, 1);
}

Map::Map(const Context& context, const conn_map_options& options) {
    EXPECT_TRUE(ok(conn_map_create(context.handle, &options, &handle)));
}

conn_status Map::rebuild(const std::vector<conn_nodes*>& lists) const {
    return conn_map_rebuild(handle, lists.data(), static_cast<std::int32_t>(lists.size()));
}

std::uint64_t Map::generation() const {
    std::uint64_t generation = 0;
    EXPECT_TRUE(ok(conn_map_generation(handle, &generation)));
    return generation;
}

Built::Built(const Context& context, int dimension, const std::vector<NodeSet>& sets,
             const conn_map_options& options)
    : dim(dimension), map(context, options) {
    for (const NodeSet& set : sets) {
        nodes.push_back(std::make_unique<Nodes>(context, dim, set));
        lists.push_back(nodes.back()->handle);
    }
    EXPECT_TRUE(ok(rebuild()));
}

conn_status Built::rebuild(const conn_map_options& options) const {
    EXPECT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    return rebuild();
}

conn_status set_ids(conn_nodes* nodes, const std::vector<std::int64_t>& global_ids,
                    const std::vector<std::int32_t>& owner) {
    const conn_array ids = conn_array_vector_int64(global_ids.data(), std::ssize(global_ids)),
                     owners = conn_array_vector_int32(owner.data(), std::ssize(owner));
    return conn_nodes_set_ids(nodes, global_ids.empty() ? nullptr : &ids,
                              owner.empty() ? nullptr : &owners);
}

Lists lists_of(const Context& context, int dim, const std::vector<NodeSet>& sets,
               const conn_map_options& options) {
    const Built built(context, dim, sets, options);
    return read_lists(built.map.handle);
}

}  // namespace connectivity::test
