// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A call whose allocations fail, one after the other.

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

#include "failing_malloc.hpp"

namespace connectivity::test {

/// Calls f with the k-th allocation failing, for k = 0, 1, ..., until f needs fewer. check() runs
/// after every failure. Returns how many allocations f makes.
template <class F, class Check>
long fail_each_allocation(const F& f, const Check& check) {
    for (long k = 0;; ++k) {
        bool failed = true;
        Status status = Status::ok;
        allocations_left = k;
        try {
            f();
            failed = false;
        } catch (const Error& error) {
            allocations_left = -1;
            status = error.status();
        }
        const bool enough = allocations_left >= 0;
        allocations_left = -1;
        if (!failed) {
            EXPECT_TRUE(enough) << "a failed allocation " << k << " went unnoticed";
            return k;
        }
        EXPECT_EQ(status, Status::memory) << "allocation " << k;
        check();
        if (::testing::Test::HasFailure()) return k;
    }
}

}  // namespace connectivity::test
