// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// C calls that are made again and again while their first, second, ... allocation fails: CONN_OK
/// or CONN_E_MEMORY, and what there was stays.

#include <functional>

#include <capi/capi_support.hpp>

#include "failing_malloc.hpp"

namespace connectivity::test {

constexpr double skin = 1e-3;

inline conn_map_options all_products() {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.spatial_order = options.overlap = 1;
    options.intersection = CONN_INTERSECTION_ALL;
    options.skin = skin;
    return options;
}

/// What a skin makes of the supports.
inline NodeSet widened(NodeSet set) {
    for (double& h : set.h) h += skin / set.extent;
    return set;
}

class CSession : public ::testing::Test {
protected:
    void SetUp() override {
        if (!can_fail) GTEST_SKIP() << "the sanitizer has a malloc of its own";
        context_ = std::make_unique<Context>(1);
    }

    using Call = std::function<conn_status()>;
    using Check = std::function<void()>;

    /// Makes the call with its k-th allocation failing, for k = 0, 1, ..., until it needs fewer.
    /// A call may do without the memory, but then is to be complete. check() runs after every
    /// failure; undo() after every success but the last.
    void each_allocation(
        const char* name, const Call& call, const Check& check = [] {}, const Check& undo = [] {}) {
        SCOPED_TRACE(name);
        for (long k = 0; !HasFailure(); ++k) {
            allocations_left = k;
            const conn_status status = call();
            const bool enough = allocations_left >= 0;
            allocations_left = -1;
            if (status == CONN_OK) {
                if (enough) {
                    n_failed_ += k;
                    return;
                }
                undo();
                continue;
            }
            ASSERT_EQ(status, CONN_E_MEMORY) << "allocation " << k << ": " << conn_last_error();
            ASSERT_FALSE(enough) << conn_last_error();
            ASSERT_STRNE(conn_last_error(), "");
            check();
        }
    }

    /// The same for a call that changes a map: after a failure its lists are those of before.
    void each_allocation_keeps(
        const char* name, conn_map* map, const Call& call, const Check& undo = [] {}) {
        const Lists before = read_lists(map);
        const std::uint64_t generation = generation_of(map);
        each_allocation(
            name, call,
            [&] {
                ASSERT_EQ(generation_of(map), generation);
                ASSERT_EQ(read_lists(map), before);
            },
            undo);
    }

    static std::uint64_t generation_of(conn_map* map) {
        std::uint64_t generation = 0;
        EXPECT_TRUE(ok(conn_map_generation(map, &generation)));
        return generation;
    }

    conn_context* context() const { return context_->handle; }

    static constexpr int n = 60;
    std::unique_ptr<Context> context_;
    const NodeSet old_ = random_nodes(2, 45, 1), now_ = random_nodes(2, n, 2);
    long n_failed_ = 0;
};

}  // namespace connectivity::test
