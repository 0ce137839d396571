// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// One group of cases in one process: everybody's answers are checked in every state of the
/// points, then contestants are measured in turns.

#include <map>

#include "cases.hpp"
#include "contestants.hpp"

namespace connectivity::bench {

/// What a process of its own is started for: to measure `cases`, which are of one group, or, where
/// there are none, to count the pairs of a cloud.
struct Job {
    std::vector<CaseName> cases;
    std::map<std::string, std::vector<Offset>> n_pairs;  ///< "ball", "tensor": of each state
    std::string count;                                   ///< a cloud
    bool tensor = false;
};

/// Counts or measures; arguments are Google Benchmark's. Returns an exit status.
int run_job(const Job& job, int argc, char** argv);

}  // namespace connectivity::bench
