// SPDX-License-Identifier: BSD-3-Clause
// Pairs per second of the direct sum: <instruction set>/<type>/<law>/<targets>/<sources>, with one
// and two threads that each sum on their own; the small ones are leaves of a tree. sum/<targets> is
// the whole sum of the million sources or fewer, in as many threads as OMP_NUM_THREADS says.
//
//     gravity_direct --benchmark_filter=avx2/float
#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <benchmark/benchmark.h>

#include <connectivity/base/runtime.hpp>

#include <support/gravity_scenes.hpp>

#include "gravity/direct.hpp"

namespace {

using namespace connectivity;
using namespace connectivity::detail;

void set_rate(benchmark::State& state, double n_targets, double n_sources) {
    state.counters["pairs"] =
        benchmark::Counter(n_targets * n_sources * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate, benchmark::Counter::kIs1000);
}

template <class T>
void kernel(benchmark::State& state, const DirectKernels& kernels, PairLaw law) {
    const std::int64_t n_targets = state.range(0), n_sources = state.range(1);
    const test::GravityScene scene = test::uniform_scene(n_sources);
    const std::vector<T> x(scene.x.begin(), scene.x.end()), y(scene.y.begin(), scene.y.end()),
        z(scene.z.begin(), scene.z.end()), m(scene.m.begin(), scene.m.end()), e(x.size(), T(1e-3));
    std::vector<T> p(x.size()), ax(x.size()), ay(x.size()), az(x.size());
    const NearSources<T> sources{x.data(), y.data(), z.data(), m.data(), e.data(), n_sources};
    const NearTargets<T> targets{x.data(),  y.data(),  z.data(),  e.data(), p.data(),
                                 ax.data(), ay.data(), az.data(), n_targets};
    for (auto _ : state) {
        if constexpr (std::is_same_v<T, double>)
            kernels.add64(law, sources, targets);
        else
            kernels.add32(law, sources, targets);
        benchmark::ClobberMemory();
    }
    set_rate(state, static_cast<double>(n_targets), static_cast<double>(n_sources));
}

void sum(benchmark::State& state) {
    start_runtime();
    const Offset n_targets = state.range(0), n_sources = std::max(n_targets, state.range(1));
    const test::GravityScene scene = test::uniform_scene(n_sources);
    std::vector<double> scratch, p(static_cast<std::size_t>(n_targets)), ax(p), ay(p), az(p);
    for (auto _ : state)
        direct_sum(
            PairLaw::newton,
            {scene.x.data(), scene.y.data(), scene.z.data(), scene.m.data(), nullptr, n_sources},
            {.n = n_targets}, {p.data(), ax.data(), ay.data(), az.data()}, scratch);
    set_rate(state, static_cast<double>(n_targets), static_cast<double>(n_sources));
}
BENCHMARK(sum)->Args({300, 1'000'000})->Args({32768, 32768})->UseRealTime();

template <class T>
void add_cases(const DirectKernels& kernels, const std::string& type) {
    constexpr const char* laws[] = {"newton", "plummer", "sph_exa"};
    for (int k = 0; k < 3; ++k)
        benchmark::RegisterBenchmark((kernels.name + ("/" + type + "/") + laws[k]).c_str(),
                                     [&kernels, k](benchmark::State& state) {
                                         kernel<T>(state, kernels, static_cast<PairLaw>(k));
                                     })
            ->Args({8192, 8192})
            ->Args({40, 300})
            ->Args({40, 40})
            ->Args({3, 3000})
            ->ThreadRange(1, 2)
            ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<const DirectKernels*> tables{&portable_direct_kernels};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        tables.push_back(&avx2_direct_kernels);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        tables.push_back(&avx512_direct_kernels);
#endif
    for (const DirectKernels* const table : tables) {
        add_cases<double>(*table, "double");
        add_cases<float>(*table, "float");
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
