// SPDX-License-Identifier: BSD-3-Clause
// What is out of range names itself and what is allowed, and the solution before stays.

#include <functional>
#include <limits>

#include <support/expect_error.hpp>
#include <support/gravity_solve.hpp>

namespace connectivity::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const double nan = std::nan("");

struct BadOption {
    std::function<void(GravityOptions&)> change;
    std::vector<std::string> words;
    Status status = Status::argument;
};

const std::vector<BadOption> bad_options{
    {[](auto& o) { o.method = static_cast<GravityMethod>(9); }, {"method", "9"}},
    {[](auto& o) { o.method = static_cast<GravityMethod>(-1); }, {"method", "-1"}},
    {[](auto& o) { o.acceptance = static_cast<Acceptance>(3); }, {"acceptance", "3"}},
    {[](auto& o) { o.near = static_cast<NearPrecision>(5); }, {"near", "5"}},
    {[](auto& o) { o.softening = static_cast<Softening>(2); }, {"softening", "2"}},
    {[](auto& o) { o.tolerance = 0; }, {"tolerance", "0", "9.99", "0.5]"}},
    {[](auto& o) { o.tolerance = 1e-13; }, {"tolerance", "1e-13"}},
    {[](auto& o) { o.tolerance = 0.75; }, {"tolerance", "0.75"}},
    {[](auto& o) { o.tolerance = -1; }, {"tolerance", "-1"}},
    {[](auto& o) { o.tolerance = nan; }, {"tolerance", "nan"}},
    {[](auto& o) { o.order = 0; }, {"order", "0", "[1, 20]"}},
    {[](auto& o) { o.order = 21; }, {"order", "21", "[1, 20]"}},
    {[](auto& o) { o.order = 8, o.epsilon = 0; }, {"epsilon", "0"}},
    {[](auto& o) { o.order = 8, o.epsilon = nan; }, {"epsilon", "nan"}},
    {[](auto& o) { o.order = 8, o.epsilon = infinite; }, {"epsilon", "inf"}},
    {[](auto& o) { o.order = 8, o.epsilon = 1, o.acceptance = Acceptance::geometric; },
     {"epsilon", "1", "0.949"}},
    {[](auto& o) { o.epsilon = 0.1; }, {"epsilon", "order"}},
    {[](auto& o) { o.leaf = 0; }, {"leaf", "0"}},
    {[](auto& o) { o.leaf = -5; }, {"leaf", "-5"}},
    {[](auto& o) { o.constant = 0; }, {"constant", "0"}},
    {[](auto& o) { o.constant = -1; }, {"constant", "-1"}},
    {[](auto& o) { o.constant = infinite; }, {"constant", "inf"}},
    {[](auto& o) { o.n_samples = -1; }, {"n_samples", "-1"}},
    {[](auto& o) { o.n_samples = 100001; }, {"n_samples", "100001"}},
    {[](auto& o) { o.symmetric = true, o.method = GravityMethod::walk; }, {"symmetric"}},
    {[](auto& o) { o.symmetric = true, o.near = NearPrecision::float32; }, {"symmetric"}},
    {[](auto& o) { o.previous_acceleration = allocate_zeroed<double>("a", 3); },
     {"previous_acceleration", "3", "50"}},
    {[](auto& o) {
         auto a = allocate_zeroed<double>("a", 50);
         a(7) = -1;
         o.previous_acceleration = a;
     },
     {"previous_acceleration[7]", "-1"}},
    {[](auto& o) {
         auto a = allocate_zeroed<double>("a", 50);
         a(49) = nan;
         o.previous_acceleration = a;
     },
     {"previous_acceleration[49]", "nan"},
     Status::nonfinite},
    {[](auto& o) {
         o.domain = periodic_box();
         o.domain.periodic[1] = false;
     },
     {"periodic"},
     Status::unsupported},
    {[](auto& o) { o.domain = periodic_box(1, 0, 1); }, {}, Status::box},
    {[](auto& o) { o.domain = periodic_box(1, -1, 1); }, {}, Status::box},
    {[](auto& o) { o.domain = periodic_box(1, 1, nan); }, {}, Status::box},
};

struct BadParticles {
    std::function<void(GravityParticles&, std::vector<double>&)> change;  ///< [n][3], m, e
    Status status;
    std::vector<std::string> words;
};

constexpr std::size_t masses = 150, lengths = 200;  // where they begin in the array

const std::vector<BadParticles> bad_particles{
    {[](auto& p, auto&) { p.dim = 0; }, Status::argument, {"dim", "0"}},
    {[](auto& p, auto&) { p.dim = 4; }, Status::argument, {"dim", "4"}},
    {[](auto& p, auto&) { p.n = -1; }, Status::argument, {"-1"}},
    {[](auto& p, auto&) { p.n = Offset{1} << 31; }, Status::too_many, {"2147483648"}},
    {[](auto& p, auto&) { p.positions = nullptr; }, Status::null, {"particle"}},
    {[](auto& p, auto&) { p.masses = nullptr; }, Status::null, {"mass"}},
    {[](auto& p, auto&) { p.particle_stride = 0; }, Status::argument, {"stride", "0"}},
    {[](auto& p, auto&) { p.axis_stride = -3; }, Status::argument, {"stride", "-3"}},
    {[](auto& p, auto&) { p.mass_stride = 0; }, Status::argument, {"stride", "0"}},
    {[](auto& p, auto&) { p.softening_stride = 0; }, Status::argument, {"stride", "0"}},
    {[](auto&, auto& v) { v[3 * 17 + 1] = nan; },
     Status::nonfinite,
     {"particle 17", "position[1]", "nan"}},
    {[](auto&, auto& v) { v[3 * 49 + 2] = v[140] = infinite; },
     Status::nonfinite,
     {"particle 46", "position[2]", "inf"}},
    {[](auto&, auto& v) { v[masses + 20] = v[masses + 3] = nan; },
     Status::nonfinite,
     {"particle 3", "mass", "nan"}},
    {[](auto&, auto& v) { v[lengths + 49] = -infinite; },
     Status::nonfinite,
     {"particle 49", "softening", "-inf"}},
    {[](auto&, auto& v) { v[lengths] = -0.5; },
     Status::argument,
     {"particle 0", "softening", "-0.5"}},
    {[](auto&, auto& v) { v[0] = 1.7e308, v[3] = -1.7e308; }, Status::argument, {"wide", "inf"}},
    {[](auto&, auto& v) { v[masses] = v[masses + 1] = 1.7e308; },
     Status::argument,
     {"mass", "inf"}},
};

class BadInput : public ::testing::Test {
protected:
    BadInput() : scene_(plummer_scene(50)) {
        scene_.e.assign(50, 0.125);
        solve(gravity_, scene_, {});
        before_ = Forces(gravity_).a;
    }
    void expect_failure(Status status, const std::vector<std::string>& words,
                        const GravityParticles& particles, const GravityOptions& options) {
        EXPECT_TRUE(fails_with(status, words, [&] { gravity_.solve(particles, options); }));
        EXPECT_EQ(Forces(gravity_).a, before_);
        EXPECT_EQ(gravity_.n(), 50);
    }
    GravityScene scene_;
    Gravity gravity_;
    std::vector<double> before_;
};

TEST_F(BadInput, of_options_is_named) {
    const SceneArrays<> arrays(scene_);
    for (std::size_t k = 0; k < bad_options.size(); ++k) {
        SCOPED_TRACE(k);
        GravityOptions options;
        bad_options[k].change(options);
        expect_failure(bad_options[k].status, bad_options[k].words, arrays.particles(), options);
    }
}

TEST_F(BadInput, of_particles_is_named_the_first_one) {
    for (std::size_t k = 0; k < bad_particles.size(); ++k) {
        SCOPED_TRACE(k);
        std::vector<double> values;
        for (std::size_t i = 0; i < 50; ++i)
            values.insert(values.end(), {scene_.x[i], scene_.y[i], scene_.z[i]});
        values.insert(values.end(), scene_.m.begin(), scene_.m.end());
        values.insert(values.end(), scene_.e.begin(), scene_.e.end());
        GravityParticles particles =
            GravityParticles::interleaved(values.data(), values.data() + masses, 50);
        particles.softening = values.data() + lengths;
        bad_particles[k].change(particles, values);
        expect_failure(bad_particles[k].status, bad_particles[k].words, particles, {});
    }
}

TEST_F(BadInput, that_does_not_fit_the_budget_is_named) {
    for (const GravityMethod method :
         {GravityMethod::direct, GravityMethod::walk, GravityMethod::fmm}) {
        GravityOptions options = to_tolerance(1e-4, method);
        options.budget.bytes = 1000;
        const SceneArrays<> arrays(uniform_scene(5000));
        expect_failure(Status::budget, {"budget"}, arrays.particles(), options);
    }
}

}  // namespace
}  // namespace connectivity::test
