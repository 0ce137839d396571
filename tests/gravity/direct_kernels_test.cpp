// SPDX-License-Identifier: BSD-3-Clause
// Sums over pairs, of every instruction set that this machine has, against the definition.
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <support/gravity_brute.hpp>
#include <support/random.hpp>

#include "gravity/direct_kernels.hpp"

namespace connectivity::test {
namespace {

using detail::DirectKernels;
using detail::PairLaw;

constexpr PairLaw all_laws[] = {PairLaw::newton, PairLaw::plummer, PairLaw::sph_exa};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class T>
constexpr double tolerance = std::is_same_v<T, double> ? 3e-14 : 3e-6;

BruteLaw brute_law(PairLaw law) { return static_cast<BruteLaw>(law); }

std::vector<const DirectKernels*> machine_kernels() {
    std::vector<const DirectKernels*> all{&detail::portable_direct_kernels};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        all.push_back(&detail::avx2_direct_kernels);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        all.push_back(&detail::avx512_direct_kernels);
#endif
    return all;
}

/// As the kernels' type holds them.
template <class T>
GravityScene rounded(GravityScene scene) {
    for (auto* const values : {&scene.x, &scene.y, &scene.z, &scene.m, &scene.e})
        for (double& v : *values) v = static_cast<T>(v);
    return scene;
}

/// Between values that would show if they were used.
template <class T>
std::vector<T> guarded(const std::vector<double>& values, double guard = nan) {
    std::vector<T> all(values.size() + 2, static_cast<T>(guard));
    for (std::size_t k = 0; k < values.size(); ++k) all[k + 1] = static_cast<T>(values[k]);
    return all;
}

struct Result {
    std::vector<double> p, ax, ay, az;
};

/// What the kernel says about targets [first, first + n) of the scene.
template <class T>
Result sums_of(const DirectKernels& kernels, PairLaw law, const GravityScene& scene,
               std::int64_t first, std::int64_t n) {
    constexpr double sentinel = 12345;
    const auto x = guarded<T>(scene.x), y = guarded<T>(scene.y), z = guarded<T>(scene.z),
               m = guarded<T>(scene.m), e = guarded<T>(scene.e);
    const std::vector<double> zeros(static_cast<std::size_t>(n), 0.0);
    std::vector<T> sums[4];
    for (auto& sum : sums) sum = guarded<T>(zeros, sentinel);
    const T* const soft = scene.e.empty() ? nullptr : e.data() + 1;
    const detail::NearSources<T> sources{x.data() + 1, y.data() + 1, z.data() + 1,
                                         m.data() + 1, soft,         scene.n()};
    const detail::NearTargets<T> targets{sources.x + first,
                                         sources.y + first,
                                         sources.z + first,
                                         soft ? soft + first : nullptr,
                                         sums[0].data() + 1,
                                         sums[1].data() + 1,
                                         sums[2].data() + 1,
                                         sums[3].data() + 1,
                                         n};
    if constexpr (std::is_same_v<T, double>)
        kernels.add64(law, sources, targets);
    else
        kernels.add32(law, sources, targets);
    Result result;
    std::vector<double>* const out[] = {&result.p, &result.ax, &result.ay, &result.az};
    for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(sums[k].front(), static_cast<T>(sentinel));
        EXPECT_EQ(sums[k].back(), static_cast<T>(sentinel));
        out[k]->assign(sums[k].begin() + 1, sums[k].end() - 1);
    }
    return result;
}

/// The kernels leave pairs at one place to their caller.
void take_coincident_out(const GravityScene& scene, std::int64_t i, BruteSum& sum) {
    for (std::int64_t j = 0; j < scene.n(); ++j) {
        if (j == i || scene.x[j] != scene.x[i] || scene.y[j] != scene.y[i] ||
            scene.z[j] != scene.z[i])
            continue;
        const long double e = std::max(scene.e[i], scene.e[j]);
        if (e == 0) continue;
        sum.p -= scene.m[j] / e;
        sum.size_p -= std::abs(scene.m[j]) / e;
    }
}

template <class T>
void expect_definition(PairLaw law, const GravityScene& exact, std::int64_t first, std::int64_t n,
                       double allowed = tolerance<T>) {
    const GravityScene scene = rounded<T>(exact);
    std::vector<std::int64_t> targets;
    for (std::int64_t k = 0; k < n; ++k) targets.push_back(first + k);
    auto expected = brute_gravity(scene, targets, brute_law(law));
    if (law == PairLaw::plummer)
        for (std::int64_t k = 0; k < n; ++k) take_coincident_out(scene, first + k, expected[k]);
    for (const DirectKernels* const kernels : machine_kernels()) {
        const Result result = sums_of<T>(*kernels, law, scene, first, n);
        for (std::int64_t k = 0; k < n; ++k) {
            const BruteSum& sum = expected[k];
            const long double error = distance(sum, result.ax[k], result.ay[k], result.az[k]);
            ASSERT_LE(std::abs(sum.p - result.p[k]), allowed * sum.size_p) << kernels->name << k;
            ASSERT_LE(error, allowed * sum.size_a) << kernels->name << ", target " << k;
        }
    }
}

void expect_definition_of_both(PairLaw law, const GravityScene& scene) {
    expect_definition<double>(law, scene, 0, scene.n());
    expect_definition<float>(law, scene, 0, scene.n());
}

/// Lengths from nothing to much more than a distance.
GravityScene softened(GravityScene scene) {
    scene.e.clear();
    for (std::int64_t i = 0; i < scene.n(); ++i)
        scene.e.push_back(i % 3 == 0 ? 0 : 0.3 * u01(9, i) * u01(10, i));
    return scene;
}

TEST(DirectKernels, sums_are_those_of_the_definition_for_any_number) {
    for (const PairLaw law : all_laws)
        for (const int n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100, 257, 1100}) {
            SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law) << ", n " << n);
            expect_definition_of_both(law, softened(uniform_scene(n)));
        }
}

TEST(DirectKernels, sums_are_those_of_the_definition_for_any_number_of_targets) {
    for (const PairLaw law : all_laws)
        for (const int n : {5, 40, 703})  // of 703 one more would fill the vectors
            for (int first = 0; first < 3; ++first)
                for (int n_targets = 0; n_targets <= std::min(n - first, 67); ++n_targets) {
                    const GravityScene scene = softened(uniform_scene(n));
                    expect_definition<double>(law, scene, first, n_targets);
                    expect_definition<float>(law, scene, first, n_targets);
                }
}

TEST(DirectKernels, sums_are_those_of_the_definition_on_every_scene) {
    for (const char* const name : all_gravity_scenes) {
        SCOPED_TRACE(name);
        const GravityScene scene = softened(make_gravity_scene(name, 500));
        for (const PairLaw law : all_laws) expect_definition<double>(law, scene, 0, scene.n());
    }
}

TEST(DirectKernels, newton_needs_no_softening_lengths) {
    const GravityScene scene = plummer_scene(301);
    ASSERT_TRUE(scene.e.empty());
    expect_definition_of_both(PairLaw::newton, scene);
}

TEST(DirectKernels, pairs_in_one_place_do_nothing) {
    for (const PairLaw law : all_laws)
        for (const int n : {2, 9, 40}) {
            GravityScene scene;
            for (int i = 0; i < n; ++i) scene.add(0.1, i == n / 2 ? -0.0 : 0.0, -0.3, 1);
            scene = softened(scene);
            for (const DirectKernels* const kernels : machine_kernels()) {
                const Result d = sums_of<double>(*kernels, law, scene, 0, n),
                             f = sums_of<float>(*kernels, law, scene, 0, n);
                for (const auto* const sums :
                     {&d.p, &d.ax, &d.ay, &d.az, &f.p, &f.ax, &f.ay, &f.az})
                    for (const double sum : *sums) EXPECT_EQ(sum, 0) << kernels->name;
            }
        }
}

TEST(DirectKernels, coincident_groups_among_others_are_right) {
    for (const PairLaw law : all_laws)
        expect_definition_of_both(law, softened(coincident_scene(640)));
}

/// Others near and far, and two at the given distance where coordinates are that fine.
GravityScene close_pair(double distance, int n_others) {
    GravityScene scene = uniform_scene(n_others);
    scene.shift(0.01, 0.01, 0.01);
    scene.add(0.4 * distance, 0.3 * distance, -0.2 * distance, 0.25);
    scene.add(0, 0.7 * distance, 0.5 * distance, 0.125);
    return scene;
}

TEST(DirectKernels, close_pairs_are_right) {
    for (const int n_others : {0, 1, 6, 61, 1000}) {
        for (const double d : {1e-3, 1e-9, 1e-18, 1e-25, 1e-80, 1e-110, 1e-145}) {
            SCOPED_TRACE(testing::Message() << d << " apart, others: " << n_others);
            const GravityScene scene = close_pair(d, n_others);
            expect_definition<double>(PairLaw::newton, scene, 0, scene.n());
            // Lengths that matter, and lengths that do not.
            GravityScene soft = scene;
            soft.e.assign(soft.x.size(), d / 4);
            for (const PairLaw law : all_laws) expect_definition<double>(law, soft, 0, soft.n());
        }
        for (const double d : {1e-3, 1e-9, 1e-13, 1e-17})
            expect_definition<float>(PairLaw::newton, close_pair(d, n_others), 0, n_others + 2);
    }
}

TEST(DirectKernels, masses_may_be_zero_or_negative) {
    for (const PairLaw law : all_laws) {
        GravityScene scene = softened(plummer_scene(333));
        for (std::size_t i = 0; i < scene.m.size(); ++i)
            scene.m[i] *= i % 3 == 0 ? 0 : i % 3 == 1 ? -1 : 1;
        expect_definition_of_both(law, scene);
        for (double& m : scene.m) m = 0;
        expect_definition_of_both(law, scene);
    }
    GravityScene close = close_pair(1e-120, 30);  // nothing times infinity
    for (double& m : close.m) m = 0;
    expect_definition<double>(PairLaw::newton, close, 0, close.n());
}

/// a and p of target i by source j alone. One by one: all sources, all masses but one 0.
template <class T>
std::vector<Result> pair_by_pair(const DirectKernels& kernels, PairLaw law,
                                 const GravityScene& scene, bool one_by_one) {
    std::vector<Result> rows;
    for (std::int64_t j = 0; j < scene.n(); ++j) {
        GravityScene alone = scene;
        for (std::int64_t k = 0; k < scene.n(); ++k) alone.m[k] = k == j ? 1 : 0;
        if (!one_by_one) {
            rows.push_back(sums_of<T>(kernels, law, alone, 0, scene.n()));
            continue;
        }
        Result row;
        for (std::int64_t i = 0; i < scene.n(); ++i) {
            const Result one = sums_of<T>(kernels, law, alone, i, 1);
            row.p.push_back(one.p[0]), row.ax.push_back(one.ax[0]);
            row.ay.push_back(one.ay[0]), row.az.push_back(one.az[0]);
        }
        rows.push_back(row);
    }
    return rows;
}

template <class T>
void expect_antisymmetry(const DirectKernels& kernels, PairLaw law) {
    const GravityScene scene = rounded<T>(softened(plummer_scene(70).scale(0.01)));
    const auto many = pair_by_pair<T>(kernels, law, scene, false),
               single = pair_by_pair<T>(kernels, law, scene, true);
    for (std::int64_t i = 0; i < scene.n(); ++i)
        for (std::int64_t j = 0; j < scene.n(); ++j) {
            ASSERT_EQ(many[i].p[j], many[j].p[i]) << i << ' ' << j;
            ASSERT_EQ(many[i].ax[j], -many[j].ax[i]) << i << ' ' << j;
            ASSERT_EQ(many[i].ay[j], -many[j].ay[i]) << i << ' ' << j;
            ASSERT_EQ(many[i].az[j], -many[j].az[i]) << i << ' ' << j;
            ASSERT_EQ(many[i].p[j], single[i].p[j]) << i << ' ' << j;
            ASSERT_EQ(many[i].ax[j], single[i].ax[j]) << i << ' ' << j;
        }
}

TEST(DirectKernels, action_and_reaction_have_the_same_bits) {
    for (const DirectKernels* const kernels : machine_kernels())
        for (const PairLaw law : all_laws) {
            SCOPED_TRACE(testing::Message() << kernels->name << " law " << static_cast<int>(law));
            expect_antisymmetry<double>(*kernels, law);
            expect_antisymmetry<float>(*kernels, law);
        }
}

TEST(DirectKernels, momentum_is_kept_to_round_off) {
    for (const char* const name : {"G1", "G3", "G4", "G6"}) {
        const GravityScene scene = make_gravity_scene(name, 2000);
        for (const DirectKernels* const kernels : machine_kernels()) {
            const Result sums = sums_of<double>(*kernels, PairLaw::newton, scene, 0, scene.n());
            long double drift[3] = {}, size = 0;
            for (std::int64_t i = 0; i < scene.n(); ++i) {
                const long double m = scene.m[i];
                drift[0] += m * sums.ax[i], drift[1] += m * sums.ay[i], drift[2] += m * sums.az[i];
                size += m * std::hypot(sums.ax[i], sums.ay[i], sums.az[i]);
            }
            EXPECT_LE(std::hypot(drift[0], drift[1], drift[2]), 1e-15 * size)
                << name << ' ' << kernels->name;
        }
    }
}

TEST(DirectKernels, errors_do_not_grow_with_the_number_of_sources) {
    GravityScene scene = uniform_scene(1'000'000);
    expect_definition<double>(PairLaw::newton, scene, 17, 3);
    expect_definition<float>(PairLaw::newton, scene, 17, 3);
    for (std::int64_t i = 20; i < scene.n(); ++i)  // equal terms, whose rounding adds up
        scene.x[i] = 0.3, scene.y[i] = 0.4, scene.z[i] = 0.7;
    expect_definition<double>(PairLaw::newton, scene, 17, 3, 3e-14);
    expect_definition<float>(PairLaw::newton, scene, 17, 3, 1.5e-5);
}

TEST(DirectKernels, sums_are_added_to_what_is_there) {
    const double x[3] = {0, 1, 2}, zero[3] = {}, m[3] = {0, 0, 4};
    for (const DirectKernels* const kernels : machine_kernels()) {
        double p[1] = {10}, a[3][1] = {{20}, {30}, {40}};
        kernels->add64(PairLaw::newton, {x, zero, zero, m, nullptr, 3},
                       {x, zero, zero, nullptr, p, a[0], a[1], a[2], 1});
        EXPECT_EQ(p[0], 12) << kernels->name;
        EXPECT_EQ(a[0][0], 21) << kernels->name;
        EXPECT_EQ(a[1][0], 30) << kernels->name;
        EXPECT_EQ(a[2][0], 40) << kernels->name;
    }
}

template <class T>
void expect_copies(const DirectKernels& kernels, bool softened) {
    const std::vector<double> x{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    const double shift[6] = {0, 0, 0, 100, 200, 300};
    const std::vector<detail::SourceRun> runs{
        {2, 1, 0}, {5, 9, 1}, {0, 19, 0}, {18, 1, 1}, {3, 6, 0}};
    const std::int64_t n = 36, stride = n + detail::gather_slack;
    const detail::GatherFrom from{{x.data(), x.data(), x.data()},
                                  x.data(),
                                  softened ? x.data() : nullptr,
                                  shift,
                                  {1, -1, 0},
                                  4};
    std::vector<T> to(static_cast<std::size_t>(5 * stride), T{-7});
    if constexpr (std::is_same_v<T, double>)
        kernels.gather64(from, runs.data(), std::ssize(runs), to.data(), stride);
    else
        kernels.gather32(from, runs.data(), std::ssize(runs), to.data(), stride);
    std::int64_t k = 0;
    for (const detail::SourceRun& run : runs)
        for (std::int32_t i = run.first; i < run.first + run.n; ++i, ++k) {
            for (int d = 0; d < 3; ++d)
                EXPECT_EQ(to[d * stride + k],
                          (x[i] + shift[3 * run.image + d] - from.centre[d]) * 4);
            EXPECT_EQ(to[3 * stride + k], x[i]) << kernels.name << ' ' << k;
            EXPECT_EQ(to[4 * stride + k], softened ? x[i] * 4 : -7) << kernels.name << ' ' << k;
        }
    EXPECT_EQ(k, n);
}

TEST(DirectKernels, gathered_runs_are_copies_one_after_the_other) {
    for (const DirectKernels* const kernels : machine_kernels())
        for (const bool softened : {false, true}) {
            expect_copies<double>(*kernels, softened);
            expect_copies<float>(*kernels, softened);
        }
}

}  // namespace
}  // namespace connectivity::test
