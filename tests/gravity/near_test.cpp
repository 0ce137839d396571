// SPDX-License-Identifier: BSD-3-Clause
// Sums over near lists, everything being near, in double and in float, against the definition.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/gravity_brute.hpp>
#include <support/random.hpp>

#include "gravity/tree_sum.hpp"

namespace connectivity::test {
namespace {

using detail::FarForm;
using detail::PairLaw;

constexpr PairLaw all_laws[] = {PairLaw::newton, PairLaw::plummer, PairLaw::sph_exa};

struct Case {
    PairLaw law = PairLaw::newton;
    std::int32_t leaf = 6;
    FarForm form = FarForm::cell_to_cell;
    std::vector<Shift> images = {Shift{}};
};

/// Scales the scene to the frame's units, too.
detail::Frame frame_of(GravityScene& scene) {
    std::vector<double> positions;
    for (std::int64_t i = 0; i < scene.n(); ++i)
        positions.insert(positions.end(), {scene.x[i], scene.y[i], scene.z[i]});
    GravityParticles particles =
        GravityParticles::interleaved(positions.data(), scene.m.data(), scene.n());
    if (!scene.e.empty()) particles.softening = scene.e.data();
    detail::Frame frame;
    make_frame(particles, {}, frame);
    for (std::int64_t i = 0; i < frame.n; ++i) {
        scene.x[i] = frame.x(i);
        scene.y[i] = frame.x(frame.n + i);
        scene.z[i] = frame.x(2 * frame.n + i);
        scene.m[i] = frame.mass(i);
        if (!scene.e.empty()) scene.e[i] = frame.max_softening > 0 ? frame.softening(i) : 0;
    }
    return frame;
}

/// All sums, in the scene's order.
std::vector<double> near_sums(detail::TreeSum& tree, const Case& of, bool float32) {
    detail::TreeSettings settings;
    settings.form = of.form;
    settings.acceptance = Acceptance::geometric;
    settings.epsilon = 1e-300;
    settings.float32 = float32;
    if (of.law == PairLaw::sph_exa) settings.softening = Softening::sph_exa;
    const auto n = static_cast<std::size_t>(tree.bodies().n);
    std::vector<double> sorted(4 * n), sums(4 * n);
    double* const s = sorted.data();
    const detail::TreeWork work = tree.sum_all(settings, {s, s + n, s + 2 * n, s + 3 * n});
    EXPECT_EQ(work.far_pairs, 0);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t row = 0; row < 4; ++row)
            sums[row * n + tree.user_ids()[k]] = sorted[row * n + k];
    return sums;
}

void expect_definition(const Case& of, GravityScene scene, std::int64_t n_checked = 300) {
    start_runtime();
    if (of.law == PairLaw::newton) scene.e.clear();
    const detail::Frame frame = frame_of(scene);
    detail::Images images;
    images.n = static_cast<int>(of.images.size());
    images.shift.clear();
    for (const Shift& s : of.images) images.shift.insert(images.shift.end(), s.begin(), s.end());
    detail::TreeSum tree;
    tree.plant(frame, of.leaf, images);
    const auto targets = sample_targets(scene.n(), n_checked);
    const auto expected = brute_gravity(scene, targets, static_cast<BruteLaw>(of.law), of.images);
    for (const bool float32 : {false, true}) {
        const std::vector<double> sums = near_sums(tree, of, float32);
        const double allowed = float32 ? 3e-6 : 1e-13;
        const double* const p = sums.data();
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const BruteSum& sum = expected[k];
            const std::int64_t i = targets[k], n = scene.n();
            const double error_p = static_cast<double>(std::abs(sum.p - p[i]));
            const auto error = distance(sum, p[n + i], p[2 * n + i], p[3 * n + i]);
            ASSERT_LE(error_p, allowed * sum.size_p) << (float32 ? "float, " : "double, ") << i;
            ASSERT_LE(error, allowed * sum.size_a) << (float32 ? "float, " : "double, ") << i;
        }
    }
}

/// Lengths from nothing to a few distances of neighbours, in units of the widest extent.
GravityScene softened(GravityScene scene) {
    const auto [low, high] = std::minmax_element(scene.x.begin(), scene.x.end());
    const double size = *high - *low;
    scene.e.clear();
    for (std::int64_t i = 0; i < scene.n(); ++i)
        scene.e.push_back(i % 3 == 0 ? 0 : 0.1 * size * u01(9, i) * u01(10, i));
    return scene;
}

TEST(NearSum, is_the_definition_on_every_scene) {
    for (const char* const name : all_gravity_scenes)
        for (const PairLaw law : all_laws)
            for (const FarForm form : {FarForm::cell_to_cell, FarForm::cell_to_particles}) {
                SCOPED_TRACE(std::string(name) + ", law " + std::to_string(static_cast<int>(law)));
                const std::int32_t leaf = form == FarForm::cell_to_cell ? 6 : 12;
                expect_definition({law, leaf, form}, softened(make_gravity_scene(name, 3000)));
            }
}

TEST(NearSum, is_the_definition_for_any_leaf) {
    for (const std::int32_t leaf : {1, 2, 17, 64, 1000}) {
        SCOPED_TRACE(leaf);
        for (const char* const name : {"G1", "G6"})
            expect_definition({PairLaw::newton, leaf}, make_gravity_scene(name, 1000));
    }
}

TEST(NearSum, few_particles_are_right) {
    for (const std::int64_t n : {1, 2, 3, 9}) {
        SCOPED_TRACE(n);
        for (const PairLaw law : all_laws) expect_definition({law}, softened(plummer_scene(n)));
    }
}

TEST(NearSum, close_pairs_are_right_at_any_distance) {
    for (const double d : {1e-6, 1e-9, 1e-13, 1e-18, 1e-25, 1e-60, 1e-120}) {
        SCOPED_TRACE(d);
        GravityScene scene = uniform_scene(800);
        scene.add(0.4 * d, 0.3 * d, -0.2 * d, 1e-3);
        scene.add(0, 0.7 * d, 0.5 * d, 2e-3);
        for (const std::int32_t leaf : {4, 30})
            for (const PairLaw law : {PairLaw::newton, PairLaw::plummer}) {
                scene.e.assign(scene.x.size(), d / 4);
                expect_definition({law, leaf}, scene, scene.n());
            }
    }
}

TEST(NearSum, any_range_of_distances_is_right) {
    for (const double halvings : {30.0, 90.0, 200.0, 450.0}) {
        SCOPED_TRACE(halvings);
        expect_definition({PairLaw::newton, 8}, spiral_scene(500, halvings), 500);
    }
}

TEST(NearSum, masses_may_be_zero_or_negative) {
    for (const PairLaw law : all_laws) {
        GravityScene scene = softened(plummer_scene(1500));
        for (std::size_t i = 0; i < scene.m.size(); ++i)
            scene.m[i] *= i % 3 == 0 ? 0 : i % 3 == 1 ? -1 : 1;
        expect_definition({law}, scene);
        for (double& m : scene.m) m = 0;
        expect_definition({law}, scene);
    }
}

TEST(NearSum, one_particle_may_outweigh_all_others) {
    for (const double light : {1e-6, 1e-20, 1e-30}) {
        SCOPED_TRACE(light);
        GravityScene scene = uniform_scene(900);
        for (double& m : scene.m) m *= light;
        scene.m[7] = 1;
        expect_definition({}, scene, scene.n());
    }
}

TEST(NearSum, sources_act_in_every_image) {
    for (const PairLaw law : all_laws) {
        Case of{law};
        of.images = {Shift{}, {1, 0, 0}, {-1, 0.25, 0}, {0, -1.5, 2}};
        for (const char* const name : {"G2", "G6"})
            expect_definition(of, softened(make_gravity_scene(name, 800)));
    }
}

TEST(NearSum, long_softening_lengths_are_right) {
    for (const double e : {1.0, 1e6, 1e15}) {
        SCOPED_TRACE(e);
        GravityScene scene = uniform_scene(700);
        scene.e.assign(scene.x.size(), 0.0);
        for (std::size_t i = 0; i < scene.e.size(); i += 100) scene.e[i] = e;
        for (const PairLaw law : {PairLaw::plummer, PairLaw::sph_exa})
            expect_definition({law}, scene, scene.n());
    }
}

}  // namespace
}  // namespace connectivity::test
