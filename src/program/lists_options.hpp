// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The command line of `connectivity lists`.

#include <CLI/CLI.hpp>

#include "program/commands.hpp"

namespace connectivity::program {

/// Adds the subcommand; parsing fills `options`, which must outlive `app`.
void add_lists_command(CLI::App& app, ListsOptions& options);

}  // namespace connectivity::program
