// SPDX-License-Identifier: BSD-3-Clause
// `connectivity gravity`: read, solve, report; on request result file and picture.
#include <filesystem>

#include <fmt/format.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/names.hpp>

#include "program/commands.hpp"
#include "program/console.hpp"
#include "program/describe.hpp"
#include "program/gravity_describe.hpp"
#include "program/gravity_picture.hpp"
#include "program/lists_describe.hpp"
#include "program/outputs.hpp"
#include "program/plot.hpp"
#include "program/units.hpp"

namespace connectivity::program {

namespace {

class GravityRun {
public:
    explicit GravityRun(const GravityCommand& command)
        : command_(command),
          options_(command.options),
          console_(2 + !command.out.empty() + !command.plot.empty()) {
        options_.budget.bytes = static_cast<Offset>(command.budget);
    }

    void run() {
        read();
        solve();
        if (!command_.out.empty()) write();
        if (!command_.plot.empty()) draw();
        Console::line(fmt::format("\npeak memory {}", human_bytes(peak_memory())));
    }

private:
    void read();
    void solve();
    void write();
    void draw();

    const GravityCommand& command_;
    GravityOptions options_;
    Console console_;
    Units units_;
    GravityInput input_;
    Gravity gravity_;
};

void GravityRun::read() {
    const auto reader = open_snapshot(command_.file, {{}, command_.step, command_.open});
    const SnapshotInfo& info = reader->info();
    Console::line(describe_input(info));
    console_.phase("reading", [&] {
        input_ = read_gravity_input(*reader, all_or_selected(info, command_.lists));
    });
    Console::line(describe_gravity_lists(input_) + "\n");
    options_.domain = info.domain;
    if (info.domain.any_periodic(3) && info.domain.periodic != std::array{true, true, true})
        throw Error(Status::unsupported,
                    fmt::format("'{}' is {}, must be open or periodic along x, y and z; --open "
                                "ignores the period",
                                info.path, describe_domain(info.domain, info.dim, {})));
    units_ = info.units;
}

void GravityRun::solve() {
    const int n_threads = runtime_threads();
    console_.phase(fmt::format("gravity with {} thread{}", n_threads, n_threads == 1 ? "" : "s"),
                   [&] { gravity_.solve(input_.particles(), options_); });
    Console::line("    " + describe_times(gravity_.report()));
    Console::line("\n" + describe_solution(gravity_.info(), options_));
    Console::line("\n" + describe_sums(gravity_, input_, options_));
    Console::line(describe_gravity_units(options_.constant, units_) + "\n");
}

void GravityRun::write() {
    console_.phase("writing " + command_.out, [&] {
        write_gravity_file(command_.out, gravity_, options_, input_.lists, command_.command);
    });
}

void GravityRun::draw() {
    console_.phase("drawing " + command_.plot, [&] {
        const auto& info = gravity_.info();
        const auto name = std::filesystem::path(command_.file).filename();
        const std::string caption = fmt::format(
            "{} particles by {}; G = {:g}; potential lowest at the deepest particle. {}",
            gravity_.n(), name_of(info.method, gravity_method_names()), options_.constant,
            info.n_samples == 0 ? ""
                                : fmt::format("99 % of the accelerations are right to {:.2g} (of "
                                              "a sample of {}).",
                                              info.acceleration.p99, info.n_samples));
        draw_gravity(command_.plot, input_, field_points(input_, gravity_, options_.domain),
                     {name.string(), caption, length_unit(units_)});
    });
}

}  // namespace

void run_gravity(const GravityCommand& command) {
    check_outputs(command.file, {command.out, command.plot});
    if (!command.plot.empty()) require_plotting(command.plot);
    start_runtime({.n_threads = command.n_threads});
    GravityRun(command).run();
}

}  // namespace connectivity::program
