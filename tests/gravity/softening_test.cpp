// SPDX-License-Identifier: BSD-3-Clause
// Both laws of softening by every method, with lengths that differ, against the definition.

#include <support/gravity_solve.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

constexpr GravityMethod all_methods[] = {GravityMethod::automatic, GravityMethod::direct,
                                         GravityMethod::walk, GravityMethod::fmm};

GravityScene softened(GravityScene scene, double least, double most) {
    Random random(5);
    for (std::int64_t i = 0; i < scene.n(); ++i)
        scene.e.push_back(i % 7 == 0 ? 0 : random.log_uniform(least, most));
    return scene;
}

TEST(SoftenedForces, are_the_definition_s) {
    const GravityScene scenes[] = {
        softened(plummer_scene(3000), 1e-4, 0.3), softened(coincident_scene(3000), 1e-6, 0.03),
        softened(corner_clumps_scene(3000), 0.01, 0.01), softened(uniform_scene(3000), 5, 50)};
    for (std::size_t k = 0; k < std::size(scenes); ++k)
        for (const bool plummer : {true, false}) {
            const auto targets = sample_targets(3000, 300);
            const auto expected =
                brute_gravity(scenes[k], targets, plummer ? BruteLaw::plummer : BruteLaw::sph_exa);
            for (const GravityMethod method : all_methods)
                for (const double tolerance : {1e-3, 1e-6}) {
                    GravityOptions options = to_tolerance(tolerance, method);
                    options.softening = plummer ? Softening::plummer : Softening::sph_exa;
                    const Deviations found(Forces(solved(scenes[k], options)), targets, expected);
                    SCOPED_TRACE(::testing::Message()
                                 << "scene " << k << (plummer ? "" : " sph") << ' '
                                 << name_of(method) << ' ' << tolerance);
                    EXPECT_LE(Deviations::p99(found.acceleration), tolerance);
                    EXPECT_LE(Deviations::p99(found.potential), 3 * tolerance);
                }
        }
}

/// Also of lengths that differ, and in periodic boxes with the pair's images.
TEST(SoftenedPairs, act_on_each_other_equally) {
    for (const Softening softening : {Softening::plummer, Softening::sph_exa})
        for (const GravityMethod method : all_methods)
            for (const double length : {0.0, 0.01, 0.1, 3.0}) {
                GravityScene pair;
                pair.add(0.25, 0.5, 0.5, 2);
                pair.add(0.3125, 0.5, 0.625, 2);
                pair.e = {length, 0.01};
                GravityOptions options = to_tolerance(1e-6, method);
                options.softening = softening;
                const Forces forces(solved(pair, options));
                for (std::size_t d = 0; d < 3; ++d)
                    EXPECT_EQ(forces.a[d], -forces.a[3 + d]) << name_of(method) << ' ' << length;
                EXPECT_EQ(forces.p[0], forces.p[1]);
            }
}

TEST(SoftenedPairs, at_one_place_have_no_force) {
    for (const double length : {0.0, 0.05})
        for (const GravityMethod method : all_methods) {
            GravityScene pair;
            pair.add(1, 2, 3, 1);
            pair.add(1, 2, 3, 4);
            pair.e = {length, 0};
            const Forces forces(solved(pair, to_tolerance(1e-4, method)));
            for (const double a : forces.a) EXPECT_EQ(a, 0);
            EXPECT_DOUBLE_EQ(forces.p[0], length > 0 ? 4 / length : 0);
        }
}

}  // namespace
}  // namespace connectivity::test
