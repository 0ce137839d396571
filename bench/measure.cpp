// SPDX-License-Identifier: BSD-3-Clause
#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <connectivity/base/runtime.hpp>

#include <support/process.hpp>
#include <support/random.hpp>

#include "host_step.hpp"
#include "memory_speed.hpp"
#include "peers/peer.hpp"
#include "reference.hpp"

namespace connectivity::bench {
namespace {

/// A contestant after its check: what it builds, and what the build cost in memory.
struct Entry {
    CaseName name;
    Form form = Form::rows;
    std::unique_ptr<Contestant> contestant;
    int state = 0;  ///< of the last build
    Offset n_pairs = 0, result_bytes = 0, peak_bytes = 0;
    Offset n_pairs_off = 0;  ///< of who compares in single precision: largest error of any state

    bool tensor() const { return name.variant == "tensor"; }
    void remake(const Input& input) {
        contestant.reset();
        contestant = make_contestant(name.who, name.variant, input, form);
    }
    /// On to the next displaced state.
    void move(const Input& input) {
        if (input.n_moved() == 0) return;
        state = state % input.n_moved() + 1;
        contestant->place(state);
    }
    /// Pairs found by the last build; -1 if rows contradict themselves or the pairs.
    Offset found() const {
        const Offset entries = contestant->n_row_entries(), pairs = contestant->n_pairs();
        if (form == Form::both && entries != 2 * pairs) return -1;
        return form != Form::rows ? pairs : entries % 2 == 0 ? entries / 2 : -1;
    }
};

/// First build, in memory of its own.
void build_and_weigh(Entry& entry, const Input& input) {
    const std::int64_t before = test::resident_bytes();
    test::reset_peak();
    entry.remake(input);
    entry.contestant->build();
    entry.peak_bytes = test::peak_resident_bytes() - before;
    entry.result_bytes = entry.contestant->result_bytes();
    entry.n_pairs = entry.found();
}

bool sample_agrees(const Entry& entry, const Input& input) {
    constexpr int n_sampled = 32;
    for (int k = 0; k < n_sampled; ++k) {
        const auto node = static_cast<Offset>(test::mix(static_cast<std::uint64_t>(k)) %
                                              static_cast<std::uint64_t>(input.cloud.n));
        if (entry.contestant->agrees(node, neighbours_of(input, entry.tensor(), entry.state, node)))
            continue;
        std::cerr << "error: " << entry.name.name() << ": the neighbours of node " << node
                  << " in state " << entry.state << " are not those of the definition\n";
        return false;
    }
    return true;
}

bool is_exact(const Entry& entry) {
    const Peer* const peer = peer_named(entry.name.who);
    return peer == nullptr || peer->exact;
}

/// Whether the last build found what others did. What nobody told counts from now on. Single
/// precision moves a node by up to 3e-5 (coordinates of 1000), and so some pairs across the
/// boundary, either way: 1e-5 of the pairs, or four, are let pass and reported. agrees() judges
/// them one by one.
bool count_agrees(Entry& entry, std::vector<Offset>& n_pairs) {
    Offset& wanted = n_pairs.at(static_cast<std::size_t>(entry.state));
    const Offset found = entry.found();
    if (wanted < 0 && is_exact(entry)) wanted = found;
    const Offset off = wanted < 0 ? 0 : std::abs(found - wanted);
    entry.n_pairs_off = std::max(entry.n_pairs_off, off);
    const Offset allowed = is_exact(entry) ? 0 : std::max(Offset{4}, wanted / 100000);
    if (found >= 0 && off <= allowed) return true;
    std::cerr << "error: " << entry.name.name() << " finds " << found << " pairs instead of "
              << wanted << " in state " << entry.state << '\n';
    return false;
}

/// Ours in every state; peers, which the counts come from, and walks, which are long, in the first
/// two.
bool check(Entry& entry, const Input& input, std::vector<Offset>& n_pairs) {
    build_and_weigh(entry, input);
    bool good = count_agrees(entry, n_pairs) && sample_agrees(entry, input);
    const bool all = entry.name.who == "ours" && !is_walk(entry.name.variant);
    const int n_checked = all ? std::max(2, input.n_moved()) : 1;
    for (int k = 0; good && k < n_checked; ++k) {
        entry.move(input);
        entry.contestant->build();
        good = count_agrees(entry, n_pairs) && (k > 0 || sample_agrees(entry, input));
    }
    if (entry.name.first) entry.contestant.reset();
    return good;
}

/// Counts of all states, -1 where unknown; the documented one overrides.
bool complete(std::vector<Offset>& n_pairs, const Input& input, bool tensor) {
    const Cloud& c = input.cloud;
    n_pairs.resize(static_cast<std::size_t>(input.n_moved()) + 1, -1);
    if (tensor || c.n_pairs < 0 || !c.is_standard()) return true;
    if (n_pairs[0] >= 0 && n_pairs[0] != c.n_pairs) {
        std::cerr << "error: the peer finds " << n_pairs[0] << " pairs in " << c.name
                  << " instead of " << c.n_pairs << '\n';
        return false;
    }
    n_pairs[0] = c.n_pairs;
    return true;
}

bool check(std::vector<Entry>& entries, const Input& input, Job job) {
    const Cloud& c = input.cloud;
    if (c.wanted_hash != 0 && !c.is_standard())
        std::cerr << c.name << ": hash " << std::hex << c.hash << " instead of " << c.wanted_hash
                  << std::dec << " (another mathematics library): its documented count is unused\n";
    bool good =
        complete(job.n_pairs["ball"], input, false) && complete(job.n_pairs["tensor"], input, true);
    for (Entry& entry : entries)
        good = good && check(entry, input, job.n_pairs[entry.tensor() ? "tensor" : "ball"]);
    return good;
}

using Clock = std::chrono::steady_clock;

void run(benchmark::State& state, Entry& entry, const Input& input, const MemorySpeed& speed) {
    double sum = 0, check_ms = 0, n_rebuilds = 0;
    for (auto _ : state) {
        if (entry.name.first) entry.remake(input);
        entry.move(input);
        const auto start = Clock::now();
        entry.contestant->build();
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count() /
                               entry.contestant->n_steps();
        state.SetIterationTime(seconds);
        sum += seconds;
        check_ms += entry.contestant->check_ms();
        n_rebuilds += entry.contestant->n_rebuilds();
        if (entry.name.first) entry.contestant.reset();
    }
    const double build = sum / static_cast<double>(state.iterations());
    const auto n = static_cast<double>(input.cloud.n), pairs = static_cast<double>(entry.n_pairs);
    auto& counters = state.counters;
    counters["nodes"] = n;
    counters["pairs"] = pairs;
    counters["ns_per_node"] = 1e9 * build / n;
    counters["entries_per_s"] = (entry.form == Form::pairs ? pairs : 2 * pairs) / build;
    counters["bytes_returned"] = static_cast<double>(entry.result_bytes);
    counters["bytes_per_pair"] = static_cast<double>(entry.result_bytes) / std::max(1.0, pairs);
    counters["peak_MiB"] = static_cast<double>(entry.peak_bytes) / 1048576.0;
    counters["floor_ms"] = 1e3 * floor_seconds(speed, input.cloud.n, entry.result_bytes);
    counters["store_GBps"] = speed.store / 1e9;
    counters["touch_GBps"] = speed.touch / 1e9;
    counters["touch_large_GBps"] = speed.touch_large / 1e9;
    if (entry.n_pairs_off > 0)  // its coefficient of variation, 0/0, is no JSON
        counters["pairs_off"] = static_cast<double>(entry.n_pairs_off);
    if (is_walk(entry.name.variant))
        counters["rebuilds"] = n_rebuilds / static_cast<double>(state.iterations());
    if (check_ms > 0) counters["check_percent"] = 100 * check_ms / (1e3 * sum);
}

std::string compiler() {
#if defined(__clang__)
    return std::string("clang ") + __clang_version__;
#else
    return std::string("gcc ") + __VERSION__;
#endif
}

/// Name of the processor, where the system tells it.
std::string cpu() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown processor";
}

/// A reporter that leaves "/iterations:1" and "/manual_time" out of the names.
template <class Reporter>
class PlainNames final : public Reporter {
public:
    void ReportRuns(const std::vector<benchmark::BenchmarkReporter::Run>& reported) override {
        auto runs = reported;
        for (auto& run : runs) run.run_name.time_type.clear(), run.run_name.iterations.clear();
        Reporter::ReportRuns(runs);
    }
};

int count(const Job& job) {
    std::cout << nlohmann::json(reference_pairs(make_input(job.count, job.tensor), job.tensor));
    stop_runtime();
    return 0;
}

int measure(const Job& job) {
    bool tensor = false;
    for (const CaseName& name : job.cases) tensor = tensor || name.variant == "tensor";
    const Input input = make_input(job.cases.at(0).cloud(), tensor);
    const MemorySpeed speed = measure_memory_speed();
    std::vector<Entry> entries;
    entries.reserve(job.cases.size());
    for (const CaseName& name : job.cases)
        entries.push_back({name, form_of(name.form), nullptr, 0, 0, 0, 0, 0});
    if (!check(entries, input, job)) return 1;
    benchmark::AddCustomContext("connectivity", runtime_description());
    benchmark::AddCustomContext("compiler", compiler());
    benchmark::AddCustomContext("cpu", cpu());
    for (const Peer& peer : peers())
        benchmark::AddCustomContext("peer_" + peer.name, peer.delivers);
    for (Entry& entry : entries) {
        auto* const registered = benchmark::RegisterBenchmark(
            entry.name.name().c_str(),
            [&entry, &input, &speed](benchmark::State& state) { run(state, entry, input, speed); });
        registered->Unit(benchmark::kMillisecond)->UseManualTime();
        if (is_walk(entry.name.variant)) registered->Iterations(1);  // a walk is 100 steps
    }
    PlainNames<benchmark::ConsoleReporter> console;
    PlainNames<benchmark::JSONReporter> record;
    benchmark::RunSpecifiedBenchmarks(&console, &record);
    entries.clear();  // views go before Kokkos does
    stop_runtime();
    return 0;
}

}  // namespace

int run_job(const Job& job, int argc, char** argv) {
    if (job.cases.empty()) return count(job);
    std::vector<std::string> words = {
        argv[0], "--benchmark_repetitions=5", "--benchmark_min_time=0.2",
        "--benchmark_enable_random_interleaving=true", "--benchmark_display_aggregates_only=true"};
    words.insert(words.end(), argv + 1, argv + argc);  // the user's words come last and win
    std::vector<char*> arguments;
    arguments.reserve(words.size());
    for (std::string& word : words) arguments.push_back(word.data());
    int n_arguments = static_cast<int>(arguments.size());
    benchmark::Initialize(&n_arguments, arguments.data());
    return benchmark::ReportUnrecognizedArguments(n_arguments, arguments.data()) ? 1 : measure(job);
}

}  // namespace connectivity::bench
