// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of box trees: <case>/<particles>, leaves of at most 64. Cases: uniform, plummer
// (cut at 50 scale lengths), clusters (two normal ones, sigma 1e-3 and 1e-2), radii (Plummer, half
// of the particles targets with radii 2^U(-12,-2) that may stick out by a quarter).
//
//     box_tree --benchmark_filter=plummer/1000000
#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/tree/box_tree.hpp>

#include <support/random.hpp>

namespace {

using namespace connectivity;
using test::Random;

using Point = std::array<double, 3>;

double normal(Random& random) {
    return std::sqrt(-2 * std::log(1 - random.uniform())) *
           std::cos(2 * std::numbers::pi * random.uniform());
}

Point uniform(Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

Point plummer(Random& random) {
    double radius = 0;
    do radius = 1 / std::sqrt(std::pow(1 - random.uniform(), -2.0 / 3) - 1);
    while (!(radius < 50));
    const double z = random.uniform(-1, 1), angle = 2 * std::numbers::pi * random.uniform(),
                 rho = std::sqrt(1 - z * z);
    return {radius * rho * std::cos(angle), radius * rho * std::sin(angle), radius * z};
}

Point clusters(Random& random) {
    const bool first = random.chance(0.5);
    const double sigma = first ? 1e-3 : 1e-2, at = first ? 0.25 : 0.75;
    return {at + sigma * normal(random), at + sigma * normal(random), at + sigma * normal(random)};
}

std::vector<double> cloud(Point (*point)(Random&), Offset n, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> x;
    for (Offset i = 0; i < n; ++i) {
        const Point p = point(random);
        x.insert(x.end(), p.begin(), p.end());
    }
    return x;
}

void run(benchmark::State& state, const TreeInput& input, TreeOptions options) {
    options.max_particles_in_box = 64;
    BoxTree tree;
    for (auto _ : state) tree.build(input, options);
    const auto n = static_cast<double>(state.range(0));
    state.counters["boxes"] = static_cast<double>(tree.view().n_boxes);
    state.counters["levels"] = tree.view().n_levels;
    state.counters["bytes_per_particle"] = static_cast<double>(tree.bytes()) / n;
    state.counters["scratch_per_particle"] = static_cast<double>(tree.scratch_bytes()) / n;
    for (const ReportEntry& part : tree.report().entries())
        state.counters["ms_" + part.product] = part.ms;
}

void points(benchmark::State& state, Point (*point)(Random&)) {
    const auto x = cloud(point, state.range(0), 1);
    TreeInput input;
    input.sources = ParticleArray::interleaved(x.data(), state.range(0), 3);
    run(state, input, {});
}

void radii(benchmark::State& state) {
    const Offset n = state.range(0) / 2;
    const auto x = cloud(plummer, n, 1), y = cloud(plummer, n, 2);
    std::vector<double> r(n);
    for (Offset i = 0; i < n; ++i) r[i] = std::exp2(-12 + 10 * test::u01(3, i));
    TreeInput input;
    input.sources = ParticleArray::interleaved(x.data(), n, 3);
    input.targets = ParticleArray::interleaved(y.data(), n, 3);
    input.targets->radii = r.data();
    TreeOptions options;
    options.stick_out_factor = 0.25;
    run(state, input, options);
}

void sizes(benchmark::internal::Benchmark* bench) {
    for (const Offset n : {10'000, 100'000, 1'000'000, 4'000'000}) bench->Arg(n);
    bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(points, uniform, uniform)->Name("uniform")->Apply(sizes);
BENCHMARK_CAPTURE(points, plummer, plummer)->Name("plummer")->Apply(sizes);
BENCHMARK_CAPTURE(points, clusters, clusters)->Name("clusters")->Apply(sizes);
BENCHMARK(radii)->Name("radii")->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
