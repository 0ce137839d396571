// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Words and tables for people about what was read and what was found.

#include <span>
#include <string>
#include <vector>

#include <connectivity/io/snapshot.hpp>

#include "program/plot.hpp"
#include "program/statistics.hpp"

namespace connectivity::program {

/// Format, dimension, box and units in one or two lines.
std::string describe_input(const SnapshotInfo& info);

/// "open", "periodic 50000 x 50000 x 50000 ckpc/h", axis by axis where they differ.
std::string describe_domain(const Domain& domain, int dim, const std::string& unit);

/// One line per list: nodes, internal, ghosts, supports.
std::string describe_lists(std::span<const ListData> lists);

/// One line per list: minimum, percentiles, maximum, mean and isolated nodes.
std::string describe_counts(const std::vector<PlotCounts>& counts);

/// Largest number of bytes this process has held so far.
Offset peak_memory();

}  // namespace connectivity::program
