// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of box trees: <case>/<particles>, leaves of at most 64. Cases: uniform, plummer
// (cut at 50 scale lengths), clusters (two normal ones, sigma 1e-3 and 1e-2), radii (Plummer, half
// of the particles targets with radii 2^U(-12,-2) that may stick out by a quarter).
//
//     box_tree --benchmark_filter=plummer/1000000
#include <benchmark/benchmark.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/tree/box_tree.hpp>

#include "tree_clouds.hpp"

namespace {

using namespace connectivity;
using namespace connectivity::bench;

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
    const auto x = cloud(plummer, n, 1), y = cloud(plummer, n, 2), r = wide_radii(n);
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
