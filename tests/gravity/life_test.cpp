// SPDX-License-Identifier: BSD-3-Clause
// One solution after the other: what is said of it is so, the same bits each time and with any
// number of threads, and views outlive what comes next.

#include <support/gravity_solve.hpp>
#include <support/hash.hpp>
#include <support/thread_bits.hpp>

namespace connectivity::test {
namespace {

constexpr GravityMethod all_methods[] = {GravityMethod::direct, GravityMethod::walk,
                                         GravityMethod::fmm};

std::uint64_t bits(const Gravity& gravity) {
    Fnv1a hash;
    hash.add_view(gravity.acceleration());
    hash.add_view(gravity.potential());
    hash.add_view(gravity.error_bound());
    return hash.value();
}

std::vector<GravityOptions> varied_options() {
    std::vector<GravityOptions> all;
    for (const GravityMethod method : all_methods)
        for (const double tolerance : {1e-3, 1e-6})
            for (const bool periodic : {false, true})
                for (const bool symmetric : {false, true}) {
                    if (symmetric && method == GravityMethod::walk) continue;
                    GravityOptions options = to_tolerance(tolerance, method);
                    options.symmetric = symmetric;
                    options.error_bound = true;
                    if (periodic) options.domain = periodic_box();
                    all.push_back(options);
                }
    GravityOptions weak = by_hand(GravityMethod::fmm, 4, 1e-3, Acceptance::acceleration);
    all.push_back(weak);
    return all;
}

TEST(GravityBits, are_the_same_in_a_new_solver_and_in_one_that_had_other_work) {
    GravityScene scene = corner_clumps_scene(3000);
    scene.e.assign(3000, 1e-4);
    Gravity used;
    Fnv1a hash;
    for (const GravityOptions& options : varied_options()) {
        solve(used, scene, options);
        const std::uint64_t first = bits(used);
        solve(used, scene, options);
        EXPECT_EQ(bits(used), first);
        EXPECT_EQ(bits(solved(scene, options)), first);
        hash.add(&first, sizeof(first));
    }
    print_fingerprint(hash.value());
}

TEST(GravityBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads(
        "GravityBits.are_the_same_in_a_new_solver_and_in_one_that_had_other_work");
}

/// With all particles in the sample, what info says are the errors.
TEST(GravityInfo, says_the_errors_that_there_are) {
    const auto near = [](double said, double is) {
        // The field's sums have far cells as points: a few per cent.
        EXPECT_GE(said, 0.8 * is - 1e-13);
        EXPECT_LE(said, 1.25 * is + 1e-13);
    };
    for (const char* const name : {"G1", "G5", "two_clusters"}) {
        const GravityScene scene = make_gravity_scene(name, 2000);
        const auto expected = brute_gravity(scene);
        for (const GravityMethod method : {GravityMethod::walk, GravityMethod::fmm}) {
            SCOPED_TRACE(::testing::Message() << name << ' ' << name_of(method));
            GravityOptions options = by_hand(method, 4, 1e-3);
            options.n_samples = 2000;
            const Gravity gravity = solved(scene, options);
            const GravityInfo& info = gravity.info();
            const Deviations found(Forces(gravity), sample_targets(2000, 2000), expected);
            EXPECT_EQ(info.n_samples, 2000);
            EXPECT_EQ(info.method, method);
            EXPECT_EQ(info.order, 4);
            EXPECT_EQ(info.epsilon, 1e-3);
            const std::pair<const GravityErrors&, const std::vector<double>&> pairs[] = {
                {info.acceleration, found.acceleration},
                {info.field, found.field},
                {info.potential, found.potential}};
            for (const auto& [said, errors] : pairs) {
                near(said.rms, Deviations::rms(errors));
                near(said.p99, Deviations::p99(errors));
                near(said.max, Deviations::max(errors));
            }
        }
    }
}

TEST(GravityLife, nothing_is_built_or_held_before_the_first_solution) {
    const Gravity gravity;
    EXPECT_EQ(gravity.n(), 0);
    EXPECT_EQ(gravity.scratch_bytes(), 0);
    EXPECT_EQ(gravity.report().total_bytes(), 0);
    EXPECT_TRUE(gravity.report().entries().empty());
    // Direct sums ask for no cells.
    const Gravity direct = solved(plummer_scene(100), to_tolerance(1e-3, GravityMethod::direct));
    for (const char* const unasked : {"tree", "cells", "moments", "lists", "far", "lattice"})
        EXPECT_EQ(direct.report().find(unasked), nullptr) << unasked;
    EXPECT_GT(direct.report().find("sums")->bytes, 0);
}

TEST(GravityViews, stay_unchanged_by_later_solutions) {
    Gravity gravity;
    for (const GravityMethod method : all_methods) {
        solve(gravity, plummer_scene(1000), to_tolerance(1e-3, method));
        const auto a = gravity.acceleration();
        const auto p = gravity.potential();
        const Forces before(gravity);
        solve(gravity, uniform_scene(1000), to_tolerance(1e-3, method));
        EXPECT_EQ(std::vector<double>(a.data(), a.data() + a.size()), before.a);
        EXPECT_EQ(-p(17), before.p[17]);
        EXPECT_NE(gravity.acceleration().data(), a.data());
    }
    const auto a = gravity.acceleration();
    const std::vector<double> before(a.data(), a.data() + a.size());
    gravity = Gravity();
    EXPECT_EQ(std::vector<double>(a.data(), a.data() + a.size()), before);
    EXPECT_EQ(gravity.n(), 0);
}

TEST(GravityScratch, is_none_before_the_first_solution_and_given_back_on_request) {
    Gravity gravity;
    EXPECT_EQ(gravity.scratch_bytes(), 0);
    EXPECT_EQ(gravity.acceleration().size(), 0u);
    solve(gravity, plummer_scene(5000), to_tolerance(1e-3, GravityMethod::fmm));
    EXPECT_GT(gravity.scratch_bytes(), 5000 * 8 * 8);
    const Forces before(gravity);
    gravity.release_scratch();
    EXPECT_EQ(gravity.scratch_bytes(), 0);
    EXPECT_EQ(Forces(gravity).a, before.a);
    solve(gravity, plummer_scene(5000), to_tolerance(1e-3, GravityMethod::fmm));
    EXPECT_EQ(Forces(gravity).a, before.a);
}

/// Any layout of the same numbers, one and two dimensions, and a constant.
TEST(GravityInput, may_lie_anyhow) {
    const GravityScene scene = plummer_scene(1000);
    const Forces expected(solved(scene, to_tolerance(1e-3, GravityMethod::fmm)));
    std::vector<double> separate;
    for (const auto* const axis : {&scene.x, &scene.y, &scene.z})
        separate.insert(separate.end(), axis->begin(), axis->end());
    Gravity gravity;
    gravity.solve(GravityParticles::separate(separate.data(), scene.m.data(), 1000),
                  to_tolerance(1e-3, GravityMethod::fmm));
    EXPECT_EQ(Forces(gravity).a, expected.a);
    for (const int dim : {1, 2}) {
        GravityScene flat = scene;
        flat.z.assign(1000, 0);
        if (dim == 1) flat.y.assign(1000, 0);
        const auto targets = sample_targets(1000, 1000);
        GravityOptions options = to_tolerance(1e-4, GravityMethod::fmm);
        options.constant = 0.25;
        gravity.solve(GravityParticles::separate(separate.data(), scene.m.data(), 1000, dim),
                      options);
        Forces forces(gravity);
        for (double& a : forces.a) a *= 4;
        EXPECT_LE(
            Deviations::p99(Deviations(forces, targets, brute_gravity(flat, targets)).acceleration),
            1e-4);
    }
}

}  // namespace
}  // namespace connectivity::test
