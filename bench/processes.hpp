// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The number of Kokkos threads is fixed for a process, and so is its peak of memory: every group
/// of cases that is compared runs in a process of its own, in which contestants alternate. Before
/// that another process counts the pairs by means of others. A yardstick runs before and after.

#include <optional>

#include "measure.hpp"

namespace connectivity::bench {

/// Runs the groups that the arguments select, each in a process of its own, and joins their
/// records. Returns an exit status.
int run_groups(int argc, char** argv);

/// What this process was started for; nothing in the process that the user started.
std::optional<Job> job_of_this_process();

}  // namespace connectivity::bench
