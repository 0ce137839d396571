// SPDX-License-Identifier: BSD-3-Clause
// No particle's error is above its bound, and the bound is of some use.

#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

struct Tightness {
    double least = HUGE_VAL;  ///< of bound over error, over all particles
    std::vector<double> all;  ///< bounds over errors, ascending
};

Tightness expect_bounded(const GravityScene& scene, const Gravity& gravity,
                         const std::vector<BruteSum>& expected) {
    const Forces forces(gravity);
    const auto bounds = gravity.error_bound();
    EXPECT_EQ(bounds.size(), static_cast<std::size_t>(scene.n()));
    Tightness found;
    int n_above = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const long double error = distance(expected[i], forces[static_cast<std::int64_t>(i)]);
        n_above += !(error <= bounds(i) + 1e-12 * expected[i].size_a);
        if (error > 1e-12 * expected[i].size_a)
            found.all.push_back(static_cast<double>(bounds(i) / error));
    }
    EXPECT_EQ(n_above, 0);
    std::sort(found.all.begin(), found.all.end());
    return found;
}

class ErrorBound : public ::testing::TestWithParam<const char*> {};

TEST_P(ErrorBound, is_above_the_error_of_every_particle) {
    GravityScene scene = make_gravity_scene(GetParam(), 2500);
    for (const bool softened : {false, true}) {
        if (softened) scene.e.assign(2500, 1e-4);
        const auto expected = brute_gravity(scene, softened ? BruteLaw::plummer : BruteLaw::newton);
        for (const GravityMethod method : {GravityMethod::walk, GravityMethod::fmm})
            for (const int order : {1, 2, 4, 8})
                for (const Acceptance acceptance : {Acceptance::field, Acceptance::geometric}) {
                    SCOPED_TRACE(::testing::Message()
                                 << name_of(method) << " order " << order << " acceptance "
                                 << static_cast<int>(acceptance) << " softened " << softened);
                    auto options = by_hand(method, order, 0.6, acceptance);
                    options.error_bound = true;
                    const Gravity gravity = solved(scene, options);
                    const Tightness found = expect_bounded(scene, gravity, expected);
                    if (found.all.empty()) continue;
                    RecordProperty(std::string(name_of(method)) + std::to_string(order),
                                   std::to_string(found.all[found.all.size() / 2]));
                }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ErrorBound, ::testing::ValuesIn(all_gravity_scenes),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(ErrorBounds, of_direct_sums_are_0_and_there_are_none_unless_asked_for) {
    const GravityScene scene = plummer_scene(100);
    GravityOptions options = to_tolerance(1e-4, GravityMethod::direct);
    options.error_bound = true;
    Gravity gravity;
    solve(gravity, scene, options);
    ASSERT_EQ(gravity.error_bound().size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(gravity.error_bound()(i), 0);
    options.error_bound = false;
    solve(gravity, scene, options);
    EXPECT_EQ(gravity.error_bound().size(), 0u);
}

}  // namespace
}  // namespace connectivity::test
