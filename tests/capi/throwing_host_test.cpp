// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of a C++ host's callbacks, which the header forbids: where they come out as an error
// nothing is lost.

#include <stdexcept>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

class CapiThrowingHost : public ::testing::Test {
protected:
    static std::int32_t predicate(void*, std::int32_t i, std::int32_t) {
        if (i == 7) throw std::runtime_error("the host is tired");
        return 0;
    }
    static double function(void*, std::int32_t i, std::int32_t) {
        if (i == 7) throw std::runtime_error("the host is tired");
        return 0.5;
    }
    static std::int32_t rows(void*, std::int32_t, std::int64_t, const std::int32_t*,
                             const std::int64_t*, const std::int32_t*) {
        throw std::runtime_error("the host is tired");
    }
    static void line(void*, std::int32_t, const char*) {
        throw std::runtime_error("the host is tired");
    }
    static std::int32_t nonsense(void*, std::int32_t i, std::int32_t) {
        if (i == 7) throw 7;
        return 0;
    }

    void expect_error_and_old_lists(conn_status status) {
        EXPECT_TRUE(fails(status, CONN_E_CALLBACK, {"threw"}));
        EXPECT_EQ(map.generation(), generation);
        EXPECT_EQ(read_lists(map.handle), before);
    }

    const Context context;
    const Built built{context, 2, {random_nodes(2, 400, 3)}};
    const Map& map = built.map;
    const std::uint64_t generation = map.generation();
    const Lists before = read_lists(map.handle);
};

TEST_F(CapiThrowingHost, a_traversal_stops) {
    for (const int what : {CONN_ROWS, CONN_PAIRS})
        expect_error_and_old_lists(
            conn_map_traverse(map.handle, built.lists.data(), 1, what, rows, nullptr));
}

TEST_F(CapiThrowingHost, pairs_are_not_removed_and_coupling_is_not_set) {
    expect_error_and_old_lists(conn_map_remove_pairs(map.handle, predicate, nullptr, nullptr, 0));
    expect_error_and_old_lists(conn_map_remove_pairs(map.handle, nonsense, nullptr, nullptr, 0));
    expect_error_and_old_lists(conn_map_set_coupling_function(map.handle, function, nullptr));
}

TEST_F(CapiThrowingHost, a_rebuild_keeps_the_old_lists) {
    for (const int order : {CONN_ORDER_SLOT, CONN_ORDER_KEY}) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        options.order = order;
        ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
        for (const conn_pair_predicate thrower : {predicate, nonsense}) {
            ASSERT_TRUE(ok(conn_map_set_exclusion(map.handle, thrower, nullptr)));
            expect_error_and_old_lists(built.rebuild());
        }
    }
    ASSERT_TRUE(ok(conn_map_set_exclusion(map.handle, nullptr, nullptr)));
    EXPECT_TRUE(ok(built.rebuild()));
}

TEST_F(CapiThrowingHost, a_traversal_that_leaves_pairs_out_stops) {
    ASSERT_TRUE(ok(conn_map_set_exclusion(map.handle, predicate, nullptr)));
    std::int64_t sum = 0;
    const conn_rows_callback count = [](void*, std::int32_t, std::int64_t, const std::int32_t*,
                                        const std::int64_t*, const std::int32_t*) { return 0; };
    expect_error_and_old_lists(
        conn_map_traverse(map.handle, built.lists.data(), 1, CONN_ROWS, count, &sum));
}

TEST_F(CapiThrowingHost, a_line_of_the_log_is_lost_and_nothing_else) {
    ASSERT_TRUE(ok(conn_context_set_log(context.handle, CONN_LOG_DEBUG, line, nullptr)));
    EXPECT_TRUE(ok(built.rebuild()));
    EXPECT_EQ(read_lists(map.handle), before);
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, nullptr, 1), CONN_E_NULL));
}

}  // namespace
}  // namespace connectivity::test
