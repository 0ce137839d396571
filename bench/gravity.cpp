// SPDX-License-Identifier: BSD-3-Clause
// Time and error of gravity in one record: `sh bench/gravity.sh` runs it and draws the charts.
//
//     work/<scene>/<n>/<method>/<order>/<acceptance>/<near>/<epsilon>[/symmetric]   by hand
//     time/<scene>/<n>/<method>/<tolerance>                         to a tolerance, check included
//
// Errors are those of 1000 particles (all, if fewer) against sums over pairs in long double; the
// constant is 1, nothing is softened. Threads: OMP_NUM_THREADS.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <connectivity/base/error.hpp>
#include <connectivity/base/runtime.hpp>
#include <connectivity/gravity/gravity.hpp>

#include <support/gravity_brute.hpp>

namespace {

using namespace connectivity;

constexpr Offset n_truth = 1000;

/// Particles, and what is right for a sample of them. Kept for all cases of a scene and size.
struct Problem {
    test::GravityScene scene;
    std::vector<double> x;  ///< [3][n]
    std::vector<std::int64_t> targets;
    std::vector<test::BruteSum> exact;

    GravityParticles particles() const {
        return GravityParticles::separate(x.data(), scene.m.data(), scene.n());
    }
};

const Problem& problem(const std::string& name, Offset n) {
    static std::map<std::pair<std::string, Offset>, Problem> all;
    auto& p = all[{name, n}];
    if (!p.x.empty()) return p;
    p.scene = test::make_gravity_scene(name, n);
    for (const auto* const axis : {&p.scene.x, &p.scene.y, &p.scene.z})
        p.x.insert(p.x.end(), axis->begin(), axis->end());
    p.targets = test::sample_targets(n, n_truth);
    p.exact = test::brute_gravity(p.scene, p.targets);
    return p;
}

void set_errors(benchmark::State& state, const std::string& name, std::vector<double> errors) {
    std::sort(errors.begin(), errors.end());
    double squares = 0;
    for (const double e : errors) squares += e * e;
    const auto n = static_cast<double>(errors.size());
    state.counters[name + "_rms"] = std::sqrt(squares / n);
    state.counters[name + "_p99"] = errors[static_cast<std::size_t>(std::ceil(0.99 * n)) - 1];
    state.counters[name + "_max"] = errors.back();
}

void compare(benchmark::State& state, const Problem& p, const Gravity& gravity) {
    const auto a = gravity.acceleration();
    const auto phi = gravity.potential();
    std::vector<double> force, potential;
    for (std::size_t k = 0; k < p.targets.size(); ++k) {
        const auto i = p.targets[k];
        const auto& exact = p.exact[k];
        force.push_back(static_cast<double>(
            test::distance(exact, a(3 * i), a(3 * i + 1), a(3 * i + 2)) / test::length(exact)));
        potential.push_back(static_cast<double>(std::abs(phi(i) + exact.p) / exact.size_p));
    }
    set_errors(state, "force", force);
    set_errors(state, "potential", potential);
}

void set_drift(benchmark::State& state, const Problem& p, const Gravity& gravity) {
    const auto a = gravity.acceleration();
    std::array<double, 3> sum{};
    double size = 0;
    for (Offset i = 0; i < gravity.n(); ++i) {
        const double m = p.scene.m[static_cast<std::size_t>(i)];
        for (int d = 0; d < 3; ++d) sum[static_cast<std::size_t>(d)] += m * a(3 * i + d);
        size += m * std::hypot(a(3 * i), a(3 * i + 1), a(3 * i + 2));
    }
    state.counters["drift"] = std::hypot(sum[0], sum[1], sum[2]) / size;
}

/// As a step of a simulation knows them from the step before.
ConstView<double> lengths_of(const Gravity& gravity) {
    const auto a = gravity.acceleration();
    const auto lengths = allocate<double>("bench/lengths", gravity.n());
    for (Offset i = 0; i < gravity.n(); ++i)
        lengths(i) = std::hypot(a(3 * i), a(3 * i + 1), a(3 * i + 2));
    return lengths;
}

/// Storage is made before the clock starts, unless that would take too long.
void solve(benchmark::State& state, const std::string& scene, Offset n, GravityOptions options) {
    start_runtime();
    const Problem& p = problem(scene, n);
    Gravity gravity;
    const bool is_by_acceleration = options.acceptance == Acceptance::acceleration;
    try {
        if ((n <= 100'000 && options.method != GravityMethod::direct) || is_by_acceleration)
            gravity.solve(p.particles(), options);
        if (is_by_acceleration) options.previous_acceleration = lengths_of(gravity);
        for (auto _ : state) gravity.solve(p.particles(), options);
    } catch (const Error& e) {
        return state.SkipWithError(e.what());
    }
    const GravityInfo& info = gravity.info();
    compare(state, p, gravity);
    set_drift(state, p, gravity);
    state.counters["particles"] = static_cast<double>(n);
    state.counters["threads_used"] = runtime_threads();
    state.counters["method"] = static_cast<double>(info.method);
    state.counters["order"] = info.order;
    state.counters["reached"] = info.reached ? 1 : 0;
    state.counters["sample_p99"] = info.acceleration.p99;
    for (const auto& entry : gravity.report().entries())
        state.counters["ms_" + entry.product] = entry.ms;
}

void add(const std::string& name, const std::string& scene, Offset n,
         const GravityOptions& options) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [=](benchmark::State& state) { solve(state, scene, n, options); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

constexpr const char* methods[] = {"auto", "direct", "walk", "fmm"};
constexpr const char* acceptances[] = {"field", "acceleration", "geometric"};

struct Series {
    GravityMethod method;
    int order;
    Acceptance acceptance = Acceptance::field;
    NearPrecision near = NearPrecision::float64;
    bool symmetric = false;
};

/// Every kind of acceptance, precision and order that a chart compares.
std::vector<Series> all_series() {
    std::vector<Series> series;
    for (const int order : {1, 2, 4, 6}) series.push_back({GravityMethod::walk, order});
    for (const int order : {2, 4, 6, 8, 10, 14}) series.push_back({GravityMethod::fmm, order});
    for (const auto acceptance : {Acceptance::acceleration, Acceptance::geometric}) {
        series.push_back({GravityMethod::walk, 2, acceptance});
        series.push_back({GravityMethod::fmm, 6, acceptance});
    }
    series.push_back({GravityMethod::walk, 2, Acceptance::field, NearPrecision::float32});
    series.push_back({GravityMethod::fmm, 4, Acceptance::field, NearPrecision::float32});
    series.push_back({GravityMethod::fmm, 6, Acceptance::field, NearPrecision::float64, true});
    series.push_back({GravityMethod::fmm, 6, Acceptance::geometric, NearPrecision::float64, true});
    return series;
}

std::vector<double> epsilons(Acceptance acceptance) {
    if (acceptance == Acceptance::geometric) return {0.9, 0.7, 0.5, 0.35};
    if (acceptance == Acceptance::acceleration) return {0.1, 0.01, 1e-3, 1e-4};
    return {1, 0.1, 0.01, 1e-3};
}

void add_work(const std::string& scene, Offset n) {
    const std::string place = fmt::format("work/{}/{}", scene, n);
    GravityOptions direct;
    direct.method = GravityMethod::direct;
    add(place + "/direct/0/field/float64/0", scene, n, direct);
    for (const Series& s : all_series())
        for (const double epsilon : epsilons(s.acceptance)) {
            GravityOptions o;
            o.method = s.method;
            o.order = s.order;
            o.acceptance = s.acceptance;
            o.near = s.near;
            o.symmetric = s.symmetric;
            o.epsilon = epsilon;
            o.n_samples = 0;
            add(fmt::format("{}/{}/{}/{}/{}/{:g}{}", place, methods[static_cast<int>(s.method)],
                            s.order, acceptances[static_cast<int>(s.acceptance)],
                            s.near == NearPrecision::float32 ? "float32" : "float64", epsilon,
                            s.symmetric ? "/symmetric" : ""),
                scene, n, o);
        }
}

void add_times(const std::string& scene, Offset n) {
    for (const auto method :
         {GravityMethod::direct, GravityMethod::walk, GravityMethod::fmm, GravityMethod::automatic})
        for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
            if (method == GravityMethod::direct && tolerance < 1e-2) continue;  // the same
            GravityOptions o;
            o.method = method;
            o.tolerance = tolerance;
            add(fmt::format("time/{}/{}/{}/{:g}", scene, n, methods[static_cast<int>(method)],
                            tolerance),
                scene, n, o);
        }
}

}  // namespace

int main(int argc, char** argv) {
    for (const char* const scene : {"G1", "G2", "G3", "G4", "G5", "G6"})
        for (const Offset n : {20'000, 100'000, 1'000'000}) add_work(scene, n);
    for (const char* const scene : {"G1", "G2", "G4"})
        for (const Offset n :
             {100, 300, 1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000, 10'000'000})
            add_times(scene, n);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
