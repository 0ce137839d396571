// SPDX-License-Identifier: BSD-3-Clause
#include "processes.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <support/process.hpp>

#include "yardstick.hpp"

namespace connectivity::bench {
namespace {

using nlohmann::json;

constexpr const char* job_variable = "CONNECTIVITY_BENCH_JOB";

/// Arguments that concern all groups together.
struct Arguments {
    std::string filter = ".", out, format = "console";
    bool list = false;
    std::vector<std::string> passed_on;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    for (int k = 1; k < argc; ++k) {
        const std::string argument = argv[k];
        const auto take = [&](const std::string& name, std::string& value) {
            const bool mine = argument.rfind("--" + name + "=", 0) == 0;
            if (mine) value = argument.substr(name.size() + 3);
            return mine;
        };
        std::string listing, out_format;  // the record is always JSON
        if (argument == "--benchmark_list_tests" || take("benchmark_list_tests", listing))
            a.list = listing != "false";
        else if (!take("benchmark_filter", a.filter) && !take("benchmark_out", a.out) &&
                 !take("benchmark_out_format", out_format) && !take("benchmark_format", a.format))
            a.passed_on.push_back(argument);
    }
    if (a.filter.empty() || a.filter == "all") a.filter = ".";
    return a;
}

/// Runs this program for one group; its record goes to a file.
int run_group(const json& job, const std::string& threads, const Arguments& a,
              const std::string& record) {
    setenv(job_variable, job.dump().c_str(), 1);
    setenv("OMP_NUM_THREADS", threads.c_str(), 1);
    setenv("OMP_PROC_BIND", "false", 0);  // unless the user wants it; also silences Kokkos
    const std::string program = test::program_path();
    std::vector<std::string> words = {program, "--benchmark_out=" + record,
                                      "--benchmark_out_format=json"};
    words.insert(words.end(), a.passed_on.begin(), a.passed_on.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (a.format != "console")
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = -1;
    if (posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ) == 0)
        waitpid(child, &status, 0);
    posix_spawn_file_actions_destroy(&actions);
    if (WIFSIGNALED(status))
        std::cerr << "error: signal " << WTERMSIG(status) << " in " << job["cases"].dump() << '\n';
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// Pairs of a cloud in all its states, counted once in a run of the benchmark.
class Counts {
public:
    const json& of(const std::string& cloud, bool tensor) {
        json& counts = known_[cloud][tensor ? "tensor" : "ball"];
        if (!counts.is_null()) return counts;
        setenv(job_variable, json{{"count", cloud}, {"tensor", tensor}}.dump().c_str(), 1);
        unsetenv("OMP_NUM_THREADS");
        setenv("OMP_PROC_BIND", "false", 0);
        const test::RunResult run = test::run_command("'" + test::program_path() + "'");
        counts = json::parse(run.out, nullptr, false);
        if (run.status != 0 || !counts.is_array()) {
            std::cerr << "error: the pairs of " << cloud << " could not be counted\n";
            counts = json::array();
        }
        return counts;
    }

private:
    json known_ = json::object();
};

/// Runs cases of one group and collects what is measured.
class Groups {
public:
    explicit Groups(const Arguments& a) : a_(a) {}

    void run(const std::vector<CaseName>& cases) {
        const CaseName* yardstick = nullptr;
        json job = {{"cases", json::array()}};
        bool ball = false, tensor = false;
        for (const CaseName& c : cases) {
            if (c.who == "yardstick")
                yardstick = &c;
            else
                job["cases"].push_back(c.name());
            (c.variant == "tensor" ? tensor : ball) = true;
        }
        if (ball) job["n_pairs"]["ball"] = counts_.of(cases[0].cloud(), false);
        if (tensor) job["n_pairs"]["tensor"] = counts_.of(cases[0].cloud(), true);
        if (yardstick != nullptr) measure(*yardstick, job);
        if (job["cases"].empty()) return;
        const int status = run_group(job, cases[0].threads, a_, record_);
        const bool joined = join();
        if (status == 0 && !joined)
            std::cerr << "error: no readable record of " << job["cases"].dump() << '\n';
        status_ = std::max(status_, status == 0 && !joined ? 1 : status);
        if (yardstick != nullptr) measure(*yardstick, job);
    }

    int status() const { return status_; }
    json record() const { return {{"context", context_}, {"benchmarks", runs_}}; }

private:
    void measure(const CaseName& yardstick, const json& job) {
        const json& counts = job["n_pairs"]["ball"];
        const json run = run_yardstick(yardstick, counts.empty() ? -1 : counts[0].get<Offset>());
        if (run.is_null())
            status_ = 1;
        else
            runs_.push_back(run);
    }

    bool join() {
        std::ifstream file(record_);
        const json one = json::parse(file, nullptr, false);
        std::remove(record_.c_str());
        if (one.is_discarded()) return false;
        if (context_.is_null()) context_ = one["context"];
        for (const auto& run : one["benchmarks"]) runs_.push_back(run);
        return true;
    }

    const Arguments& a_;
    Counts counts_;
    std::string record_ = (std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "/tmp") +
                          ("/connectivity-rebuild-" + std::to_string(getpid()) + ".json");
    json context_, runs_ = json::array();
    int status_ = 0;
};

}  // namespace

int run_groups(int argc, char** argv) {
    const Arguments a = parse(argc, argv);
    const std::vector<CaseName> cases = selected_cases(a.filter);
    if (a.list) {
        for (const CaseName& c : cases) std::cout << c.name() << '\n';
        return 0;
    }
    if (cases.empty()) {
        std::cerr << "no case matches " << a.filter << "; --benchmark_list_tests shows all\n";
        return 1;
    }
    Groups groups(a);
    for (auto first = cases.begin(); first != cases.end();) {
        const auto last = std::find_if(
            first, cases.end(), [&](const CaseName& c) { return c.group() != first->group(); });
        groups.run({first, last});
        first = last;
    }
    if (!a.out.empty()) std::ofstream(a.out) << groups.record().dump(2) << '\n';
    if (a.format == "json") std::cout << groups.record().dump(2) << '\n';
    return groups.status();
}

std::optional<Job> job_of_this_process() {
    const char* const text = std::getenv(job_variable);
    if (text == nullptr) return std::nullopt;
    const json described = json::parse(text);
    Job job;
    job.count = described.value("count", "");
    job.tensor = described.value("tensor", false);
    const auto names = described.value("cases", std::vector<std::string>());
    for (const CaseName& c : all_cases())
        if (std::find(names.begin(), names.end(), c.name()) != names.end()) job.cases.push_back(c);
    job.n_pairs = described.value("n_pairs", job.n_pairs);
    return job;
}

}  // namespace connectivity::bench
