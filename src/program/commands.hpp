// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The subcommands of `connectivity`, each as a function of its options. They write for people on
/// stdout and throw Error; the command line turns an Error into a sentence and an exit status.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <connectivity/gravity/options.hpp>
#include <connectivity/lists/traversal_options.hpp>
#include <connectivity/map/map_options.hpp>
#include <connectivity/tree/tree_input.hpp>

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

/// What is not given is as the file says, or the default.
struct ListsOptions {
    std::string file;
    std::vector<std::string> lists;  ///< in this order; empty: all
    std::string out, plot;           ///< empty: none
    bool open = false, tree_only = false;
    std::optional<Offset> step;
    std::optional<TreeKind> kind;
    std::optional<std::int32_t> leaf;
    std::optional<Coincident> coincident;
    std::optional<double> stick_out;
    std::optional<ExtentNorm> extent_norm;
    std::optional<int> n_away;
    std::optional<FromSepSmallerCrit> criterion;
    std::optional<Offset> min_sources;
    std::optional<BoxId> box;  ///< to draw; default: telling_target_box
    int n_threads = 0;
    std::uint64_t budget = 0;
    std::string command;
};
void run_lists(const ListsOptions& options);

struct GravityCommand {
    std::string file;
    std::vector<std::string> lists;  ///< in this order; empty: all
    std::string out, plot;           ///< empty: none
    bool open = false;
    std::optional<Offset> step;
    GravityOptions options;  ///< all but the domain, which the file has
    int n_threads = 0;
    std::uint64_t budget = 0;
    std::string command;
};
void run_gravity(const GravityCommand& command);

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
