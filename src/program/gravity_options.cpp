// SPDX-License-Identifier: BSD-3-Clause
#include "program/gravity_options.hpp"

#include <connectivity/io/gravity_file.hpp>

#include "program/choice.hpp"

namespace connectivity::program {

namespace {

void add_input(CLI::App& sub, GravityCommand& c) {
    sub.add_option("FILE", c.file, "GADGET, SWIFT, H5Part or node file (HDF5) with masses")
        ->required();
    sub.add_option("--list", c.lists,
                   "A list to take part (PartType0, ...); repeat for more. Default: every list")
        ->allow_extra_args(false)
        ->type_name("NAME");
    sub.add_flag("--open", c.open,
                 "No periodic axis, whatever the file says; else a periodic box has images without "
                 "end (Ewald)");
    sub.add_option("--step", c.step, "Step of an H5Part file; default: the last")
        ->check(CLI::NonNegativeNumber)
        ->type_name("K");
    sub.add_option("--constant", c.options.constant,
                   "Constant of gravity in the units of the file; default 1")
        ->type_name("G");
    add_choice(sub, "--softening", c.options.softening, softening_names(),
               "What softening lengths (of a node file) do to a pair; default plummer");
}

/// What the tolerance decides unless it is told.
void add_settings(CLI::App& sub, GravityOptions& o) {
    sub.add_option("--tolerance", o.tolerance,
                   "Relative error of the acceleration that 99 % of the particles stay below; "
                   "default 1e-4")
        ->type_name("T");
    add_choice(sub, "--method", o.method, gravity_method_names(),
               "All pairs, a tree walk, the fast multipole method; default: pairs or multipole, "
               "the faster");
    sub.add_option("--order", o.order, "Order of the expansions, by hand")->type_name("P");
    add_choice(sub, "--acceptance", o.acceptance, acceptance_names(),
               "When cells are far enough for expansions, by hand: by the field of all masses, the "
               "acceleration of the particle, or the opening angle");
    sub.add_option("--epsilon", o.epsilon, "Number of the acceptance, by hand, with --order")
        ->type_name("E");
    sub.add_option("--leaf", o.leaf, "Most particles in a leaf, by hand")->type_name("N");
    add_choice(sub, "--near", o.near, near_precision_names(),
               "Precision of sums over near pairs, by hand");
    sub.add_flag("--symmetric", o.symmetric,
                 "Conserve momentum to round-off: forces of two cells on each other are opposite");
    sub.add_option("--samples", o.n_samples,
                   "Particles that are summed directly to check the error; default 300, 0: none")
        ->type_name("K");
    sub.add_option("--seed", o.seed, "Seed of the sample; default 1")
        ->check(CLI::NonNegativeNumber)
        ->type_name("S");
}

}  // namespace

void add_gravity_command(CLI::App& app, GravityCommand& c) {
    auto& sub = *app.add_subcommand(
        "gravity", "Accelerations and potentials of a snapshot or node file, to a tolerance");
    add_input(sub, c);
    add_settings(sub, c.options);
    sub.add_option("--out", c.out, "Write accelerations and potentials to this HDF5 file")
        ->type_name("FILE");
    sub.add_option("--plot", c.plot,
                   "Draw acceleration and potential around the deepest particle (needs gnuplot)")
        ->type_name("FILE.png");
    sub.add_option("--threads", c.n_threads, "Threads; default: all cores, or OMP_NUM_THREADS")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    sub.add_option("--budget", c.budget,
                   "Largest size of tree and sums (512MiB, 8GiB); default: 80 % of free memory")
        ->transform(CLI::AsSizeValue(false))
        ->type_name("BYTES");
}

}  // namespace connectivity::program
