// SPDX-License-Identifier: BSD-3-Clause
// Newton's third law to round-off where it was asked for.

#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

/// |sum m a| / sum m |a|, in long double.
double drift(const GravityScene& scene, const Forces& forces) {
    long double sum[3] = {}, size = 0;
    for (std::int64_t i = 0; i < scene.n(); ++i) {
        const long double m = scene.m[static_cast<std::size_t>(i)];
        const double* const a = forces[i];
        for (int d = 0; d < 3; ++d) sum[d] += m * a[d];
        size += std::abs(m) * std::hypot(static_cast<long double>(a[0]), a[1], a[2]);
    }
    return static_cast<double>(std::hypot(sum[0], sum[1], sum[2]) / size);
}

class Momentum : public ::testing::TestWithParam<const char*> {};

TEST_P(Momentum, is_kept_by_direct_and_symmetric_sums) {
    for (const std::int64_t n : {2, 10, 4000}) {
        const GravityScene scene = make_gravity_scene(GetParam(), n);
        GravityOptions options = to_tolerance(1e-4);
        options.symmetric = true;
        for (const double tolerance : {1e-2, 1e-6})
            for (const GravityMethod method :
                 {GravityMethod::automatic, GravityMethod::direct, GravityMethod::fmm}) {
                options.method = method;
                options.tolerance = tolerance;
                EXPECT_LE(drift(scene, Forces(solved(scene, options))), 1e-14)
                    << name_of(method) << ' ' << n << ' ' << tolerance;
            }
    }
}

TEST_P(Momentum, is_kept_by_every_criterion_order_and_softening) {
    GravityScene scene = make_gravity_scene(GetParam(), 3000);
    for (const bool softened : {false, true})
        for (const Acceptance acceptance :
             {Acceptance::field, Acceptance::acceleration, Acceptance::geometric})
            for (const int order : {1, 2, 5, 10}) {
                GravityOptions options = by_hand(GravityMethod::fmm, order, 0.4, acceptance);
                options.symmetric = true;
                if (softened) scene.e.assign(3000, 1e-5);
                const Gravity gravity = solved(scene, options);
                EXPECT_LE(drift(scene, Forces(gravity)), 1e-14)
                    << static_cast<int>(acceptance) << " order " << order;
            }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Momentum, ::testing::ValuesIn(all_gravity_scenes),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(Momentum, is_kept_in_periodic_boxes) {
    for (const char* const name : {"uniform", "corner_clumps"}) {
        const GravityScene scene = make_gravity_scene(name, 3000);
        for (const GravityMethod method : {GravityMethod::direct, GravityMethod::fmm}) {
            GravityOptions options = to_tolerance(1e-4, method);
            options.symmetric = true;
            options.domain = periodic_box();
            EXPECT_LE(drift(scene, Forces(solved(scene, options))), 1e-14)
                << name << ' ' << name_of(method);
        }
    }
}

}  // namespace
}  // namespace connectivity::test
