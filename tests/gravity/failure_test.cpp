// SPDX-License-Identifier: BSD-3-Clause
// Where methods fail: scales that are far apart, cells with all mass in a corner, one place for
// many, no mass and masses of both signs, units at the ends of the range.

#include <support/expect_error.hpp>
#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

constexpr GravityMethod all_methods[] = {GravityMethod::automatic, GravityMethod::direct,
                                         GravityMethod::walk, GravityMethod::fmm};
constexpr GravityMethod methods[] = {GravityMethod::walk, GravityMethod::fmm};

Deviations deviations(const GravityScene& scene, const GravityOptions& options,
                      BruteLaw law = BruteLaw::newton) {
    const auto targets = sample_targets(scene.n(), 300);
    return {Forces(solved(scene, options)), targets, brute_gravity(scene, targets, law)};
}

/// A light particle must not accept the cell it is in, whose centre of mass is far away.
TEST(CornerClumps, are_never_wrong_by_much_whatever_the_setting) {
    const GravityScene scene = corner_clumps_scene(4000);
    const auto targets = sample_targets(4000, 1000);
    const auto expected = brute_gravity(scene, targets);
    Gravity gravity;
    for (const GravityMethod method : methods)
        for (const int order : {2, 3, 5, 10})
            for (const double angle : {0.3, 0.58, 0.7, 0.95}) {
                solve(gravity, scene, by_hand(method, order, angle, Acceptance::geometric));
                const Deviations found(Forces(gravity), targets, expected);
                // What is neglected first of every pair, summed.
                const double bound = (order + 2) * std::pow(angle, order) / (1 - angle);
                EXPECT_LE(Deviations::max(found.field), bound)
                    << name_of(method) << " order " << order << " angle " << angle;
            }
}

TEST(CornerClumps, reach_the_tolerance_with_no_error_above_100_times_it) {
    for (const std::int64_t n : {2000, 6000}) {
        const GravityScene scene = corner_clumps_scene(n);
        const auto targets = sample_targets(n, 2000);
        const auto expected = brute_gravity(scene, targets);
        for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-5, 1e-7})
            for (const Acceptance acceptance :
                 {Acceptance::field, Acceptance::acceleration, Acceptance::geometric})
                for (const GravityMethod method : methods) {
                    GravityOptions options = to_tolerance(tolerance, method);
                    options.acceptance = acceptance;
                    const Deviations found(Forces(solved(scene, options)), targets, expected);
                    SCOPED_TRACE(::testing::Message()
                                 << name_of(method) << ' ' << n << ' ' << tolerance
                                 << " acceptance " << static_cast<int>(acceptance));
                    EXPECT_LE(Deviations::p99(found.acceleration), tolerance);
                    EXPECT_LE(Deviations::max(found.acceleration), 100 * tolerance);
                }
    }
}

/// Random scenes of a heavy and a light clump in one cell: nobody is off by 100 %.
TEST(OneHeavyCorner, is_never_taken_for_a_point_by_its_own_particles) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const GravityScene scene = one_heavy_corner_scene(64, seed);
        const auto expected = brute_gravity(scene);
        const auto targets = sample_targets(64, 64);
        for (const GravityMethod method : methods) {
            auto options = by_hand(method, 2, 0.9, Acceptance::geometric);
            options.leaf = 1;
            options.n_samples = 0;
            const Deviations found(Forces(solved(scene, options)), targets, expected);
            ASSERT_LE(Deviations::max(found.field), 0.5) << name_of(method) << ' ' << seed;
        }
    }
}

TEST(Scales, seven_decades_apart_and_more_are_right) {
    for (const double ratio : {1e-7, 1e-12}) {
        GravityScene scene = plummer_scene(2000).scale(1, 0.5);
        scene.append(plummer_scene(2000, 9).scale(ratio, 0.5));  // around 0, where doubles are fine
        for (const GravityMethod method : methods)
            for (const double tolerance : {1e-3, 1e-6})
                EXPECT_LE(Deviations::p99(
                              deviations(scene, to_tolerance(tolerance, method)).acceleration),
                          tolerance)
                    << name_of(method) << ' ' << ratio;
    }
}

template <class Real>
void expect_any_units(double relative) {
    for (const double lengths : {1e-12, 1.0, 1e12})
        for (const double masses : {1e-12, 1.0, 1e12})
            for (const GravityMethod method : all_methods) {
                SCOPED_TRACE(::testing::Message()
                             << name_of(method) << ' ' << lengths << ' ' << masses);
                start_runtime();
                const SceneArrays<Real> arrays(plummer_scene(800).scale(lengths, masses));
                Gravity gravity;
                gravity.solve(arrays.particles(), to_tolerance(1e-6, method));
                const auto targets = sample_targets(800, 200);
                const Deviations found(Forces(gravity), targets,
                                       brute_gravity(arrays.scene(), targets));
                EXPECT_LE(Deviations::p99(found.acceleration), relative);
                EXPECT_LE(Deviations::p99(found.potential), relative);
            }
}

TEST(Units, of_any_size_are_right_in_double) { expect_any_units<double>(1e-6); }
TEST(Units, of_any_size_are_right_in_float) { expect_any_units<float>(1e-6); }

TEST(Units, at_the_ends_of_the_range_are_right_or_refused) {
    for (const double lengths : {1e-300, 1e-150, 1e150, 1e300})
        for (const GravityMethod method : all_methods) {
            const GravityScene scene = plummer_scene(500).scale(lengths);
            SCOPED_TRACE(::testing::Message() << name_of(method) << ' ' << lengths);
            try {
                const Forces forces(solved(scene, to_tolerance(1e-6, method)));
                for (const double a : forces.a) ASSERT_TRUE(std::isfinite(a));
                for (const double p : forces.p) ASSERT_TRUE(std::isfinite(p));
                EXPECT_GT(lengths, 1e-200);
            } catch (const Error& error) {
                EXPECT_EQ(error.status(), Status::nonfinite) << error.what();
                EXPECT_LT(lengths, 1e-100);
            }
        }
}

TEST(Masses, that_are_all_0_have_no_forces) {
    GravityScene scene = plummer_scene(2000);
    scene.m.assign(2000, 0);
    for (const GravityMethod method : all_methods) {
        const Gravity gravity = solved(scene, to_tolerance(1e-4, method));
        EXPECT_TRUE(gravity.info().reached);
        const Forces forces(gravity);
        for (const double a : forces.a) ASSERT_EQ(a, 0);
        for (const double p : forces.p) ASSERT_EQ(p, 0);
    }
}

/// Every second one, or all of a cell, or of both signs, with a sum that is 0 or not.
TEST(Masses, of_0_and_of_both_signs_are_right) {
    GravityScene scenes[5];
    for (int k = 0; k < 5; ++k) {
        scenes[k] = plummer_scene(2000);
        for (std::size_t i = 0; i < 2000; ++i) {
            double& m = scenes[k].m[i];
            if (k == 0 && i % 2 == 0) m = 0;
            if (k == 1 && scenes[k].x[i] > 0) m = 0;
            if (k == 2 && i % 3 == 0) m = -m;
            if (k == 3 && i % 2 == 0) m = -m;  // the sum is 0
            if (k == 4 && i > 0) m = 0;
        }
        for (const GravityMethod method : all_methods)
            for (const double tolerance : {1e-3, 1e-7}) {
                SCOPED_TRACE(::testing::Message()
                             << name_of(method) << " kind " << k << " to " << tolerance);
                const Deviations found = deviations(scenes[k], to_tolerance(tolerance, method));
                EXPECT_LE(Deviations::p99(found.acceleration), tolerance);
            }
    }
}

TEST(OnePlace, for_all_has_no_forces_and_the_potential_of_the_softening) {
    for (const std::int64_t n : {2, 100, 5000})
        for (const double softening : {0.0, 0.125})
            for (const GravityMethod method : all_methods) {
                GravityScene scene;
                for (std::int64_t i = 0; i < n; ++i) scene.add(0.1, -3, 7e5, 1);
                if (softening > 0) scene.e.assign(scene.x.size(), softening);
                const Forces forces(solved(scene, to_tolerance(1e-5, method)));
                for (const double a : forces.a) ASSERT_EQ(a, 0);
                for (const double p : forces.p)
                    ASSERT_NEAR(p, softening > 0 ? static_cast<double>(n - 1) / softening : 0,
                                1e-10 * static_cast<double>(n));
            }
}

/// All but one particle in a speck, many levels down, at 0 and at 1.
TEST(OneCell, with_all_the_mass_is_right) {
    for (const double at : {0.0, 1.0}) {
        GravityScene scene = uniform_scene(3000).scale(at == 0 ? 1e-30 : 1e-12).shift(at, at, at);
        scene.add(-1, 2, -1, 1e-4);
        for (const GravityMethod method : methods)
            EXPECT_LE(Deviations::p99(deviations(scene, to_tolerance(1e-4, method)).acceleration),
                      1e-4)
                << name_of(method) << ' ' << at;
    }
}

TEST(Few, particles_or_none_are_right_by_every_method) {
    for (const GravityMethod method : all_methods) {
        EXPECT_EQ(solved(GravityScene{}, to_tolerance(1e-4, method)).n(), 0);
        const Forces one(solved(plummer_scene(1), to_tolerance(1e-4, method)));
        for (const double a : one.a) EXPECT_EQ(a, 0);
        EXPECT_EQ(one.p, std::vector<double>{0});
    }
}

}  // namespace
}  // namespace connectivity::test
