// SPDX-License-Identifier: BSD-3-Clause
// The log of a context: silent until asked, one line for each piece of work on a map, and no more
// once the context has gone.

#include <connectivity_boundary.h>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

struct Line {
    std::int32_t level;
    std::string text;
};
using Lines = std::vector<Line>;

void keep(void* lines, std::int32_t level, const char* line) {
    static_cast<Lines*>(lines)->push_back({level, line});
}

bool has(const Line& line, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (line.text.find(word) == std::string::npos) return false;
    return true;
}

class CapiLog : public ::testing::Test {
protected:
    conn_status listen(std::int32_t level) {
        return conn_context_set_log(context.handle, level, keep, &lines);
    }
    conn_status rebuild(int n_lists = 1) {
        conn_nodes* const list = nodes.handle;
        return conn_map_rebuild(map.handle, &list, n_lists);
    }

    Lines lines;
    NodeSet set = random_nodes(3, 200, 1);
    Context context;
    Nodes nodes{context, 3, set};
    Map map{context};
};

TEST_F(CapiLog, is_silent_until_asked_and_after_it_was_told_to_be) {
    ASSERT_TRUE(ok(rebuild()));
    ASSERT_TRUE(ok(listen(CONN_LOG_INFO)));
    ASSERT_TRUE(ok(listen(CONN_LOG_NONE)));
    ASSERT_TRUE(ok(rebuild()));
    EXPECT_TRUE(fails(rebuild(0), CONN_E_ARGUMENT));
    EXPECT_TRUE(lines.empty());
}

TEST_F(CapiLog, a_rebuild_is_one_line_with_its_sizes) {
    ASSERT_TRUE(ok(listen(CONN_LOG_INFO)));
    ASSERT_TRUE(ok(rebuild()));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].level, CONN_LOG_INFO);
    const Lists lists = brute_force(3, {set});
    EXPECT_TRUE(has(lines[0], {"rebuild: generation 1, 1 lists, 200 slots, 200 rows, ",
                               std::to_string(2 * lists.pairs.size()) + " entries, ",
                               std::to_string(lists.pairs.size()) + " pairs, ", " bytes, ", " ms"}))
        << lines[0].text;
    EXPECT_EQ(lines[0].text.find('\n'), std::string::npos);
}

TEST_F(CapiLog, patches_removals_and_traversals_are_lines_too) {
    ASSERT_TRUE(ok(rebuild()));
    ASSERT_TRUE(ok(listen(CONN_LOG_INFO)));
    std::vector<std::int32_t> keep_all(200, 1), same(200);
    for (int k = 0; k < 200; ++k) same[static_cast<std::size_t>(k)] = k;
    ASSERT_TRUE(ok(conn_map_patch(map.handle, keep_all.data(), same.data(), 200, nullptr, 0)));
    const conn_pair_predicate none = [](void*, std::int32_t, std::int32_t) { return 0; };
    ASSERT_TRUE(ok(conn_map_remove_pairs(map.handle, none, nullptr, nullptr, 0)));
    const conn_rows_callback skip = [](void*, std::int32_t, std::int64_t, const std::int32_t*,
                                       const std::int64_t*, const std::int32_t*) { return 0; };
    ASSERT_TRUE(ok(conn_map_traverse(map.handle, &nodes.handle, 1, CONN_ROWS, skip, nullptr)));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_TRUE(has(lines[0], {": patch: generation 2"})) << lines[0].text;
    EXPECT_TRUE(has(lines[1], {": remove_pairs: generation 3"})) << lines[1].text;
    EXPECT_TRUE(has(lines[2], {": traversal: generation 3"})) << lines[2].text;
}

TEST_F(CapiLog, failures_say_what_the_last_error_says) {
    ASSERT_TRUE(ok(listen(CONN_LOG_ERROR)));
    ASSERT_TRUE(ok(rebuild()));
    set.h[17] = -1;
    ASSERT_TRUE(ok(nodes.set(3, set)));
    EXPECT_TRUE(fails(rebuild(), CONN_E_SUPPORT, {"17"}));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].level, CONN_LOG_ERROR);
    const std::string error = conn_last_error();
    EXPECT_TRUE(has(lines[0], {"rebuild: ", error.substr(error.find(": ") + 2)})) << lines[0].text;
}

TEST_F(CapiLog, arguments_that_are_refused_at_the_door_are_failures_too) {
    ASSERT_TRUE(ok(listen(CONN_LOG_ERROR)));
    EXPECT_TRUE(fails(rebuild(0), CONN_E_ARGUMENT));
    EXPECT_TRUE(
        fails(conn_map_patch(map.handle, nullptr, nullptr, -1, nullptr, 0), CONN_E_ARGUMENT));
    EXPECT_TRUE(
        fails(conn_map_remove_pairs(map.handle, nullptr, nullptr, nullptr, 0), CONN_E_NULL));
    EXPECT_TRUE(fails(conn_map_traverse(map.handle, &nodes.handle, 1, 9, nullptr, nullptr),
                      CONN_E_ARGUMENT));
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_TRUE(has(lines[0], {"rebuild: n_lists = 0"})) << lines[0].text;
    EXPECT_TRUE(has(lines[1], {"patch: n_slots = -1"})) << lines[1].text;
    EXPECT_TRUE(has(lines[2], {"remove_pairs: predicate"})) << lines[2].text;
    EXPECT_TRUE(has(lines[3], {"traversal: what = 9"})) << lines[3].text;
}

TEST_F(CapiLog, an_update_of_boundaries_is_one_line_with_the_ghosts_in_it) {
    const double wall[] = {0, 0, 0, 1, 0, 0};
    conn_boundaries* boundaries = nullptr;
    ASSERT_TRUE(ok(conn_boundaries_create(context.handle, 3, &boundaries)));
    ASSERT_TRUE(ok(conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, "wall", wall, 1)));
    ASSERT_TRUE(ok(listen(CONN_LOG_INFO)));
    ASSERT_TRUE(
        ok(conn_boundaries_update(boundaries, map.handle, &nodes.handle, 1, CONN_GHOSTS_KEEP)));
    conn_boundary_nodes all = CONN_BOUNDARY_NODES_INIT;
    ASSERT_TRUE(ok(conn_boundaries_get_nodes(boundaries, 0, &all)));
    EXPECT_GT(all.n, 200);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(has(lines[0], {": boundaries: generation 1, 1 lists, " + std::to_string(all.n) +
                               " slots, 200 rows, "}))
        << lines[0].text;
    EXPECT_TRUE(ok(conn_boundaries_destroy(&boundaries)));
}

TEST_F(CapiLog, debug_adds_a_line_for_each_product_that_was_built) {
    ASSERT_TRUE(ok(listen(CONN_LOG_DEBUG)));
    ASSERT_TRUE(ok(rebuild()));
    int n_rows = 0, n_pairs = 0;
    for (const Line& line : lines) {
        n_rows += has(line, {": rows: asked by caller"}) ? 1 : 0;
        n_pairs += has(line, {": pairs: asked by caller"}) ? 1 : 0;
        EXPECT_FALSE(has(line, {": overlap: "})) << line.text;
    }
    EXPECT_EQ(n_rows, 1);
    EXPECT_EQ(n_pairs, 1);
    EXPECT_EQ(lines[0].level, CONN_LOG_INFO);
    EXPECT_EQ(lines[1].level, CONN_LOG_DEBUG);
}

TEST_F(CapiLog, the_end_of_the_context_ends_it) {
    ASSERT_TRUE(ok(listen(CONN_LOG_DEBUG)));
    ASSERT_TRUE(ok(conn_context_destroy(&context.handle)));
    ASSERT_TRUE(ok(rebuild()));
    EXPECT_TRUE(lines.empty());
}

TEST_F(CapiLog, only_maps_of_the_context_speak) {
    const Context other;
    const Map quiet(other);
    ASSERT_TRUE(ok(listen(CONN_LOG_DEBUG)));
    ASSERT_TRUE(ok(quiet.rebuild({nodes.handle})));
    EXPECT_TRUE(lines.empty());
}

TEST_F(CapiLog, a_listener_that_calls_the_library_gets_an_error_and_breaks_nothing) {
    struct Caller {
        conn_map* map;
        conn_status status;
    } caller{map.handle, CONN_OK};
    const conn_log_callback call = [](void* data, std::int32_t, const char*) {
        auto& from = *static_cast<Caller*>(data);
        std::uint64_t generation = 0;
        from.status = conn_map_generation(from.map, &generation);
    };
    ASSERT_TRUE(ok(conn_context_set_log(context.handle, CONN_LOG_INFO, call, &caller)));
    ASSERT_TRUE(ok(rebuild()));
    EXPECT_EQ(caller.status, CONN_E_CALLBACK);
    EXPECT_STREQ(conn_last_error(), "");
    EXPECT_EQ(read_lists(map.handle), brute_force(3, {set}));
}

TEST_F(CapiLog, bad_levels_and_no_listener_are_refused) {
    EXPECT_TRUE(fails(listen(-1), CONN_E_ARGUMENT, {"level = -1"}));
    EXPECT_TRUE(fails(listen(4), CONN_E_ARGUMENT, {"level = 4"}));
    EXPECT_TRUE(fails(conn_context_set_log(context.handle, CONN_LOG_INFO, nullptr, nullptr),
                      CONN_E_NULL, {"callback"}));
    EXPECT_TRUE(ok(conn_context_set_log(context.handle, CONN_LOG_NONE, nullptr, nullptr)));
    EXPECT_TRUE(fails(conn_context_set_log(nullptr, CONN_LOG_NONE, nullptr, nullptr), CONN_E_NULL));
}

}  // namespace
}  // namespace connectivity::test
