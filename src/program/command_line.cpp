// SPDX-License-Identifier: BSD-3-Clause
#include "program/command_line.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <new>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <connectivity/base/error.hpp>
#include <connectivity/base/runtime.hpp>

#include "program/choice.hpp"
#include "program/commands.hpp"
#include "program/gravity_options.hpp"
#include "program/lists_options.hpp"

namespace connectivity::program {

namespace {

/// The command as it would be typed again.
std::string joined(int argc, const char* const* argv) {
    std::string text = "connectivity";
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        const bool is_plain =
            !word.empty() && word.find_first_of(" \t\n'\"\\$*?&|;<>()#") == std::string::npos;
        text += is_plain ? " " + word : " '" + word + "'";
    }
    return text;
}

std::string exit_status_help() {
    std::string text =
        "Exit status: 0 success; otherwise the kind of error, described in one sentence on stderr:";
    constexpr std::array kinds{Status::argument, Status::unsupported, Status::nonfinite,
                               Status::support,  Status::not_spd,     Status::box,
                               Status::half_box, Status::too_many,    Status::memory,
                               Status::budget,   Status::file,        Status::format};
    for (const Status kind : kinds)
        text += fmt::format("\n  {:>3}  {}", static_cast<int>(kind), status_text(kind));
    return text + fmt::format("\n  {:>3}  {}", 255, status_text(Status::internal));
}

int report(Status status, std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::fflush(stdout);
    fmt::print(stderr, "connectivity: {}\n", text);
    return static_cast<int>(status) & 0xff;
}

/// Lists beyond rows and pairs, and their order.
void add_lists(CLI::App& sub, PairsOptions& o) {
    const std::map<std::string, IntersectionKind> kinds{{"filtered", IntersectionKind::in_segment},
                                                        {"unfiltered", IntersectionKind::all}};
    const std::map<std::string, ListOrder> orders{{"slot", ListOrder::slot},
                                                  {"key", ListOrder::key}};
    sub.add_flag("--overlap", o.overlap, "Also which nodes see a common node; implies ghost rows");
    add_choice(sub, "--intersection", o.intersection, kinds,
               "Also the common neighbours of each pair that lie between the two (filtered), "
               "or all of them (unfiltered); implies ghost rows")
        ->expected(0, 1)
        ->default_str("filtered")
        ->type_name("[=filtered|unfiltered]");
    add_choice(sub, "--order", o.order, orders,
               "slot: by list and node; key: by Morton key, whatever the order in the file; "
               "implies ghost rows");
    sub.add_flag("--cull", o.cull,
                 "Drop ghosts that no internal node interacts with, and renumber the others");
}

void add_pairs(CLI::App& app, PairsOptions& o) {
    const std::map<std::string, SearchMethod> methods{{"automatic", SearchMethod::automatic},
                                                      {"brute", SearchMethod::brute},
                                                      {"cells", SearchMethod::cells},
                                                      {"groups", SearchMethod::groups},
                                                      {"device", SearchMethod::device}};
    auto* const sub =
        app.add_subcommand("pairs", "Neighbour rows and unique pairs of a snapshot or node file");
    sub->add_option("FILE", o.file, "GADGET, SWIFT, H5Part or node file (HDF5)")->required();
    sub->add_option("--list", o.lists,
                    "A list to take part (PartType0, ...); repeat for more. "
                    "Default: every list that has smoothing lengths")
        ->allow_extra_args(false)
        ->type_name("NAME");
    sub->add_option("--out", o.out, "Write rows and pairs to this HDF5 file")->type_name("FILE");
    sub->add_flag("--density", o.density,
                  "SPH density (cubic spline), compared with the file's own");
    sub->add_option("--plot", o.plot, "Draw projected density and neighbour counts (needs gnuplot)")
        ->type_name("FILE.png");
    sub->add_flag("--ghost-rows", o.ghost_rows, "Rows for ghosts too, and pairs between ghosts");
    add_lists(*sub, o);
    sub->add_option("--extent", o.extent,
                    "Support radius in units of h, instead of what the format says")
        ->check(CLI::PositiveNumber)
        ->type_name("K");
    sub->add_flag("--open", o.open, "No periodic axis, whatever the file says");
    sub->add_option("--step", o.step, "Step of an H5Part file; default: the last")
        ->check(CLI::NonNegativeNumber)
        ->type_name("K");
    add_choice(*sub, "--method", o.method, methods,
               "How neighbours are searched: the result is the same");
    sub->add_option("--threads", o.n_threads, "Threads; default: all cores, or OMP_NUM_THREADS")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    sub->add_option("--budget", o.budget,
                    "Largest size of the result (512MiB, 8GiB); default: 80 % of free memory")
        ->transform(CLI::AsSizeValue(false))
        ->type_name("BYTES");
}

void add_cloud(CLI::App& app, CloudOptions& o) {
    auto* const sub = app.add_subcommand(
        "cloud", "Generate a clustered cloud of nodes with about 75 neighbours as a node file");
    sub->add_option("--n", o.n, "Number of nodes")->required()->type_name("N");
    sub->add_option("--seed", o.seed, "Seed of the random numbers; default 1")->type_name("S");
    sub->add_option("--out", o.out, "Node file to write")->required()->type_name("FILE");
    sub->add_option("--threads", o.n_threads, "Threads; default: all cores, or OMP_NUM_THREADS")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
}

struct Options {
    PairsOptions pairs;
    ListsOptions lists;
    GravityCommand gravity;
    CloudOptions cloud;
};

/// Runs what was asked for; library errors pass through.
void dispatch(const CLI::App& app, const Options& options) {
    if (app.got_subcommand("pairs")) run_pairs(options.pairs);
    if (app.got_subcommand("lists")) run_lists(options.lists);
    if (app.got_subcommand("gravity")) run_gravity(options.gravity);
    if (app.got_subcommand("cloud")) run_cloud(options.cloud);
    if (app.got_subcommand("info")) run_info();
}

int guarded(const CLI::App& app, const Options& options) {
    try {
        dispatch(app, options);
        return 0;
    } catch (const Error& e) {
        return report(e.status(), e.what());
    } catch (const std::bad_alloc&) {
        return report(Status::memory, "memory could not be allocated");
    } catch (const std::exception& e) {
        return report(Status::internal, e.what());
    }
}

}  // namespace

int run(int argc, const char* const* argv) {
    CLI::App app(
        "Who interacts with whom? Neighbour rows, pairs, interaction lists and gravity of any "
        "particle snapshot.",
        "connectivity");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("connectivity ") + CONNECTIVITY_VERSION);
    app.footer(exit_status_help());
    Options options;
    add_pairs(app, options.pairs);
    add_lists_command(app, options.lists);
    add_gravity_command(app, options.gravity);
    add_cloud(app, options.cloud);
    app.add_subcommand("info", "Versions, backends and build of this program");
    options.pairs.command = options.lists.command = options.gravity.command =
        options.cloud.command = joined(argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        return report(Status::argument, std::string(e.what()) + " (see connectivity --help)");
    }
    const int status = guarded(app, options);
    stop_runtime();
    return status;
}

}  // namespace connectivity::program
