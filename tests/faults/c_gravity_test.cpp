// SPDX-License-Identifier: BSD-3-Clause
// Gravity without memory: the forces that there were stay.

#include <support/gravity_scenes.hpp>

#include "c_session.hpp"
#include "connectivity_gravity.h"

namespace connectivity::test {
namespace {

class CGravity : public CSession {
protected:
    void SetUp() override {
        CSession::SetUp();
        if (IsSkipped()) return;
        ASSERT_TRUE(ok(conn_gravity_create(context(), &gravity_)));
    }
    void TearDown() override { EXPECT_TRUE(ok(conn_gravity_destroy(&gravity_))); }

    /// Separate axes, which are copied.
    conn_status solve(const GravityScene& scene, const conn_gravity_options& options) const {
        const auto values = [&](const std::vector<double>& v) {
            return conn_array_vector(v.data(), scene.n());
        };
        const conn_array x[3] = {values(scene.x), values(scene.y), values(scene.z)},
                         m = values(scene.m);
        return conn_gravity_solve(gravity_, x, 3, &m, nullptr, &options);
    }
    /// Accelerations, potentials, and what says how they were found.
    std::vector<double> state() const {
        conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
        conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
        std::int64_t length = 0;
        EXPECT_TRUE(ok(conn_gravity_acquire(gravity_, 0, &view)));
        EXPECT_TRUE(ok(conn_gravity_get_info(gravity_, &info)));
        EXPECT_TRUE(ok(conn_gravity_report_text(gravity_, nullptr, 0, &length)));
        std::vector<double> all(view.acceleration, view.acceleration + 3 * view.n);
        all.insert(all.end(), view.potential, view.potential + view.n);
        for (const double number :
             {double(info.n), double(info.generation), double(info.method), info.epsilon,
              double(info.n_near), info.acceleration_max, double(length)})
            all.push_back(number);
        EXPECT_TRUE(ok(conn_gravity_release(&view)));
        return all;
    }

    conn_gravity* gravity_ = nullptr;
};

/// By cells and directly, in a box without end where is_periodic.
conn_gravity_options choices(int method, bool is_periodic) {
    conn_gravity_options options = CONN_GRAVITY_OPTIONS_INIT;
    options.method = method;
    options.tolerance = 1e-2;
    options.n_samples = 20;
    options.error_bound = is_periodic ? 0 : 1;
    for (int d = 0; d < 3 && is_periodic; ++d) {
        options.periodic[d] = 1;
        options.box_hi[d] = 100;
    }
    return options;
}

TEST_F(CGravity, solutions_that_fail_keep_the_old_forces) {
    const GravityScene old = plummer_scene(40, 1), now = plummer_scene(150, 2);
    const conn_gravity_options direct = choices(CONN_GRAVITY_DIRECT, false);
    for (const conn_gravity_options& options :
         {direct, choices(CONN_GRAVITY_WALK, false), choices(CONN_GRAVITY_FMM, false),
          choices(CONN_GRAVITY_FMM, true)}) {
        SCOPED_TRACE(options.method);
        std::vector<double> before;
        const auto restart = [&] {
            ASSERT_TRUE(ok(conn_gravity_destroy(&gravity_)));
            ASSERT_TRUE(ok(conn_gravity_create(context(), &gravity_)));
            ASSERT_TRUE(ok(solve(old, direct)));
            ASSERT_TRUE(ok(conn_gravity_release_scratch(gravity_)));
            before = state();
        };
        restart();
        each_allocation(
            "conn_gravity_solve", [&] { return solve(now, options); },
            [&] {  // what is kept for the next call would spare it its allocations
                ASSERT_TRUE(ok(conn_gravity_release_scratch(gravity_)));
                ASSERT_EQ(state(), before);
            },
            restart);
        ASSERT_NE(state(), before);
    }
    EXPECT_GT(n_failed_, 200);
}

TEST_F(CGravity, results_that_fail_hold_nothing) {
    conn_gravity* made = nullptr;
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    ASSERT_TRUE(ok(solve(plummer_scene(50), CONN_GRAVITY_OPTIONS_INIT)));
    std::vector<double> a(150);
    const conn_array out = conn_array_matrix(a.data(), 50, 3);
    each_allocation(
        "conn_gravity_create", [&] { return conn_gravity_create(context(), &made); },
        [&] { ASSERT_EQ(made, nullptr); }, [&] { conn_gravity_destroy(&made); });
    each_allocation(
        "conn_gravity_acquire", [&] { return conn_gravity_acquire(gravity_, 0, &view); },
        [&] { ASSERT_EQ(view.owner, nullptr); }, [&] { conn_gravity_release(&view); });
    each_allocation("conn_gravity_copy",
                    [&] { return conn_gravity_copy(gravity_, &out, 1, nullptr, nullptr); });
    EXPECT_TRUE(ok(conn_gravity_release(&view)));
    EXPECT_TRUE(ok(conn_gravity_destroy(&made)));
    EXPECT_GT(n_failed_, 2);
}

}  // namespace
}  // namespace connectivity::test
