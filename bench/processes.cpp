// SPDX-License-Identifier: BSD-3-Clause
#include "processes.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <regex>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <support/process.hpp>

#include "contestants.hpp"

namespace connectivity::bench {
namespace {

constexpr const char* group_variable = "CONNECTIVITY_BENCH_GROUP";

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
        std::string listing;
        if (argument == "--benchmark_list_tests" || take("benchmark_list_tests", listing))
            a.list = listing != "false";
        else if (take("benchmark_filter", a.filter))
            a.passed_on.push_back(argument);
        else if (!take("benchmark_out", a.out) && !take("benchmark_format", a.format))
            a.passed_on.push_back(argument);
    }
    if (a.filter.empty() || a.filter == "all") a.filter = ".";
    return a;
}

std::vector<CaseName> selected_cases(const std::string& filter) {
    const bool inverted = filter[0] == '-';
    const std::regex pattern(inverted ? filter.substr(1) : filter, std::regex::extended);
    std::vector<CaseName> cases = all_cases();
    std::erase_if(
        cases, [&](const CaseName& c) { return std::regex_search(c.name(), pattern) == inverted; });
    return cases;
}

/// Runs this program for one group; its record goes to `record`.
int run_group(const CaseName& c, const Arguments& a, const std::string& record) {
    setenv(group_variable, c.group().c_str(), 1);
    setenv("OMP_NUM_THREADS", c.threads.c_str(), 1);
    setenv("OMP_PROC_BIND", "false",
           0);  // unless the user wants something else; also silences Kokkos
    const std::string program = test::program_path();
    std::vector<std::string> words = {program, "--benchmark_out=" + record,
                                      "--benchmark_out_format=json"};
    words.insert(words.end(), a.passed_on.begin(), a.passed_on.end());
    std::vector<char*> argv;
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
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// Adds a group's record to the joint one.
void join(nlohmann::json& all, const std::string& record) {
    std::ifstream file(record);
    const nlohmann::json one = nlohmann::json::parse(file, nullptr, false);
    if (one.is_discarded()) return;
    if (all.empty()) all = {{"context", one["context"]}, {"benchmarks", nlohmann::json::array()}};
    for (const auto& benchmark : one["benchmarks"]) all["benchmarks"].push_back(benchmark);
}

}  // namespace

std::vector<CaseName> all_cases() {
    std::vector<CaseName> cases;
    for (const std::string extra : {"", "first"})
        for (const std::string workload : test::all_workloads)
            for (const std::string form : {"rows", "pairs", "both"})
                for (const std::string threads : {"1", "2"})
                    for (const std::string& who : contestants())
                        if (form != "both" || who == "ours")
                            cases.push_back({who, workload, form, threads, extra});
    return cases;
}

int run_groups(int argc, char** argv) {
    const Arguments a = parse(argc, argv);
    const std::vector<CaseName> cases = selected_cases(a.filter);
    if (a.list) {
        for (const CaseName& c : cases) std::cout << c.name() << '\n';
        return 0;
    }
    if (cases.empty())
        std::cerr << "no case matches " << a.filter << "; --benchmark_list_tests shows all\n";
    const std::string record = (std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "/tmp") +
                               ("/connectivity-rebuild-" + std::to_string(getpid()) + ".json");
    nlohmann::json all;
    int status = cases.empty() ? 1 : 0;
    for (std::size_t k = 0; k < cases.size(); ++k) {
        if (k > 0 && cases[k].group() == cases[k - 1].group()) continue;
        status = std::max(status, run_group(cases[k], a, record));
        join(all, record);
        std::remove(record.c_str());
    }
    if (!a.out.empty()) std::ofstream(a.out) << all.dump(2) << '\n';
    if (a.format == "json") std::cout << all.dump(2) << '\n';
    return status;
}

std::string group_of_this_process() {
    const char* const group = std::getenv(group_variable);
    return group != nullptr ? group : "";
}

}  // namespace connectivity::bench
