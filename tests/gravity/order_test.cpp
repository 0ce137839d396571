// SPDX-License-Identifier: BSD-3-Clause
// Errors fall with the order of expansions as the bound of what is neglected does.

#include <tuple>

#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

/// With (r_A + r_B) / R < theta what a pair of cells neglects first at order p is at most
/// (p + 1) theta^p of the field, see Acceptance.
constexpr double theta = 0.5;
constexpr double floor_of_rounding = 1e-14;

double bound_at(int order) { return (order + 1) * std::pow(theta, order); }

class Order
    : public ::testing::TestWithParam<std::tuple<const char*, GravityMethod, std::int64_t>> {};

/// Single orders may be lucky, terms of a degree being small; over all of them errors fall with the
/// bound.
TEST_P(Order, makes_errors_fall_with_the_bound_down_to_rounding) {
    const auto& [name, method, n] = GetParam();
    const GravityScene scene = make_gravity_scene(name, n);
    const auto targets = sample_targets(n, 500);
    const auto expected = brute_gravity(scene, targets);
    Gravity gravity;
    double first = 0, last = HUGE_VAL;
    for (int order = 2; order <= 14; order += 2) {
        solve(gravity, scene, by_hand(method, order, theta, Acceptance::geometric));
        ASSERT_GT(gravity.info().n_far, 0);
        const Deviations found(Forces(gravity), targets, expected);
        const double rms = Deviations::rms(found.field);
        EXPECT_LE(Deviations::max(found.field), bound_at(order)) << "order " << order;
        EXPECT_LE(rms, std::max(0.6 * last, floor_of_rounding)) << "order " << order;
        if (order == 2) first = rms;
        last = rms;
    }
    EXPECT_LE(last, first * bound_at(14) / bound_at(2));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Order,
                         ::testing::Combine(::testing::ValuesIn(all_gravity_scenes),
                                            ::testing::Values(GravityMethod::walk,
                                                              GravityMethod::fmm),
                                            ::testing::Values(6000)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param)) + "_" +
                                    name_of(std::get<1>(test.param));
                         });

/// The criterion's promise: no particle's error is above epsilon times sum m/r².
TEST(Field, epsilon_bounds_the_error_of_every_particle) {
    for (const char* const name : all_gravity_scenes) {
        const GravityScene scene = make_gravity_scene(name, 3000);
        const auto expected = brute_gravity(scene);
        for (const GravityMethod method : {GravityMethod::walk, GravityMethod::fmm})
            for (const int order : {1, 2, 4, 8, 20})
                for (const double epsilon : {1e-1, 1e-3, 1e-5}) {
                    SCOPED_TRACE(::testing::Message() << name << ' ' << name_of(method) << " order "
                                                      << order << " epsilon " << epsilon);
                    const Gravity gravity = solved(scene, by_hand(method, order, epsilon));
                    const Forces forces(gravity);
                    long double worst = 0;
                    for (std::int64_t i = 0; i < scene.n(); ++i)
                        worst = std::max(
                            worst, distance(expected[static_cast<std::size_t>(i)], forces[i]) /
                                       expected[static_cast<std::size_t>(i)].size_a);
                    EXPECT_LE(worst, epsilon);
                }
    }
}

/// The force is minus the gradient of the potential, whatever the order: massless probes around a
/// place measure the potential's differences. A star that two leaves share is an exception.
void expect_gradient(GravityScene scene, const GravityOptions& options) {
    constexpr double h = 1e-5;
    constexpr std::int64_t n_stars = 300;
    const auto at = sample_targets(scene.n(), n_stars);
    const std::int64_t first = scene.n();
    for (const std::int64_t i : at)
        for (int d = 0; d < 3; ++d)
            for (const double step : {-h, h}) {
                const auto k = static_cast<std::size_t>(i);
                scene.add(scene.x[k] + 0.003 + (d == 0 ? step : 0),
                          scene.y[k] + (d == 1 ? step : 0), scene.z[k] + (d == 2 ? step : 0), 0);
                if (!scene.e.empty()) scene.e.push_back(0);
            }
    const Forces forces(solved(scene, options));
    int n_wrong = 0;
    for (std::int64_t s = 0; s < n_stars; ++s) {
        double error = 0, size = 0;
        for (int d = 0; d < 3; ++d) {
            const auto low = static_cast<std::size_t>(first + 6 * s + 2 * d), high = low + 1;
            const double a = (forces.a[3 * low + d] + forces.a[3 * high + d]) / 2,
                         gradient = (forces.p[high] - forces.p[low]) / (2 * h);
            error = std::max(error, std::abs(a - gradient));
            size = std::max(size, std::abs(a));
        }
        n_wrong += !(error <= 1e-4 * size);
    }
    EXPECT_LE(n_wrong, n_stars / 50);
}

TEST(Force, is_minus_the_gradient_of_the_potential_at_any_order) {
    GravityScene plain = uniform_scene(3000), soft = plain;
    soft.e.assign(3000, 0.01);
    for (const GravityMethod method :
         {GravityMethod::direct, GravityMethod::walk, GravityMethod::fmm})
        for (const bool softened : {false, true})
            for (const bool periodic : {false, true}) {
                SCOPED_TRACE(::testing::Message()
                             << name_of(method) << (softened ? " softened" : "")
                             << (periodic ? " periodic" : ""));
                GravityOptions options = by_hand(method, 4, 0.6, Acceptance::geometric);
                options.tolerance = 1e-2;  // in a box it limits lengths of softening
                if (periodic) options.domain = periodic_box();
                expect_gradient(softened ? soft : plain, options);
            }
}

}  // namespace
}  // namespace connectivity::test
