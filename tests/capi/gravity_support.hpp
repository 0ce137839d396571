// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the tests of gravity share: handles and views that end themselves, a scene as a host has
/// it, and its forces by brute force.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <connectivity_gravity.h>
#include <support/gravity_brute.hpp>

#include "capi_support.hpp"

namespace connectivity::test {

struct GravityHandle {
    conn_gravity* handle = nullptr;
    explicit GravityHandle(const Context& context) {
        EXPECT_TRUE(ok(conn_gravity_create(context.handle, &handle)));
    }
    ~GravityHandle() { EXPECT_TRUE(ok(conn_gravity_destroy(&handle))); }
    GravityHandle(const GravityHandle&) = delete;
    GravityHandle& operator=(const GravityHandle&) = delete;

    /// Separate x, y and z.
    conn_status solve(const GravityScene& scene,
                      const conn_gravity_options& options = CONN_GRAVITY_OPTIONS_INIT) const {
        const auto values = [&](const std::vector<double>& v) {
            return conn_array_vector(v.data(), scene.n());
        };
        const conn_array x[3] = {values(scene.x), values(scene.y), values(scene.z)},
                         m = values(scene.m), e = values(scene.e);
        return conn_gravity_solve(handle, x, 3, &m, scene.e.empty() ? nullptr : &e, &options);
    }
    conn_gravity_info info() const {
        conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
        EXPECT_TRUE(ok(conn_gravity_get_info(handle, &info)));
        return info;
    }
};

/// A view that is released at the end.
struct Forces {
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    explicit Forces(const GravityHandle& gravity) {
        EXPECT_TRUE(ok(conn_gravity_acquire(gravity.handle, CONN_SPACE_HOST, &view)));
    }
    ~Forces() { EXPECT_TRUE(ok(conn_gravity_release(&view))); }
    Forces(const Forces&) = delete;
    Forces& operator=(const Forces&) = delete;
    const conn_gravity_view* operator->() const { return &view; }

    std::vector<double> acceleration() const {
        return {view.acceleration, view.acceleration + 3 * view.n};
    }
    std::vector<double> potential() const { return {view.potential, view.potential + view.n}; }
};

inline conn_gravity_options gravity_method(int method, double tolerance = 1e-4) {
    conn_gravity_options options = CONN_GRAVITY_OPTIONS_INIT;
    options.method = method;
    options.tolerance = tolerance;
    return options;
}

/// The largest errors, of the acceleration as a share of the sum of the terms' lengths, of the
/// potential as one of their absolute values; and the 99th percentile of |error of a| / |a|.
struct ForceErrors {
    double acceleration = 0, potential = 0, p99 = 0;
};
inline ForceErrors errors_of(const std::vector<double>& a, const std::vector<double>& potential,
                             const std::vector<BruteSum>& expected) {
    ForceErrors errors;
    std::vector<double> relative;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const BruteSum& s = expected[i];
        const long double error = distance(s, a[3 * i], a[3 * i + 1], a[3 * i + 2]);
        errors.acceleration = std::max(errors.acceleration, static_cast<double>(error / s.size_a));
        errors.potential = std::max(errors.potential,
                                    static_cast<double>(std::abs(potential[i] + s.p) / s.size_p));
        relative.push_back(static_cast<double>(error / length(s)));
    }
    std::sort(relative.begin(), relative.end());
    errors.p99 = relative[(99 * relative.size() + 99) / 100 - 1];
    return errors;
}

}  // namespace connectivity::test
