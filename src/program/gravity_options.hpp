// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The command line of `connectivity gravity`.

#include <CLI/CLI.hpp>

#include "program/commands.hpp"

namespace connectivity::program {

/// Adds the subcommand; parsing fills `command`, which must outlive `app`.
void add_gravity_command(CLI::App& app, GravityCommand& command);

}  // namespace connectivity::program
