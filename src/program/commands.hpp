// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The subcommands of `connectivity`, each as a function of its options. They write for people on
/// stdout and throw Error; the command line turns an Error into a sentence and an exit status.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <connectivity/map/map_options.hpp>

namespace connectivity::program {

struct PairsOptions {
    std::string file;
    std::vector<std::string> lists;  ///< in this order; empty: all that have supports
    std::string out, plot;           ///< empty: none
    bool density = false, ghost_rows = false, open = false;
    bool overlap = false, cull = false;
    IntersectionKind intersection = IntersectionKind::none;
    ListOrder order = ListOrder::slot;
    std::optional<double> extent;
    std::optional<Offset> step;
    SearchMethod method = SearchMethod::automatic;
    int n_threads = 0;
    std::uint64_t budget = 0;
    std::string command;  ///< as it was typed; goes into the result file
};
void run_pairs(const PairsOptions& options);

void run_info();

struct CloudOptions {
    Offset n = 0;
    std::uint64_t seed = 1;
    std::string out;
    int n_threads = 0;
    std::string command;
};
void run_cloud(const CloudOptions& options);

}  // namespace connectivity::program
