// SPDX-License-Identifier: BSD-3-Clause
// build/bench/rebuild: time and memory of neighbour rows and pairs on W1-W7, next to a peer in the
// same process.
//
//   build/bench/rebuild --benchmark_filter='W1/(rows|pairs)/2$' --benchmark_out=record.json
//   python3 bench/table.py record.json
//
// Points and numbers of pairs are checked before anything is timed. Contestants of a group
// alternate in random order.

#include <chrono>
#include <fstream>
#include <iostream>

#include <benchmark/benchmark.h>

#include <connectivity/base/runtime.hpp>

#include <support/process.hpp>

#include "contestants.hpp"
#include "processes.hpp"

namespace connectivity::bench {
namespace {

/// A contestant after its check: what it builds, and what the build cost in memory.
struct Entry {
    CaseName name;
    Form form = Form::rows;
    std::unique_ptr<Contestant> contestant;
    Offset n_pairs = 0, result_bytes = 0, peak_bytes = 0;
};

/// First build, in memory of its own; returns the number of pairs found.
Offset measure_memory(Entry& entry, const test::Workload& workload) {
    const std::int64_t before = test::resident_bytes();
    test::reset_peak();
    const auto contestant = make_contestant(entry.name.who, workload, entry.form);
    contestant->build();
    entry.peak_bytes = test::peak_resident_bytes() - before;
    entry.result_bytes = contestant->result_bytes();
    const Offset entries = contestant->n_row_entries(), pairs = contestant->n_pairs();
    if (entry.form == Form::both && entries != 2 * pairs) return -1;
    return entry.form == Form::rows ? (entries % 2 == 0 ? entries / 2 : -1) : pairs;
}

/// Whether everybody finds the documented number of pairs, or, for points that this machine makes
/// differently, the same.
bool check(std::vector<Entry>& entries, const test::Workload& workload) {
    Offset wanted = workload.is_standard() ? workload.n_pairs : -1;
    if (wanted < 0)
        std::cerr
            << workload.name << ": hash " << std::hex << workload.hash << " instead of "
            << workload.wanted_hash << std::dec
            << " (another mathematics library): contestants are compared with each other only\n";
    for (Entry& entry : entries) {
        const Offset found = measure_memory(entry, workload);
        if (wanted < 0) wanted = found;
        if (found != wanted || found < 0) {
            std::cerr << "error: " << entry.name.name() << " finds " << found
                      << " pairs instead of " << wanted << '\n';
            return false;
        }
        entry.n_pairs = found;
    }
    return true;
}

class Seconds {
public:
    void start() { start_ = std::chrono::steady_clock::now(); }
    void stop() {
        sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double sum() const { return sum_; }

private:
    std::chrono::steady_clock::time_point start_;
    double sum_ = 0;
};

void run(benchmark::State& state, Entry& entry, const test::Workload& workload) {
    const bool first = entry.name.extra == "first";
    if (!first && !entry.contestant) {
        entry.contestant = make_contestant(entry.name.who, workload, entry.form);
        for (int k = 0; k < 3; ++k) entry.contestant->build();  // storage and order have settled
    }
    Seconds seconds;
    for (auto _ : state) {
        if (first) {
            state.PauseTiming();
            entry.contestant = make_contestant(entry.name.who, workload, entry.form);
            state.ResumeTiming();
        }
        seconds.start();
        entry.contestant->build();
        seconds.stop();
        if (first) {
            state.PauseTiming();
            entry.contestant.reset();
            state.ResumeTiming();
        }
    }
    const double build = seconds.sum() / static_cast<double>(state.iterations());
    const auto n_entries =
        static_cast<double>(entry.form == Form::pairs ? entry.n_pairs : 2 * entry.n_pairs);
    state.counters["ns_per_node"] = 1e9 * build / static_cast<double>(workload.n);
    state.counters["entries_per_s"] = n_entries / build;
    state.counters["bytes_per_pair"] =
        static_cast<double>(entry.result_bytes) / static_cast<double>(entry.n_pairs);
    state.counters["peak_MiB"] = static_cast<double>(entry.peak_bytes) / 1048576.0;
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

int run_one_group(int argc, char** argv, const std::string& group) {
    std::vector<std::string> words = {
        argv[0], "--benchmark_repetitions=5", "--benchmark_min_time=0.2",
        "--benchmark_enable_random_interleaving=true", "--benchmark_display_aggregates_only=true"};
    words.insert(words.end(), argv + 1, argv + argc);  // the user's words come last and win
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    int n_arguments = static_cast<int>(arguments.size());
    benchmark::Initialize(&n_arguments, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(n_arguments, arguments.data())) return 1;

    std::vector<Entry> entries;
    for (const CaseName& name : all_cases())
        if (name.group() == group) entries.push_back({name, form_of(name.form), nullptr, 0, 0, 0});
    const test::Workload workload = test::make_workload(entries.at(0).name.workload);
    if (!check(entries, workload)) return 1;
    benchmark::AddCustomContext("connectivity", runtime_description());
    benchmark::AddCustomContext("compiler", compiler());
    benchmark::AddCustomContext("cpu", cpu());
    for (Entry& entry : entries)
        benchmark::RegisterBenchmark(entry.name.name().c_str(), [&entry, &workload](
                                                                    benchmark::State& state) {
            run(state, entry, workload);
        })->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
    entries.clear();  // views go before Kokkos does
    stop_runtime();
    return 0;
}

}  // namespace
}  // namespace connectivity::bench

int main(int argc, char** argv) {
    const std::string group = connectivity::bench::group_of_this_process();
    return group.empty() ? connectivity::bench::run_groups(argc, argv)
                         : connectivity::bench::run_one_group(argc, argv, group);
}
