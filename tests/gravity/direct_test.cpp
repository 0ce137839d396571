// SPDX-License-Identifier: BSD-3-Clause
// The direct sum in parallel against the definition, and the definition against what is known.
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/gravity_brute.hpp>
#include <support/hash.hpp>
#include <support/random.hpp>
#include <support/thread_bits.hpp>

#include "gravity/direct.hpp"

namespace connectivity::test {
namespace {

using detail::DirectTargets;
using detail::PairLaw;

constexpr PairLaw all_laws[] = {PairLaw::newton, PairLaw::plummer, PairLaw::sph_exa};

struct Result {
    std::vector<double> p, ax, ay, az;
    explicit Result(Offset n) : p(static_cast<std::size_t>(n)), ax(p), ay(p), az(p) {}
};

Result direct(PairLaw law, const GravityScene& scene, const DirectTargets& targets) {
    start_runtime();
    Result result(targets.n);
    std::vector<double> scratch;
    detail::direct_sum(
        law,
        {scene.x.data(), scene.y.data(), scene.z.data(), scene.m.data(),
         scene.e.empty() ? nullptr : scene.e.data(), scene.n()},
        targets, {result.p.data(), result.ax.data(), result.ay.data(), result.az.data()}, scratch);
    return result;
}

/// `images` as in brute_gravity.
void expect_definition(PairLaw law, const GravityScene& scene, const std::vector<Slot>& which,
                       const DirectTargets& targets, std::vector<Shift> images = {}) {
    const std::vector<std::int64_t> wide(which.begin(), which.end());
    const auto expected = brute_gravity(scene, wide, static_cast<BruteLaw>(law), images);
    const Result result = direct(law, scene, targets);
    ASSERT_EQ(which.size(), result.p.size());
    for (std::size_t k = 0; k < which.size(); ++k) {
        const BruteSum& sum = expected[k];
        ASSERT_LE(std::abs(sum.p - result.p[k]), 1e-14 * sum.size_p) << "target " << which[k];
        ASSERT_LE(distance(sum, result.ax[k], result.ay[k], result.az[k]), 1e-14 * sum.size_a)
            << "target " << which[k];
    }
}

std::vector<Slot> numbers(std::int64_t first, std::int64_t n) {
    std::vector<Slot> which(static_cast<std::size_t>(n));
    std::iota(which.begin(), which.end(), static_cast<Slot>(first));
    return which;
}

GravityScene softened(GravityScene scene) {
    scene.e.clear();
    for (std::int64_t i = 0; i < scene.n(); ++i)
        scene.e.push_back(i % 3 == 0 ? 0 : 0.3 * u01(9, i) * u01(10, i));
    return scene;
}

TEST(Direct, all_particles_have_the_sums_of_the_definition) {
    for (const PairLaw law : all_laws)
        for (const int n : {0, 1, 2, 3, 33, 129, 1500}) {
            SCOPED_TRACE(n);
            expect_definition(law, softened(plummer_scene(n)), numbers(0, n), {.n = n});
        }
}

TEST(Direct, a_few_targets_among_many_sources_have_the_sums_of_the_definition) {
    const GravityScene scene = softened(evrard_scene(30011));
    for (const PairLaw law : all_laws)
        for (const int n : {1, 2, 31, 70}) {
            std::vector<Slot> which;
            for (int k = 0; k < n; ++k) which.push_back((12345 + 997 * k) % 30011);
            expect_definition(law, scene, which, {.which = which.data(), .n = n});
            expect_definition(law, scene, numbers(29900, n), {.first = 29900, .n = n});
        }
}

TEST(Direct, targets_that_are_many_do_not_split_the_sources) {
    const GravityScene scene = cold_cube_scene(9000);
    const Result all = direct(PairLaw::newton, scene, {.n = 9000});
    const auto sample = sample_targets(9000, 20);
    const auto expected = brute_gravity(scene, sample);
    for (std::size_t k = 0; k < sample.size(); ++k) {
        const auto i = static_cast<std::size_t>(sample[k]);
        EXPECT_LE(std::abs(expected[k].p - all.p[i]), 1e-14 * expected[k].size_p);
        EXPECT_LE(distance(expected[k], all.ax[i], all.ay[i], all.az[i]),
                  1e-14 * expected[k].size_a);
    }
}

TEST(Direct, coincident_particles_have_the_potential_of_their_softening_and_no_force) {
    for (const PairLaw law : all_laws) {
        const GravityScene scene = softened(coincident_scene(1280));
        expect_definition(law, scene, numbers(0, 1280), {.n = 1280});
    }
    GravityScene together;  // nothing but one place, 0 of either sign
    for (int i = 0; i < 300; ++i) together.add(i % 2 == 0 ? 0.0 : -0.0, 0, 0.5, 1 + i);
    together = softened(together);
    expect_definition(PairLaw::plummer, together, numbers(0, 300), {.n = 300});
    const Result sums = direct(PairLaw::plummer, together, {.n = 300});
    for (const double a : sums.ax) EXPECT_EQ(a, 0);
    EXPECT_GT(sums.p[1], 0);
}

TEST(Direct, an_image_is_the_sources_moved_the_other_way) {
    const GravityScene scene = softened(uniform_scene(500));
    const Shift image{1, -2, 0.5};
    for (const PairLaw law : all_laws)
        expect_definition(law, scene, numbers(3, 400),
                          {.first = 3, .n = 400, .shift = {-1, 2, -0.5}}, {image});
    // A particle meets its own image, and another's where there is one.
    GravityScene pair;
    pair.add(0.25, 0.5, 0.5, 1);
    pair.add(1.25, 0.5, 0.5, 3);
    pair.e = {0.125, 0.25};
    expect_definition(PairLaw::plummer, pair, numbers(0, 2), {.n = 2, .shift = {1, 0, 0}},
                      {Shift{-1, 0, 0}});
}

TEST(Direct, sums_are_added_to_what_is_there) {
    const GravityScene scene = uniform_scene(50);
    const Result once = direct(PairLaw::newton, scene, {.n = 50});
    Result twice = once;
    std::vector<double> scratch;
    detail::direct_sum(
        PairLaw::newton,
        {scene.x.data(), scene.y.data(), scene.z.data(), scene.m.data(), nullptr, 50}, {.n = 50},
        {twice.p.data(), twice.ax.data(), twice.ay.data(), twice.az.data()}, scratch);
    for (int k = 0; k < 50; ++k) {
        EXPECT_EQ(twice.p[k], 2 * once.p[k]);
        EXPECT_EQ(twice.az[k], 2 * once.az[k]);
    }
}

TEST(DirectBits, print) {
    Fnv1a hash;
    const GravityScene scene = softened(coincident_scene(20000));
    for (const PairLaw law : all_laws)
        for (const Offset n : {1, 100, 9000}) {
            const Result sums = direct(law, scene, {.first = 20000 - n, .n = n});
            for (const auto* const part : {&sums.p, &sums.ax, &sums.ay, &sums.az})
                hash.add_view(*part);
        }
    print_fingerprint(hash.value());
}

TEST(DirectBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads("DirectBits.print");
}

TEST(BruteGravity, two_bodies_attract_each_other_as_known) {
    GravityScene scene;
    scene.add(0, 0, 0, 2);
    scene.add(3, 4, 0, 8);
    scene.e = {5, 12};
    const auto newton = brute_gravity(scene);
    EXPECT_EQ(newton[0].p, 8 / 5.0L);
    EXPECT_NEAR(static_cast<double>(newton[0].a[0]), 8 * 3 / 125.0, 1e-17);
    EXPECT_NEAR(static_cast<double>(newton[1].a[1]), -2 * 4 / 125.0, 1e-17);
    const auto plummer = brute_gravity(scene, BruteLaw::plummer);
    EXPECT_EQ(plummer[1].p, 2 / 13.0L);
    EXPECT_NEAR(static_cast<double>(plummer[0].a[1]), 8 * 4 / 2197.0, 1e-17);
    const auto sph_exa = brute_gravity(scene, BruteLaw::sph_exa);
    EXPECT_NEAR(static_cast<double>(sph_exa[0].p), 8 * 25 / 4913.0, 1e-16);
    EXPECT_NEAR(static_cast<double>(sph_exa[0].a[0]), 8 * 3 / 4913.0, 1e-17);
    const Shift image[] = {{-3, -4, 1}};
    EXPECT_EQ(brute_gravity(scene, BruteLaw::newton, image)[0].a[2],
              8 + 2 / (26 * std::sqrt(26.0L)));
}

TEST(GravityScenes, have_the_wanted_number_of_particles_and_mass_one) {
    for (const char* const name : all_gravity_scenes)
        for (const std::int64_t n : {0, 1, 2, 63, 1000}) {
            const GravityScene scene = make_gravity_scene(name, n);
            ASSERT_EQ(scene.n(), n) << name;
            double mass = 0;
            for (std::int64_t i = 0; i < n; ++i) {
                mass += scene.m[i];
                ASSERT_TRUE(std::isfinite(scene.x[i] + scene.y[i] + scene.z[i])) << name;
            }
            EXPECT_NEAR(mass, n > 2 ? 1 : mass, 1e-12) << name << ' ' << n;
        }
}

}  // namespace
}  // namespace connectivity::test
