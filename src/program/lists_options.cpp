// SPDX-License-Identifier: BSD-3-Clause
#include "program/lists_options.hpp"

#include <limits>
#include <map>

#include <connectivity/io/lists_input.hpp>

#include "program/choice.hpp"

namespace connectivity::program {

namespace {

void add_tree(CLI::App& sub, ListsOptions& o) {
    constexpr auto most = std::numeric_limits<std::int32_t>::max();
    const std::map<std::string, Coincident> coincident{{"error", Coincident::error},
                                                       {"leaf", Coincident::leaf}};
    sub.add_option("--leaf", o.leaf,
                   "Most particles in a leaf (weight, where the file has weights); default 64")
        ->check(CLI::Range(1, most))
        ->type_name("N");
    add_choice(sub, "--kind", o.kind, tree_kind_names(), "Which boxes are split; default adaptive");
    add_choice(sub, "--coincident", o.coincident, coincident,
               "What more particles at one place than a leaf may hold are; default error");
    sub.add_option("--stick-out", o.stick_out,
                   "How far particles with radii may stick out of a box, in half widths of it; "
                   "default 0")
        ->check(CLI::NonNegativeNumber)
        ->type_name("S");
    add_choice(sub, "--extent-norm", o.extent_norm, extent_norm_names(),
               "Particles with radii stay in the cube (linf), or the ball around it, of a box "
               "enlarged by 1 + S; default linf");
    sub.add_flag("--tree-only", o.tree_only, "No lists");
}

void add_traversal(CLI::App& sub, ListsOptions& o) {
    constexpr auto most = std::numeric_limits<std::int32_t>::max();
    sub.add_option("--n-away", o.n_away,
                   "Boxes of a level are near if at most so many boxes apart; default 1")
        ->check(CLI::Range(1, most))
        ->type_name("N");
    add_choice(sub, "--criterion", o.criterion, from_sep_smaller_crit_names(),
               "When a box is far enough from particles with radii; default precise_linf");
    sub.add_option("--min-sources", o.min_sources,
                   "Boxes with fewer sources go to close lists, where there are radii; default 0")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
}

}  // namespace

void add_lists_command(CLI::App& app, ListsOptions& o) {
    auto& sub = *app.add_subcommand(
        "lists", "Box tree and fast-multipole interaction lists of a snapshot, node file or case");
    sub.add_option("FILE", o.file,
                   "GADGET, SWIFT, H5Part or node file (sources and targets are all nodes), or a "
                   "case of sources and targets (HDF5)")
        ->required();
    sub.add_option("--list", o.lists,
                   "A list to take part (PartType0, ...); repeat for more. Default: every list")
        ->allow_extra_args(false)
        ->type_name("NAME");
    sub.add_flag("--open", o.open,
                 "No periodic axis, whatever the file says; else a periodic box is the root");
    sub.add_option("--step", o.step, "Step of an H5Part file; default: the last")
        ->check(CLI::NonNegativeNumber)
        ->type_name("K");
    add_tree(sub, o);
    add_traversal(sub, o);
    sub.add_option("--out", o.out, "Write tree, lists and their classes to this HDF5 file")
        ->type_name("FILE");
    auto* const plot =
        sub.add_option("--plot", o.plot,
                       "Draw the lists of one box (needs gnuplot); of a 3D tree a slice through it")
            ->type_name("FILE.png");
    sub.add_option("--box", o.box,
                   "The box to draw; default: the target box with entries in the most lists")
        ->check(CLI::NonNegativeNumber)
        ->needs(plot)
        ->type_name("NUMBER");
    sub.add_option("--threads", o.n_threads, "Threads; default: all cores, or OMP_NUM_THREADS")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    sub.add_option("--budget", o.budget,
                   "Largest size of the tree, and of the lists (512MiB, 8GiB); default: 80 % of "
                   "free memory")
        ->transform(CLI::AsSizeValue(false))
        ->type_name("BYTES");
}

}  // namespace connectivity::program
