// SPDX-License-Identifier: BSD-3-Clause
// Lists with a skin through the C interface: complete until a rebuild is asked for.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <support/random.hpp>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

conn_map_options with_skin(double skin) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.skin = skin;
    return options;
}

class CapiReuse : public ::testing::Test {
protected:
    /// What the map says about the nodes as they are now.
    bool needed() {
        conn_nodes* const lists[] = {gas.handle, dust.handle};
        std::int32_t answer = -1;
        EXPECT_TRUE(ok(conn_map_needs_rebuild(map.handle, lists, 2, &answer, &drift)));
        EXPECT_TRUE(answer == 0 || answer == 1);
        return answer != 0;
    }
    void set_all() {
        EXPECT_TRUE(ok(gas.set(3, sets[0])));
        EXPECT_TRUE(ok(dust.set(3, sets[1])));
    }
    void rebuild() {
        set_all();
        ASSERT_TRUE(ok(map.rebuild({gas.handle, dust.handle})));
    }
    /// Every pair that brute force finds now stands in the lists of the last rebuild.
    bool lists_are_complete() {
        const Lists now = brute_force(3, sets), held = read_lists(map.handle);
        bool complete = std::ranges::includes(held.pairs, now.pairs);
        for (std::size_t r = 0; r < now.rows.size(); ++r)
            complete = complete && std::ranges::includes(held.rows[r], now.rows[r]);
        return complete;
    }
    std::int64_t counter(const std::string& wanted) {
        const char* name = nullptr;
        std::int64_t value = -1;
        for (int k = 0; conn_map_report_counter(map.handle, k, &name, &value) == CONN_OK; ++k)
            if (wanted == name) return value;
        return -1;
    }

    static constexpr double skin = 0.05;
    std::vector<NodeSet> sets{random_nodes(3, 120, 1), random_nodes(3, 80, 2, true)};
    Context context;
    Nodes gas{context, 3, sets[0]}, dust{context, 3, sets[1]};
    Map map{context, with_skin(skin)};
    double drift = -1;
};

TEST_F(CapiReuse, lists_are_complete_in_every_step_of_a_walk) {
    Random random(5);
    int n_reuses = 0, n_rebuilds = 0;
    for (int step = 0; step < 60; ++step) {
        set_all();
        if (needed()) {
            rebuild();
            ++n_rebuilds;
        } else {
            ++n_reuses;
        }
        ASSERT_TRUE(lists_are_complete()) << step << ", drift " << drift;
        for (NodeSet& set : sets) {
            for (double& x : set.x) x += 0.05 * skin * random.uniform(-1, 1);
            for (double& h : set.h) h *= 1 + 0.01 * random.uniform(-1, 1);
            for (double& H : set.H) H *= 1 - 0.005 * random.uniform();
        }
    }
    EXPECT_GT(n_reuses, 10);
    EXPECT_GT(n_rebuilds, 3);
    EXPECT_EQ(counter("rebuilds"), n_rebuilds);
    EXPECT_EQ(counter("reuses"), n_reuses);
    EXPECT_GT(counter("max_drift_ppm"), 300000);
    EXPECT_LE(counter("max_drift_ppm"), 1000000);
}

TEST_F(CapiReuse, drift_is_twice_the_displacement_plus_the_growth) {
    EXPECT_TRUE(needed());
    EXPECT_EQ(drift, infinity);
    rebuild();
    EXPECT_FALSE(needed());
    EXPECT_EQ(drift, 0);
    sets[0].x[10] += 0.01;
    sets[0].h[30] += 0.005;
    set_all();
    EXPECT_FALSE(needed());
    EXPECT_NEAR(drift, 2 * 0.01 + 2 * 0.005, 1e-12);
    sets[0].x[10] += 0.011;
    set_all();
    EXPECT_TRUE(needed());
    EXPECT_NEAR(drift, 2 * 0.021 + 2 * 0.005, 1e-12);
}

TEST_F(CapiReuse, other_options_need_a_rebuild) {
    rebuild();
    conn_map_options options = with_skin(skin);
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_FALSE(needed()) << "the same options";
    options.ghost_rows = 1;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_TRUE(needed());
    EXPECT_EQ(drift, 0);
    rebuild();
    EXPECT_FALSE(needed());
    options.skin = 0;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    rebuild();
    EXPECT_TRUE(needed());
    EXPECT_EQ(drift, infinity);
}

TEST_F(CapiReuse, other_sizes_and_bad_values_need_a_rebuild) {
    rebuild();
    sets[1] = random_nodes(3, 81, 2, true);
    set_all();
    EXPECT_TRUE(needed());
    rebuild();
    EXPECT_FALSE(needed());
    sets[0].x[100] = std::nan("");
    set_all();
    EXPECT_TRUE(needed());
    EXPECT_TRUE(fails(map.rebuild({gas.handle, dust.handle}), CONN_E_NONFINITE, {"node 33"}));
}

TEST_F(CapiReuse, a_host_of_the_first_layout_has_no_skin) {
    conn_map_options options = with_skin(std::nan(""));  // behind what this host knows of
    options.struct_size = offsetof(conn_map_options, skin);
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    rebuild();
    EXPECT_EQ(read_lists(map.handle), brute_force(3, sets));
    EXPECT_TRUE(needed());
}

TEST_F(CapiReuse, bad_arguments_are_refused) {
    conn_nodes* const lists[] = {gas.handle, nullptr};
    std::int32_t answer = -1;
    EXPECT_TRUE(fails(conn_map_needs_rebuild(nullptr, lists, 1, &answer, &drift), CONN_E_NULL));
    EXPECT_TRUE(fails(conn_map_needs_rebuild(map.handle, nullptr, 1, &answer, &drift), CONN_E_NULL,
                      {"lists"}));
    EXPECT_TRUE(fails(conn_map_needs_rebuild(map.handle, lists, 2, &answer, &drift), CONN_E_NULL,
                      {"lists[1]"}));
    EXPECT_TRUE(fails(conn_map_needs_rebuild(map.handle, lists, 0, &answer, &drift),
                      CONN_E_ARGUMENT, {"n_lists"}));
    EXPECT_TRUE(fails(conn_map_needs_rebuild(map.handle, lists, 1, nullptr, &drift), CONN_E_NULL,
                      {"needed"}));
    EXPECT_EQ(answer, -1);
    EXPECT_EQ(drift, -1);
    EXPECT_TRUE(ok(conn_map_needs_rebuild(map.handle, lists, 1, &answer, nullptr)));
    EXPECT_EQ(answer, 1);
}

}  // namespace
}  // namespace connectivity::test
