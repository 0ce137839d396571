// SPDX-License-Identifier: BSD-3-Clause
// Forces are as good as was asked, whatever the scene and the method, and not much better where
// that costs time. CONNECTIVITY_GRAVITY_N is the number of many particles.

#include <cstdlib>

#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

constexpr double all_tolerances[] = {1e-2, 1e-4, 1e-6, 1e-9};
constexpr GravityMethod all_methods[] = {GravityMethod::automatic, GravityMethod::walk,
                                         GravityMethod::fmm};

/// Fewer are as fast by direct sums.
constexpr std::int64_t least_used = 20000;

/// A looser setting would do less work.
bool could_be_looser(const GravityInfo& info) {
    return info.method != GravityMethod::direct && info.n_far > 0 && info.epsilon < 1e4;
}

void expect_tolerance(const GravityScene& scene, const std::vector<std::int64_t>& targets,
                      const std::vector<BruteSum>& expected) {
    Gravity gravity;
    for (const double tolerance : all_tolerances)
        for (const GravityMethod method : all_methods) {
            solve(gravity, scene, to_tolerance(tolerance, method));
            const GravityInfo& info = gravity.info();
            SCOPED_TRACE(::testing::Message()
                         << name_of(method) << " as " << name_of(info.method) << " of " << scene.n()
                         << " to " << tolerance << ": order " << info.order << ", epsilon "
                         << info.epsilon << ", sample's p99 " << info.acceleration.p99);
            const Deviations found(Forces(gravity), targets, expected);
            const double p99 = Deviations::p99(found.acceleration);
            EXPECT_TRUE(info.reached);
            EXPECT_LE(p99, tolerance);
            if (scene.n() >= least_used && could_be_looser(info)) {
                EXPECT_GE(p99, 0.05 * tolerance);
            }
        }
}

class Tolerance : public ::testing::TestWithParam<const char*> {};

void expect_tolerance_of(const char* name, std::int64_t n) {
    const GravityScene scene = make_gravity_scene(name, n);
    const auto targets = sample_targets(n, 1000);
    expect_tolerance(scene, targets, brute_gravity(scene, targets));
}

TEST_P(Tolerance, is_reached_by_99_of_100_particles) {
    for (const std::int64_t n : {2, 3, 10, 100, 1000, 5000}) expect_tolerance_of(GetParam(), n);
}

TEST_P(Tolerance, is_reached_by_99_of_100_of_many_particles_and_used) {
    const char* const n = std::getenv("CONNECTIVITY_GRAVITY_N");
    expect_tolerance_of(GetParam(), n != nullptr ? std::atol(n) : 20000);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Tolerance, ::testing::ValuesIn(all_gravity_scenes),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace connectivity::test
