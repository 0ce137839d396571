// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The number of Kokkos threads is fixed for a process, and so is its peak of memory: every group
/// of cases that is compared (one workload, form and number of threads) runs in a process of its
/// own, in which contestants alternate.

#include <string>
#include <vector>

namespace connectivity::bench {

/// A benchmark's name: <who>/<workload>/<form>/<threads>[/<extra>].
struct CaseName {
    std::string who, workload, form, threads, extra;

    std::string group() const {
        return workload + "/" + form + "/" + threads + (extra.empty() ? "" : "/" + extra);
    }
    std::string name() const { return who + "/" + group(); }
};

/// All cases, those of a group next to each other.
std::vector<CaseName> all_cases();

/// Runs the groups that the arguments select, each in a process of its own, and joins their
/// records. Returns an exit status.
int run_groups(int argc, char** argv);

/// The group this process was started for; empty in the process that the user started.
std::string group_of_this_process();

}  // namespace connectivity::bench
