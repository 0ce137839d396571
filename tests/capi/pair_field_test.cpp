// SPDX-License-Identifier: BSD-3-Clause
// Fields over pairs, coupling, and their way through patches; sums at the nodes against a loop over
// the rows of brute force.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr int dim = 2, n_nodes = 300, n_internal = 200;

/// Component c of a pair, another number for every pair of slots.
double value_of(std::int32_t i, std::int32_t j, int c) {
    return std::sin(1.0 + i + 0.37 * j) + 0.25 * c;
}
double coupling_of(void*, std::int32_t i, std::int32_t j) { return (i * n_nodes + j) * 1e-5; }

struct Field {
    conn_pair_field* handle = nullptr;
    Field(const conn_map* map, int n) { EXPECT_TRUE(ok(conn_pair_field_create(map, n, &handle))); }
    ~Field() { conn_pair_field_destroy(&handle); }
    Field(const Field&) = delete;
    Field& operator=(const Field&) = delete;

    /// All values; empty if they cannot be had.
    std::vector<double> read(const conn_map* map) const {
        double* data = nullptr;
        std::int64_t n_pairs = 0;
        std::int32_t n = 0;
        if (conn_pair_field_data(handle, map, &data, &n_pairs, &n) != CONN_OK) return {};
        return {data, data + n_pairs * n};
    }
};

class CapiPairField : public ::testing::TestWithParam<int> {
protected:
    CapiPairField() {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        options.order = GetParam();
        EXPECT_TRUE(ok(built.rebuild(options)));
        lists = read_lists(map);
    }

    static NodeSet nodes() {
        NodeSet set = random_nodes(dim, n_nodes, 1);
        set.n_internal = n_internal;
        return set;
    }

    void fill(const Field& field) {
        double* data = nullptr;
        std::int64_t n_pairs = 0;
        std::int32_t n = 0;
        ASSERT_TRUE(ok(conn_pair_field_data(field.handle, map, &data, &n_pairs, &n)));
        ASSERT_EQ(n_pairs, std::ssize(lists.pairs));
        for (const auto& [i, j] : lists.pairs)
            for (int c = 0; c < n; ++c) *data++ = value_of(i, j, c);
    }

    std::vector<double> coupling() const {
        conn_pairs_view view = CONN_PAIRS_VIEW_INIT;
        EXPECT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &view)));
        std::vector<double> values;
        if (view.coupling != nullptr) values.assign(view.coupling, view.coupling + view.n_pairs);
        EXPECT_TRUE(ok(conn_map_pairs_release(&view)));
        return values;
    }

    /// Where a node stands in the order in force.
    std::vector<std::int32_t> ranks() const {
        std::vector<std::int32_t> rank(n_nodes);
        for (std::int32_t k = 0; k < n_nodes; ++k) rank[static_cast<std::size_t>(k)] = k;
        std::int64_t count = 0;
        if (GetParam() == CONN_ORDER_KEY) {
            EXPECT_TRUE(
                ok(conn_map_key_order(map, nullptr, rank.data(), nullptr, n_nodes, &count)));
        }
        return rank;
    }

    NodeSet set = nodes();
    Context context;
    Built built{context, dim, {set}};
    conn_map* map = built.map.handle;
    Lists lists;
};

/// Reverses the internal nodes and drops every 7th; of the ghosts every second goes.
struct Renumbering {
    std::vector<std::int32_t> keep = std::vector<std::int32_t>(n_nodes, 1);
    std::vector<std::int32_t> old2new = std::vector<std::int32_t>(n_nodes, -77);
    std::vector<std::int32_t> new2old;
    std::int32_t n_internal_now = 0;

    Renumbering() {
        for (std::int32_t a = n_internal - 1; a >= 0; --a) take(a, a % 7 != 0);
        n_internal_now = static_cast<std::int32_t>(new2old.size());
        for (std::int32_t a = n_internal; a < n_nodes; ++a) take(a, a % 2 == 0);
    }
    void take(std::int32_t a, bool stays) {
        const auto at = static_cast<std::size_t>(a);
        keep[at] = stays ? 1 : 0;
        if (!stays) return;
        old2new[at] = static_cast<std::int32_t>(new2old.size());
        new2old.push_back(a);
    }
    NodeSet compacted(const NodeSet& from) const {
        NodeSet now = from;
        now.x.clear(), now.h.clear();
        for (const std::int32_t a : new2old) {
            const auto at = static_cast<std::size_t>(a);
            now.x.insert(now.x.end(), from.x.begin() + dim * a, from.x.begin() + dim * (a + 1));
            now.h.push_back(from.h[at]);
        }
        now.n_internal = n_internal_now;
        return now;
    }
};

TEST_P(CapiPairField, values_and_coupling_of_surviving_pairs_follow_a_patch) {
    const Field field(map, 2), other(map, 1);
    fill(field);
    ASSERT_TRUE(ok(conn_map_set_coupling_function(map, coupling_of, nullptr)));
    const std::vector<double> before = coupling();
    std::vector<double> of_slots(std::size_t{n_nodes} * n_nodes);
    for (std::size_t k = 0; k < lists.pairs.size(); ++k)
        for (const auto& [a, b] :
             {lists.pairs[k], std::pair(lists.pairs[k].second, lists.pairs[k].first)})
            of_slots[static_cast<std::size_t>(a * n_nodes + b)] = static_cast<double>(k);
    const Renumbering now;
    ASSERT_TRUE(
        ok(conn_map_patch(map, now.keep.data(), now.old2new.data(), n_nodes, &field.handle, 1)));
    const Lists after = read_lists(map);
    if (GetParam() == CONN_ORDER_SLOT) {
        EXPECT_EQ(after, brute_force(dim, {now.compacted(set)}));
    }
    const std::vector<double> values = field.read(map), couplings = coupling();
    ASSERT_EQ(values.size(), 2 * after.pairs.size());
    ASSERT_EQ(couplings.size(), after.pairs.size());
    for (std::size_t k = 0; k < after.pairs.size(); ++k) {
        const std::int32_t i = now.new2old[static_cast<std::size_t>(after.pairs[k].first)],
                           j = now.new2old[static_cast<std::size_t>(after.pairs[k].second)];
        const auto old =
            static_cast<std::size_t>(of_slots[static_cast<std::size_t>(i * n_nodes + j)]);
        const auto [a, b] = lists.pairs[old];
        ASSERT_EQ(values[2 * k], value_of(a, b, 0));
        ASSERT_EQ(values[2 * k + 1], value_of(a, b, 1));
        ASSERT_EQ(couplings[k], before[old]);
    }
    EXPECT_TRUE(fails(conn_pair_field_data(other.handle, map, nullptr, nullptr, nullptr),
                      CONN_E_STALE, {"before a rebuild or patch"}));
    EXPECT_TRUE(ok(conn_pair_field_reset(other.handle, map)));
    EXPECT_EQ(other.read(map), std::vector<double>(after.pairs.size()));
}

std::int32_t is_odd(void*, std::int32_t i, std::int32_t j) { return (i + j) % 2; }

TEST_P(CapiPairField, values_of_pairs_that_stay_follow_their_removal) {
    const Field field(map, 1);
    fill(field);
    ASSERT_TRUE(ok(conn_map_remove_pairs(map, is_odd, nullptr, &field.handle, 1)));
    const Lists after = read_lists(map);
    EXPECT_LT(after.pairs.size(), lists.pairs.size());
    const std::vector<double> values = field.read(map);
    ASSERT_EQ(values.size(), after.pairs.size());
    for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_EQ(values[k], value_of(after.pairs[k].first, after.pairs[k].second, 0));
}

TEST_P(CapiPairField, sums_along_rows_are_those_of_a_loop_over_the_rows) {
    const std::vector<std::int32_t> rank = ranks();
    const auto before = [&](std::int32_t a, std::int32_t b) {
        return rank[static_cast<std::size_t>(a)] < rank[static_cast<std::size_t>(b)];
    };
    for (const int symmetry : {CONN_ANTISYMMETRIC, CONN_SYMMETRIC, CONN_TWO_SIDED})
        for (const int n : {1, 3, 7}) {
            const int width = symmetry == CONN_TWO_SIDED ? 2 * n : n;
            const Field field(map, width);
            fill(field);
            std::vector<double> expected(static_cast<std::size_t>(n_nodes * n)),
                out(expected.size(), 1e300);
            for (std::size_t a = 0; a < lists.rows.size(); ++a)
                for (const std::int32_t b : lists.rows[a]) {
                    const auto i = static_cast<std::int32_t>(a);
                    for (int c = 0; c < n; ++c)
                        expected[a * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)] +=
                            before(i, b)                     ? value_of(i, b, c)
                            : symmetry == CONN_TWO_SIDED     ? value_of(b, i, n + c)
                            : symmetry == CONN_ANTISYMMETRIC ? -value_of(b, i, c)
                                                             : value_of(b, i, c);
                }
            ASSERT_TRUE(ok(conn_pair_field_sum(field.handle, map, symmetry, CONN_SUM_DETERMINISTIC,
                                               out.data(), n_nodes * n)));
            EXPECT_EQ(out, expected) << symmetry << " " << n;
            ASSERT_TRUE(ok(conn_pair_field_sum(field.handle, map, symmetry, CONN_SUM_ATOMIC,
                                               out.data(), n_nodes * n)));
            for (std::size_t k = 0; k < lists.rows.size() * static_cast<std::size_t>(n); ++k)
                ASSERT_NEAR(out[k], expected[k], 1e-12) << symmetry << " " << n << " " << k;
        }
}

TEST_P(CapiPairField, every_pair_is_found_in_both_orientations_and_nothing_else) {
    std::vector<std::int32_t> i, j;
    std::vector<std::int64_t> expected;
    for (std::int32_t a = -1; a <= n_nodes; ++a)
        for (std::int32_t b = -1; b <= n_nodes; ++b) {
            i.push_back(a), j.push_back(b), expected.push_back(-1);
        }
    constexpr std::size_t side = n_nodes + 2;
    for (std::size_t k = 0; k < lists.pairs.size(); ++k) {
        const auto a = static_cast<std::size_t>(lists.pairs[k].first + 1),
                   b = static_cast<std::size_t>(lists.pairs[k].second + 1);
        expected[a * side + b] = expected[b * side + a] = static_cast<std::int64_t>(k);
    }
    std::vector<std::int64_t> found(expected.size(), -5);
    ASSERT_TRUE(ok(conn_map_find_pairs(map, std::ssize(found), i.data(), j.data(), found.data())));
    EXPECT_EQ(found, expected);
    ASSERT_TRUE(ok(conn_map_find_pairs(map, 0, nullptr, nullptr, nullptr)));
    ASSERT_TRUE(ok(conn_map_find_pairs(map, 3, &i[side], &j[side], found.data())));
    EXPECT_EQ(found[2], expected[side + 2]);
    EXPECT_TRUE(fails(conn_map_find_pairs(map, -1, i.data(), j.data(), found.data()),
                      CONN_E_ARGUMENT, {"n = -1"}));
    EXPECT_TRUE(fails(conn_map_find_pairs(map, 1, i.data(), nullptr, found.data()), CONN_E_NULL,
                      {"j is NULL"}));
}

TEST_P(CapiPairField, coupling_is_what_was_set_and_a_refused_value_changes_nothing) {
    EXPECT_EQ(coupling(), std::vector<double>());
    std::vector<double> values;
    for (const auto& [i, j] : lists.pairs) values.push_back(coupling_of(nullptr, i, j));
    const std::int64_t n = std::ssize(values);
    ASSERT_TRUE(ok(conn_map_set_coupling(map, values.data(), n)));
    EXPECT_EQ(coupling(), values);
    for (const double bad : {-0.1, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<double> spoilt = values;
        spoilt[40] = spoilt[41] = bad;
        EXPECT_TRUE(fails(conn_map_set_coupling(map, spoilt.data(), n), CONN_E_ARGUMENT,
                          {"pair 40", "[0, 1]"}));
    }
    EXPECT_TRUE(fails(conn_map_set_coupling(map, values.data(), n - 1), CONN_E_ARGUMENT,
                      {"n_pairs", std::to_string(n)}));
    EXPECT_TRUE(fails(conn_map_set_coupling(map, nullptr, n), CONN_E_NULL, {"values"}));
    EXPECT_TRUE(fails(conn_map_set_coupling_function(map, nullptr, nullptr), CONN_E_NULL));
    EXPECT_EQ(coupling(), values);
    ASSERT_TRUE(ok(conn_map_set_coupling(map, nullptr, 0)));
    EXPECT_EQ(coupling(), std::vector<double>());
    ASSERT_TRUE(ok(conn_map_set_coupling_function(map, coupling_of, nullptr)));
    EXPECT_EQ(coupling(), values);
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(coupling(), std::vector<double>()) << "a rebuild forgets";
}

TEST_P(CapiPairField, a_stale_field_is_refused_everywhere_until_it_is_reset) {
    const Field field(map, 1);
    fill(field);
    const Built twin(context, dim, {set});
    std::vector<double> out(n_nodes, 3);
    const auto refused = [&](conn_map* of) {
        EXPECT_TRUE(
            fails(conn_pair_field_data(field.handle, of, nullptr, nullptr, nullptr), CONN_E_STALE));
        EXPECT_TRUE(fails(conn_pair_field_sum(field.handle, of, CONN_SYMMETRIC, CONN_SUM_ATOMIC,
                                              out.data(), n_nodes),
                          CONN_E_STALE));
        EXPECT_TRUE(fails(conn_map_remove_pairs(of, is_odd, nullptr, &field.handle, 1),
                          CONN_E_STALE, {"fields[0]"}));
    };
    refused(twin.map.handle);
    EXPECT_EQ(twin.map.generation(), 1u);
    ASSERT_TRUE(ok(built.rebuild()));
    const std::uint64_t generation = built.map.generation();
    refused(map);
    EXPECT_EQ(built.map.generation(), generation);
    EXPECT_EQ(out, std::vector<double>(n_nodes, 3));
    ASSERT_TRUE(ok(conn_pair_field_reset(field.handle, map)));
    EXPECT_EQ(field.read(map), std::vector<double>(lists.pairs.size()));
}

INSTANTIATE_TEST_SUITE_P(Orders, CapiPairField, ::testing::Values(CONN_ORDER_SLOT, CONN_ORDER_KEY));

class CapiBadField : public ::testing::Test {
protected:
    CapiBadField() { before = read_lists(map); }
    ~CapiBadField() override { EXPECT_EQ(read_lists(map), before); }
    CapiBadField(const CapiBadField&) = delete;
    CapiBadField& operator=(const CapiBadField&) = delete;

    Context context;
    Built built{context, 3, {random_nodes(3, 60, 1)}};
    conn_map* map = built.map.handle;
    Lists before;
};

TEST_F(CapiBadField, fields_of_no_size_or_no_pairs_are_refused) {
    conn_pair_field* field = nullptr;
    for (const int n : {0, -1, 257})
        EXPECT_TRUE(fails(conn_pair_field_create(map, n, &field), CONN_E_ARGUMENT,
                          {"n_components", "[1, 256]"}));
    EXPECT_TRUE(fails(conn_pair_field_create(map, 1, nullptr), CONN_E_NULL, {"field"}));
    EXPECT_TRUE(fails(conn_pair_field_create(nullptr, 1, &field), CONN_E_NULL, {"map"}));
    const Map never(context);
    EXPECT_TRUE(fails(conn_pair_field_create(never.handle, 1, &field), CONN_E_NOT_BUILT));
    EXPECT_EQ(field, nullptr);
    EXPECT_TRUE(ok(conn_pair_field_destroy(&field)));
    EXPECT_TRUE(ok(conn_pair_field_destroy(nullptr)));
}

TEST_F(CapiBadField, sums_that_cannot_be_are_refused_and_out_stays) {
    const Field field(map, 3);
    std::vector<double> out(180, 7);
    const auto sum = [&](int symmetry, int how, double* to, std::int64_t capacity) {
        return conn_pair_field_sum(field.handle, map, symmetry, how, to, capacity);
    };
    EXPECT_TRUE(fails(sum(0, 0, out.data(), 180), CONN_E_ARGUMENT, {"symmetry = 0"}));
    EXPECT_TRUE(fails(sum(CONN_SYMMETRIC, 2, out.data(), 180), CONN_E_ARGUMENT, {"how = 2"}));
    EXPECT_TRUE(fails(sum(CONN_TWO_SIDED, 0, out.data(), 180), CONN_E_ARGUMENT,
                      {"n_components = 3", "even"}));
    EXPECT_TRUE(fails(sum(CONN_SYMMETRIC, 0, out.data(), 179), CONN_E_BUFFER, {"179", "180"}));
    EXPECT_TRUE(fails(sum(CONN_SYMMETRIC, 0, nullptr, 180), CONN_E_NULL, {"out"}));
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.rows = 0;
    ASSERT_TRUE(ok(built.rebuild(options)));
    ASSERT_TRUE(ok(conn_pair_field_reset(field.handle, map)));
    EXPECT_TRUE(fails(sum(CONN_SYMMETRIC, 0, out.data(), 180), CONN_E_NOT_BUILT, {"rows"}));
    EXPECT_EQ(out, std::vector<double>(180, 7));
    EXPECT_TRUE(ok(sum(CONN_SYMMETRIC, CONN_SUM_ATOMIC, out.data(), 180)));
    EXPECT_EQ(out, std::vector<double>(180));
    options.rows = 1;
    ASSERT_TRUE(ok(built.rebuild(options)));
}

TEST_F(CapiBadField, patches_that_cannot_be_are_refused) {
    std::vector<std::int32_t> keep(60, 1), ids(60);
    for (std::size_t k = 0; k < 60; ++k) ids[k] = static_cast<std::int32_t>(k);
    const Field field(map, 1);
    conn_pair_field* const fields[] = {field.handle, nullptr};
    const auto patch = [&](std::int64_t n, conn_pair_field* const* some = nullptr,
                           int n_fields = 0) {
        return conn_map_patch(map, keep.data(), ids.data(), n, some, n_fields);
    };
    EXPECT_TRUE(fails(patch(59), CONN_E_ARGUMENT, {"keep has 59", "60"}));
    EXPECT_TRUE(fails(patch(-1), CONN_E_ARGUMENT, {"n_slots = -1"}));
    EXPECT_TRUE(fails(conn_map_patch(map, nullptr, ids.data(), 60, nullptr, 0), CONN_E_NULL,
                      {"keep is NULL"}));
    EXPECT_TRUE(fails(patch(60, fields, 2), CONN_E_NULL, {"fields[1]"}));
    EXPECT_TRUE(fails(patch(60, fields, -1), CONN_E_ARGUMENT, {"n_fields = -1"}));
    EXPECT_TRUE(fails(patch(60, nullptr, 1), CONN_E_NULL, {"fields is NULL"}));
    keep[7] = 2;
    EXPECT_TRUE(fails(patch(60), CONN_E_ARGUMENT, {"node 7", "keep = 2"}));
    keep[7] = 1;
    ids[9] = 8;
    EXPECT_TRUE(fails(patch(60, fields, 1), CONN_E_ARGUMENT, {"node 9", "old2new = 8"}));
    EXPECT_EQ(field.read(map).size(), before.pairs.size()) << "a failed patch made it stale";
    EXPECT_EQ(built.map.generation(), 1u);
}

}  // namespace
}  // namespace connectivity::test
