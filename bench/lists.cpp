// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of interaction lists: <case>/<particles>, the cases of box_tree, leaves of at
// most
// 64. <case>: all lists, rebuilt; translation/<case>, rotation/<case>: classes of list 2.
//
//     lists --benchmark_filter=plummer/1000000
#include <benchmark/benchmark.h>

#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/work.hpp>
#include <connectivity/tree/box_tree.hpp>

#include "tree_clouds.hpp"

namespace {

using namespace connectivity;
using namespace connectivity::bench;

BoxTree make_tree(const std::string& name, Offset n) {
    TreeInput input;
    TreeOptions options;
    options.max_particles_in_box = 64;
    const bool radii = name == "radii";
    if (radii) n /= 2;
    const auto point = name == "uniform" ? uniform : name == "clusters" ? clusters : plummer;
    const auto x = cloud(point, n, 1), y = radii ? cloud(point, n, 2) : x, r = wide_radii(n);
    input.sources = ParticleArray::interleaved(x.data(), n, 3);
    if (radii) {
        input.targets = ParticleArray::interleaved(y.data(), n, 3);
        input.targets->radii = r.data();
        options.stick_out_factor = 0.25;
    }
    BoxTree tree;
    tree.build(input, options);
    return tree;
}

void lists(benchmark::State& state, const std::string& name) {
    const BoxTree tree = make_tree(name, state.range(0));
    FMMTraversalInfo traversal;
    for (auto _ : state) traversal.rebuild(tree.view());
    const Work work = count_work(traversal).total;
    Offset bytes = 0;
    for (const ReportEntry& part : traversal.report().entries()) {
        bytes += part.bytes;
        if (part.ms > 0) state.counters["ms_" + part.product] = part.ms;
    }
    const auto counter = [&](const char* key, Offset value) {
        state.counters[key] = static_cast<double>(value);
    };
    counter("boxes", traversal.nboxes());
    counter("bytes", bytes);
    counter("near_bytes", traversal.report().count("near bytes"));
    counter("list1", static_cast<Offset>(traversal.neighbor_source_boxes().lists.size()));
    counter("list2", work.m2l);
    counter("list3", work.from_sep_smaller_entries);
    counter("list4", work.from_sep_bigger_entries);
}

template <class Classes>
void classes(benchmark::State& state, const std::string& name) {
    const BoxTree tree = make_tree(name, state.range(0));
    const FMMTraversalInfo traversal(tree.view());
    for (auto _ : state) benchmark::DoNotOptimize(Classes(traversal).bytes());
}

void sizes(benchmark::internal::Benchmark* bench) {
    for (const Offset n : {10'000, 100'000, 1'000'000, 4'000'000}) bench->Arg(n);
    bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

const bool registered = [] {
    for (const std::string name : {"uniform", "plummer", "clusters", "radii"}) {
        const auto add = [&](const std::string& title,
                             void (*run)(benchmark::State&, const std::string&)) {
            sizes(benchmark::RegisterBenchmark(title.c_str(),
                                               [=](benchmark::State& state) { run(state, name); }));
        };
        add(name, lists);
        add("translation/" + name, classes<TranslationClassesInfo>);
        add("rotation/" + name, classes<RotationClassesInfo>);
    }
    return true;
}();

}  // namespace

BENCHMARK_MAIN();
