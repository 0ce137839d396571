// SPDX-License-Identifier: BSD-3-Clause
// Every bad input ends in its own status, a text that names the first offending index, and the
// lists of the last good rebuild still in place.

#include <cmath>
#include <functional>
#include <limits>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t huge = std::numeric_limits<std::int64_t>::max();

/// Two good lists and a map that was rebuilt from them.
class CapiBadInput : public ::testing::Test {
protected:
    CapiBadInput() {
        sets[1].name = "dust";
        EXPECT_TRUE(ok(map.rebuild({gas.handle, dust.handle})));
        before = read_lists(map.handle);
        EXPECT_FALSE(before.pairs.empty());
    }
    ~CapiBadInput() override {
        EXPECT_EQ(map.generation(), 1u) << "a failed call made a new generation";
        EXPECT_EQ(read_lists(map.handle), before) << "a failed call changed the lists";
    }
    CapiBadInput(const CapiBadInput&) = delete;
    CapiBadInput& operator=(const CapiBadInput&) = delete;

    conn_status rebuild() { return map.rebuild({gas.handle, dust.handle}); }

    /// Sets the second list to changed nodes and rebuilds.
    conn_status rebuild_with(const std::function<void(NodeSet&)>& spoil) {
        NodeSet changed = sets[1];
        spoil(changed);
        EXPECT_TRUE(ok(dust.set(3, changed)));
        return rebuild();
    }

    conn_status rebuild_with(const std::function<void(conn_map_options&)>& spoil) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        spoil(options);
        EXPECT_TRUE(ok(conn_map_set_options(map.handle, &options)));
        return rebuild();
    }

    /// A refused set leaves the nodes as they were: the next rebuild gives the same lists.
    void expect_same_nodes() {
        const Map other(context);
        EXPECT_TRUE(ok(other.rebuild({gas.handle, dust.handle})));
        EXPECT_EQ(read_lists(other.handle), before);
    }

    std::vector<NodeSet> sets{random_nodes(3, 50, 1), random_nodes(3, 40, 2)};
    Context context;
    Nodes gas{context, 3, sets[0]};
    Nodes dust{context, 3, 2, "dust"};
    conn_status set_dust = dust.set(3, sets[1]);
    Map map{context};
    Lists before;
};

TEST_F(CapiBadInput, positions_that_are_not_finite_are_named) {
    EXPECT_TRUE(fails(rebuild_with([](NodeSet& s) { s.x[3 * 17 + 1] = s.x[3 * 30] = nan; }),
                      CONN_E_NONFINITE, {"node list 1", "dust", "node 17", "position[1]", "nan"}));
    EXPECT_TRUE(fails(rebuild_with([](NodeSet& s) { s.x[0] = -infinity; }), CONN_E_NONFINITE,
                      {"node list 1", "node 0", "inf"}));
}

TEST_F(CapiBadInput, smoothing_lengths_that_are_negative_or_not_finite_are_named) {
    for (const double h : {-0.25, nan, infinity})
        EXPECT_TRUE(fails(rebuild_with([h](NodeSet& s) { s.h[23] = s.h[39] = h; }), CONN_E_SUPPORT,
                          {"node list 1", "dust", "node 23", "h = ", ">= 0"}));
    EXPECT_TRUE(fails(rebuild_with([](NodeSet& s) { s.h[5] = -0.25; }), CONN_E_SUPPORT,
                      {"node 5", "-0.25"}));
}

TEST_F(CapiBadInput, tensors_that_are_not_positive_definite_are_named) {
    for (const double xx : {0.0, -1.0, nan, infinity})
        EXPECT_TRUE(fails(rebuild_with([xx](NodeSet& s) {
                              s = random_nodes(3, 40, 2, true);
                              s.H[6 * 11] = xx;
                          }),
                          CONN_E_NOT_SPD, {"node list 1", "node 11", "positive definite"}));
}

TEST_F(CapiBadInput, a_box_that_is_inverted_empty_or_not_finite_is_refused) {
    const std::pair<double, double> bad[] = {{1, 0}, {1, 1}, {nan, 1}, {0, nan}, {0, infinity}};
    for (const auto& [lo, hi] : bad)
        EXPECT_TRUE(fails(rebuild_with([lo = lo, hi = hi](conn_map_options& o) {
                              o.periodic[1] = 1;
                              o.box_lo[1] = lo;
                              o.box_hi[1] = hi;
                          }),
                          CONN_E_BOX, {"axis 1"}));
}

TEST_F(CapiBadInput, a_support_over_half_a_periodic_box_is_named) {
    const auto periodic = [](conn_map_options& o) {
        o.periodic[2] = 1;
        o.box_lo[2] = 0;
        o.box_hi[2] = 1;
    };
    NodeSet changed = sets[1];
    for (double& h : changed.h) h = std::min(h, 0.2);
    changed.h[8] = 0.26;  // reaches 0.52
    ASSERT_TRUE(ok(dust.set(3, changed)));
    changed = sets[0];
    for (double& h : changed.h) h = std::min(h, 0.2);
    ASSERT_TRUE(ok(gas.set(3, changed)));
    EXPECT_TRUE(fails(rebuild_with(periodic), CONN_E_HALF_BOX, {"node list 1", "node 8", "0.5"}));
}

TEST_F(CapiBadInput, a_result_over_the_budget_is_refused_with_bytes_needed_and_allowed) {
    EXPECT_TRUE(fails(rebuild_with([](conn_map_options& o) { o.budget_bytes = 64; }), CONN_E_BUDGET,
                      {"64"}));
}

TEST_F(CapiBadInput, the_budget_of_the_context_holds_where_the_map_has_none) {
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.budget_bytes = 64;
    conn_context* poor = nullptr;
    ASSERT_TRUE(ok(conn_context_create(&options, &poor)));
    conn_map* small = nullptr;
    ASSERT_TRUE(ok(conn_map_create(poor, nullptr, &small)));
    conn_nodes* const lists[] = {gas.handle, dust.handle};
    EXPECT_TRUE(fails(conn_map_rebuild(small, lists, 2), CONN_E_BUDGET, {"64"}));
    conn_map_options own = CONN_MAP_OPTIONS_INIT;
    own.budget_bytes = 1 << 30;
    EXPECT_TRUE(ok(conn_map_set_options(small, &own)));
    EXPECT_TRUE(ok(conn_map_rebuild(small, lists, 2)));
    EXPECT_TRUE(ok(conn_map_destroy(&small)));
    EXPECT_TRUE(ok(conn_context_destroy(&poor)));
}

TEST_F(CapiBadInput, a_pair_explosion_is_counted_in_64_bits_before_it_allocates) {
    const int n = 92683;  // n * (n - 1) / 2 is the first to pass 2^32
    NodeSet all;
    for (int i = 0; i < n; ++i) all.x.insert(all.x.end(), {1e-6 * i, 0, 0});
    all.h.assign(n, 1);
    ASSERT_TRUE(ok(dust.set(3, all)));
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.budget_bytes = 1000000000;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_TRUE(fails(
        map.rebuild({dust.handle}), CONN_E_BUDGET,
        {"4295022903 pairs", "8590045806 row entries", "1000000000 bytes", "node 0 with 92682"}));
}

TEST_F(CapiBadInput, lists_that_are_null_dead_unset_or_too_many_are_named) {
    conn_nodes* const none[] = {gas.handle, nullptr};
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, none, 2), CONN_E_NULL, {"lists[1]"}));
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, nullptr, 1), CONN_E_NULL, {"lists"}));
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, none, 0), CONN_E_ARGUMENT, {"n_lists = 0"}));
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, none, -3), CONN_E_ARGUMENT, {"-3"}));
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, none, 1 << 30), CONN_E_TOO_MANY, {"n_lists"}));
    const Nodes unset(context, 3), flat(context, 2, random_nodes(2, 5, 1));
    EXPECT_TRUE(fails(map.rebuild({gas.handle, unset.handle}), CONN_E_ARGUMENT, {"lists[1]"}));
    EXPECT_TRUE(fails(map.rebuild({gas.handle, flat.handle}), CONN_E_ARGUMENT, {"dim = 2"}));
}

TEST_F(CapiBadInput, options_outside_their_range_are_refused) {
    const auto refused = [this](const std::function<void(conn_map_options&)>& spoil) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        spoil(options);
        conn_map* made = nullptr;
        EXPECT_EQ(conn_map_create(context.handle, &options, &made),
                  conn_map_set_options(map.handle, &options));
        EXPECT_EQ(made, nullptr);
        return conn_map_set_options(map.handle, &options);
    };
    using Options = conn_map_options;
    EXPECT_TRUE(fails(refused([](Options& o) { o.rows = 2; }), CONN_E_ARGUMENT, {"rows = 2"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.pairs = -1; }), CONN_E_ARGUMENT, {"pairs"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.ghost_rows = 7; }), CONN_E_ARGUMENT, {"7"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.spatial_order = 9; }), CONN_E_ARGUMENT, {"9"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.mode = 0; }), CONN_E_ARGUMENT, {"mode = 0"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.mode = CONN_GATHER; }), CONN_E_ARGUMENT, {"pairs"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.method = 5; }), CONN_E_ARGUMENT, {"method = 5"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.periodic[2] = 2; }), CONN_E_ARGUMENT, {"periodic[2]"}));
    EXPECT_TRUE(fails(refused([](Options& o) { o.budget_bytes = -1; }), CONN_E_ARGUMENT, {"-1"}));
    for (const double skin : {-1.0, nan, infinity, -infinity, 1e101})
        EXPECT_TRUE(fails(refused([skin](Options& o) { o.skin = skin; }), CONN_E_ARGUMENT,
                          {"skin = ", "[1e-100, 1e100]"}));
    EXPECT_TRUE(
        fails(refused([](Options& o) { o.reserved = 1; }), CONN_E_UNSUPPORTED, {"reserved"}));
}

/// Arrays of the first list, to be spoilt one member at a time.
class CapiBadArray : public CapiBadInput {
protected:
    conn_status set_h(std::int64_t n_internal, std::int32_t n_positions = 1) {
        return conn_nodes_set_h(gas.handle, n_internal, &x, n_positions, &h);
    }
    ~CapiBadArray() override { expect_same_nodes(); }

    conn_array x = conn_array_matrix(sets[0].x.data(), 50, 3);
    conn_array h = conn_array_vector(sets[0].h.data(), 50);
};

TEST_F(CapiBadArray, a_missing_array_is_refused) {
    x.data = nullptr;
    EXPECT_TRUE(fails(set_h(50), CONN_E_NULL, {"positions.data"}));
    EXPECT_TRUE(
        fails(conn_nodes_set_h(gas.handle, 50, nullptr, 1, &h), CONN_E_NULL, {"positions"}));
    x = conn_array_matrix(sets[0].x.data(), 50, 3);
    EXPECT_TRUE(fails(conn_nodes_set_h(gas.handle, 50, &x, 1, nullptr), CONN_E_NULL, {"h"}));
    h.data = nullptr;
    EXPECT_TRUE(fails(set_h(50), CONN_E_NULL, {"h.data"}));
}

TEST_F(CapiBadArray, negative_and_huge_counts_are_refused) {
    EXPECT_TRUE(fails(set_h(-1), CONN_E_ARGUMENT, {"n_internal = -1", "[0, 50]"}));
    EXPECT_TRUE(fails(set_h(51), CONN_E_ARGUMENT, {"n_internal = 51"}));
    EXPECT_TRUE(fails(set_h(huge), CONN_E_ARGUMENT, {"n_internal"}));
    for (const std::int64_t n : {std::int64_t{1} << 31, huge}) {
        x.extent[0] = h.extent[0] = n;
        EXPECT_TRUE(fails(set_h(50), CONN_E_TOO_MANY, {"positions.extent[0]", "2147483647"}));
    }
    for (const std::int64_t n : {std::int64_t{-1}, -huge}) {
        x.extent[0] = h.extent[0] = n;
        EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions.extent[0]", ">= 0"}));
    }
}

TEST_F(CapiBadArray, shapes_that_do_not_agree_are_refused) {
    h.extent[0] = 49;
    EXPECT_TRUE(fails(set_h(49), CONN_E_ARGUMENT, {"h has 49", "50"}));
    h.extent[0] = 50;
    x.extent[1] = 2;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions.extent[1] = 2", "3"}));
    x.extent[1] = 3;
    x.ndim = 1;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions"}));
    x.ndim = 3;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions.ndim = 3", "1 or 2"}));
    x.ndim = 2;
    for (const int n : {0, 2, 4, -1})
        EXPECT_TRUE(fails(set_h(50, n), CONN_E_ARGUMENT, {"n_positions = ", "1 or 3"}));
    x.stride[0] = huge;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions.stride[0]"}));
    x.stride[0] = 3;
    x.stride[1] = -huge;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"positions.stride[1]"}));
}

TEST_F(CapiBadArray, separate_arrays_must_agree_with_the_first) {
    conn_array axes[3];
    for (conn_array& axis : axes) axis = conn_array_vector(sets[0].x.data(), 50);
    axes[2].extent[0] = 49;
    EXPECT_TRUE(fails(conn_nodes_set_h(gas.handle, 49, axes, 3, &h), CONN_E_ARGUMENT,
                      {"positions[2].extent[0] = 49"}));
    axes[2].extent[0] = 50;
    axes[1].dtype = CONN_FLOAT32;
    EXPECT_TRUE(fails(conn_nodes_set_h(gas.handle, 50, axes, 3, &h), CONN_E_ARGUMENT,
                      {"positions[1].dtype"}));
}

TEST_F(CapiBadArray, unknown_kinds_of_memory_are_refused) {
    x.dtype = 2;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"dtype = 2"}));
    x.dtype = CONN_FLOAT64;
    x.space = 4;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"space = 4"}));
    x.space = CONN_SPACE_DEVICE;
    EXPECT_TRUE(fails(set_h(50), CONN_E_UNSUPPORTED, {"device"}));
    x.space = CONN_SPACE_HOST;
    x.data = reinterpret_cast<const char*>(sets[0].x.data()) + 4;
    EXPECT_TRUE(fails(set_h(50), CONN_E_ARGUMENT, {"aligned"}));
}

TEST_F(CapiBadInput, names_dimensions_and_extents_outside_their_range_are_refused) {
    conn_nodes* made = nullptr;
    const auto create = [&](const char* name, int dim, double extent) {
        return conn_nodes_create(context.handle, name, dim, extent, &made);
    };
    EXPECT_TRUE(fails(create(nullptr, 3, 2), CONN_E_NULL, {"name"}));
    EXPECT_TRUE(fails(create("", 3, 2), CONN_E_ARGUMENT, {"name"}));
    EXPECT_TRUE(fails(create(std::string(256, 'x').c_str(), 3, 2), CONN_E_ARGUMENT, {"255"}));
    for (const int dim : {-1, 0, 4})
        EXPECT_TRUE(fails(create("x", dim, 2), CONN_E_ARGUMENT, {"dim"}));
    for (const double extent : {0.0, -1.0, nan, infinity})
        EXPECT_TRUE(fails(create("x", 3, extent), CONN_E_ARGUMENT, {"kernel_extent"}));
    EXPECT_TRUE(
        fails(conn_nodes_create(context.handle, "x", 3, 2, nullptr), CONN_E_NULL, {"nodes"}));
    EXPECT_EQ(made, nullptr);
}

TEST_F(CapiBadInput, context_options_that_cannot_be_met_are_refused) {
    conn_context* made = nullptr;
    const auto create = [&](int n_threads, int device, std::int64_t budget) {
        conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
        options.n_threads = n_threads;
        options.device_id = device;
        options.budget_bytes = budget;
        return conn_context_create(&options, &made);
    };
    EXPECT_TRUE(fails(create(-1, -1, 0), CONN_E_ARGUMENT, {"n_threads = -1"}));
    EXPECT_TRUE(fails(create(100000, -1, 0), CONN_E_ARGUMENT, {"n_threads", "512"}));
    EXPECT_TRUE(fails(create(3, -1, 0), CONN_E_UNSUPPORTED, {"already runs with 2"}));
    EXPECT_TRUE(fails(create(0, -2, 0), CONN_E_ARGUMENT, {"device_id"}));
    EXPECT_TRUE(fails(create(0, -1, -5), CONN_E_ARGUMENT, {"budget_bytes = -5"}));
    EXPECT_TRUE(fails(conn_context_create(nullptr, nullptr), CONN_E_NULL, {"context"}));
    EXPECT_EQ(made, nullptr);
}

TEST_F(CapiBadInput, after_every_error_the_next_good_call_works) {
    EXPECT_TRUE(fails(rebuild_with([](NodeSet& s) { s.x[0] = nan; }), CONN_E_NONFINITE));
    const Map other(context);
    ASSERT_TRUE(ok(dust.set(3, sets[1])));
    EXPECT_TRUE(ok(other.rebuild({gas.handle, dust.handle})));
    EXPECT_STREQ(conn_last_error(), "");
    EXPECT_EQ(read_lists(other.handle), before);
}

}  // namespace
}  // namespace connectivity::test
