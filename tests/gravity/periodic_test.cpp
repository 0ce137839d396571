// SPDX-License-Identifier: BSD-3-Clause
// Periodic boxes against Ewald's sum, and what is known of crystals.

#include <numbers>

#include <support/ewald_brute.hpp>
#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

constexpr GravityMethod methods[] = {GravityMethod::direct, GravityMethod::walk,
                                     GravityMethod::fmm};

GravityOptions in_box(double tolerance, GravityMethod method, const Domain& box = periodic_box()) {
    GravityOptions options = to_tolerance(tolerance, method);
    options.domain = box;
    return options;
}

std::vector<BruteSum> ewald(const GravityScene& scene, const std::vector<std::int64_t>& targets,
                            const std::array<double, 3>& box = {1, 1, 1}) {
    const auto gather = [&](const auto& which) {
        std::vector<double> x;
        for (const std::int64_t i : which)
            for (const auto* const axis : {&scene.x, &scene.y, &scene.z})
                x.push_back((*axis)[static_cast<std::size_t>(i)]);
        return x;
    };
    const auto sums =
        ewald_brute(box, gather(sample_targets(scene.n(), scene.n())), scene.m, gather(targets));
    std::vector<BruteSum> result(targets.size());
    for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = {sums.p[k], {sums.a[3 * k], sums.a[3 * k + 1], sums.a[3 * k + 2]}};
    return result;
}

GravityScene crystal(int side, bool sodium_chloride) {
    GravityScene scene;
    for (int i = 0; i < side * side * side; ++i) {
        const int x = i / (side * side), y = i / side % side, z = i % side;
        if (sodium_chloride) {
            scene.add(x, y, z, (x + y + z) % 2 == 0 ? 1 : -1);
        } else {
            scene.add(x, y, z, 1);
            scene.add(x + 0.5, y + 0.5, z + 0.5, -1);
        }
    }
    return scene;
}

/// sum |m|/r² over a ball as wide as the box, its mean density 1: where forces are 0, errors are
/// shares of it.
double field_of_unit_density(double side) { return 4 * std::numbers::pi * side / 2; }

TEST(Crystal, has_the_constant_of_madelung_and_no_forces) {
    struct Kind {
        bool sodium_chloride;
        double madelung;
    };
    for (const Kind kind : {Kind{true, -1.747564594633182190}, Kind{false, -1.762674773070988}})
        for (const int side : {2, 6})
            for (const GravityMethod method : methods) {
                SCOPED_TRACE(::testing::Message() << name_of(method) << ' ' << side);
                const GravityScene scene = crystal(side, kind.sodium_chloride);
                const double distance = kind.sodium_chloride ? 1 : std::sqrt(0.75);
                auto options = in_box(1e-6, method, periodic_box(side, side, side));
                const Forces forces(solved(scene, options));
                double worst_p = 0, worst_a = 0;
                for (std::size_t i = 0; i < forces.p.size(); ++i) {
                    const double p = forces.p[i] * scene.m[i] * distance;
                    worst_p = std::max(worst_p, std::abs(p - kind.madelung));
                    for (int d = 0; d < 3; ++d)
                        worst_a = std::max(worst_a, std::abs(forces.a[3 * i + d]));
                }
                EXPECT_LE(worst_p, 1e-6);
                EXPECT_LE(worst_a, 1e-6 * field_of_unit_density(side));
            }
}

TEST(Lattice, of_equal_masses_has_no_forces) {
    const GravityScene scene = cold_cube_scene(1000);
    for (const double tolerance : {1e-2, 1e-6})
        for (const GravityMethod method :
             {GravityMethod::automatic, GravityMethod::walk, GravityMethod::fmm}) {
            const Gravity gravity = solved(scene, in_box(tolerance, method));
            const Forces forces(gravity);
            double worst = 0;
            for (const double a : forces.a) worst = std::max(worst, std::abs(a));
            EXPECT_LE(worst, tolerance * field_of_unit_density(1))
                << name_of(method) << ' ' << tolerance;
        }
}

struct Boxed {
    const char* name;
    GravityScene scene;
    std::array<double, 3> box;
};

GravityScene clusters_on_faces(std::int64_t n) {
    GravityScene scene = plummer_scene(n - n / 2).scale(0.004, 0.5);
    scene.append(plummer_scene(n / 2, 99).scale(0.01, 0.5).shift(0.4, 0.7, 0));
    return scene;
}

GravityScene in_long_box(std::int64_t n) {
    GravityScene scene = uniform_scene(n);
    for (double& y : scene.y) y *= 2;
    for (double& z : scene.z) z = 3 * z * z;
    return scene;
}

GravityScene clumps_on_faces(std::int64_t n) {
    return corner_clumps_scene(n).shift(-0.002, -0.002, -0.002);
}

class Periodic : public ::testing::TestWithParam<int> {};

/// What a solution misses of another one.
std::vector<double> errors_against(const Forces& reference, const Forces& forces) {
    std::vector<double> errors;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(forces.p.size()); ++i) {
        const double *a = forces[i], *b = reference[i];
        errors.push_back(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) /
                         std::hypot(b[0], b[1], b[2]));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

/// Sums over pairs against Ewald's for some particles, cells against sums over pairs for all.
TEST_P(Periodic, forces_are_those_of_all_images) {
    constexpr std::int64_t n = 1000;
    const std::array<double, 3> cube{1, 1, 1};
    const Boxed all[] = {{"uniform", uniform_scene(n), cube},
                         {"clusters", clusters_on_faces(n), cube},
                         {"clumps", clumps_on_faces(n), cube},
                         {"long box", in_long_box(n), {1, 2, 3}}};
    const Boxed& boxed = all[GetParam()];
    SCOPED_TRACE(boxed.name);
    const Domain box = periodic_box(boxed.box[0], boxed.box[1], boxed.box[2]);
    const auto targets = sample_targets(n, 20);
    const auto expected = ewald(boxed.scene, targets, boxed.box);
    const Forces pairs(solved(boxed.scene, in_box(1e-8, GravityMethod::direct, box)));
    // Potentials may be 0 in a box; sums of m/r are not.
    const Forces open(solved(boxed.scene, to_tolerance(1e-8, GravityMethod::direct)));
    for (std::size_t k = 0; k < targets.size(); ++k) {
        EXPECT_LE(distance(expected[k], pairs[targets[k]]), 1e-8 * length(expected[k]));
        const auto i = static_cast<std::size_t>(targets[k]);
        EXPECT_NEAR(pairs.p[i], static_cast<double>(expected[k].p), 1e-8 * open.p[i]);
    }
    for (const double tolerance : {1e-2, 1e-4, 1e-6})
        for (const GravityMethod method : {GravityMethod::walk, GravityMethod::fmm}) {
            SCOPED_TRACE(::testing::Message() << name_of(method) << ' ' << tolerance);
            const Gravity gravity = solved(boxed.scene, in_box(tolerance, method, box));
            EXPECT_TRUE(gravity.info().reached);
            EXPECT_LE(Deviations::p99(errors_against(pairs, Forces(gravity))), tolerance);
        }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Periodic, ::testing::Values(0, 1, 2, 3));

/// Moved by anything, many boxes away too, and with the box's corner elsewhere.
TEST(PeriodicShift, changes_nothing) {
    for (const char* const name : {"uniform", "corner_clumps"}) {
        const GravityScene scene = make_gravity_scene(name, 1000);
        const Forces unmoved(solved(scene, in_box(1e-8, GravityMethod::direct)));
        for (const double shift : {0.375, -0.001, 1025.5})
            for (const GravityMethod method : methods) {
                SCOPED_TRACE(::testing::Message() << name << ' ' << name_of(method) << shift);
                GravityScene moved = scene;
                moved.shift(shift, -2 * shift, 0.7 * shift);
                const double tolerance = method == GravityMethod::direct ? 1e-8 : 1e-4;
                auto options = in_box(tolerance, method);
                options.domain.lo = {-7.25, 0, 0.125};
                options.domain.hi = {-6.25, 1, 1.125};
                // Shifts round the positions by 1e-13 of the box.
                EXPECT_LE(Deviations::p99(errors_against(unmoved, Forces(solved(moved, options)))),
                          1.1 * tolerance);
            }
    }
}

/// One particle has no force: its images are all around it.
TEST(Periodic, one_particle_has_the_potential_of_its_images_and_no_force) {
    GravityScene scene;
    scene.add(0.3, 0.9, 0.5, 3);
    for (const GravityMethod method :
         {GravityMethod::automatic, GravityMethod::walk, GravityMethod::fmm}) {
        const Forces forces(solved(scene, in_box(1e-6, method)));
        EXPECT_NEAR(forces.p[0], 3 * -2.8372974794806195, 1e-5);
        for (int d = 0; d < 3; ++d) EXPECT_NEAR(forces.a[d], 0, 1e-9);
    }
}

}  // namespace
}  // namespace connectivity::test
