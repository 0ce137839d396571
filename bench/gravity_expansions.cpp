// SPDX-License-Identifier: BSD-3-Clause
// Time of the operators of expansions on one thread, by order: <operator>/<order>. The counter
// `each` is seconds per M2L, M2M, L2L (a pair of cells), per particle (P2M, P2L, L2P), or per
// particle and cell (M2P). CONNECTIVITY_ISA takes narrower vectors.
//
//     gravity_expansions --benchmark_filter=m2l
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "gravity/expansion_kernels.hpp"

namespace {

using namespace connectivity::detail;

constexpr int n_cells = 2048, n_listed = 64, n_points = 64, n_children = 8, n_lists = 64;

/// Cells on a shell of radius 2 to 3 around a target at 0, in lists of random entries.
struct Scene {
    int order;
    std::int64_t stride = expansion_stride(order);
    std::vector<double> x, y, z, scale, moments, locals, px, py, pz, mass, p, ax, ay, az;
    std::vector<std::int32_t> id;

    explicit Scene(int order_) : order(order_) {
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> uniform(-1, 1);
        const auto fill = [&](std::vector<double>& values, std::int64_t n) {
            values.resize(static_cast<std::size_t>(n));
            for (double& value : values) value = uniform(random);
        };
        fill(moments, n_cells * stride);
        fill(locals, n_cells * stride);
        for (auto* values : {&x, &y, &z}) fill(*values, n_cells);
        for (double& value : z) value += value < 0 ? -2 : 2;
        scale.assign(n_cells, 1);
        for (auto* values : {&px, &py, &pz, &mass, &p, &ax, &ay, &az}) fill(*values, n_points);
        for (auto* values : {&px, &py, &pz})
            for (double& value : *values) value *= 0.5;
        std::uniform_int_distribution<std::int32_t> any(0, n_cells - 1);
        for (int k = 0; k < n_lists * n_listed; ++k) id.push_back(any(random));
    }
    CellArrays cells() const {
        return {x.data(), y.data(), z.data(), scale.data(), moments.data(), stride};
    }
    CellList list(std::int64_t which, std::int64_t n) const {
        return {id.data() + which % n_lists * n_listed, n, nullptr, nullptr};
    }
    Expansion target(std::int64_t which) {
        return {{0, 0, 0}, 1, locals.data() + which % n_cells * stride};
    }
    Bodies bodies() const { return {px.data(), py.data(), pz.data(), mass.data(), n_points}; }
    Points points() const { return {px.data(), py.data(), pz.data(), n_points}; }
    Fields fields() { return {p.data(), ax.data(), ay.data(), az.data()}; }
};

using Operator = void (*)(Scene&, std::int64_t);

void run(benchmark::State& state, Operator work, int operations) {
    Scene scene(static_cast<int>(state.range(0)));
    std::int64_t which = 0;
    for (auto _ : state) work(scene, which++);
    state.counters["each"] = benchmark::Counter(
        operations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void add(const char* name, Operator work, int operations) {
    auto* bench = benchmark::RegisterBenchmark(
        name, [=](benchmark::State& state) { run(state, work, operations); });
    for (const int order : {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 20}) bench->Arg(order);
}

const ExpansionKernels& kernels = expansion_kernels();

const bool registered = [] {
    add(
        "m2l",
        [](Scene& s, std::int64_t w) {
            kernels.m2l(s.order, s.cells(), s.list(w, n_listed), s.target(w));
        },
        n_listed);
    add(
        "m2p",
        [](Scene& s, std::int64_t w) {
            kernels.m2p(s.order, s.cells(), s.list(w, n_listed), s.points(), s.fields());
        },
        n_listed * n_points);
    add(
        "p2m", [](Scene& s, std::int64_t w) { kernels.p2m(s.order, s.bodies(), s.target(w)); },
        n_points);
    add(
        "p2l", [](Scene& s, std::int64_t w) { kernels.p2l(s.order, s.bodies(), s.target(w)); },
        n_points);
    add(
        "l2p",
        [](Scene& s, std::int64_t w) { kernels.l2p(s.order, s.target(w), s.points(), s.fields()); },
        n_points);
    add(
        "m2m",
        [](Scene& s, std::int64_t w) {
            kernels.m2m(s.order, s.cells(), s.list(w, n_children), s.target(w));
        },
        n_children);
    add(
        "l2l",
        [](Scene& s, std::int64_t w) {
            kernels.l2l(s.order, s.target(0), s.cells(), s.list(w, n_children), s.locals.data());
        },
        n_children);
    return true;
}();

}  // namespace

BENCHMARK_MAIN();
