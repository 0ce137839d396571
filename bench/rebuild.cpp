// SPDX-License-Identifier: BSD-3-Clause
// build/bench/rebuild: time and memory of neighbour rows and pairs on W1-W7 and on hard scenes,
// next to peers (bench/peers/) in the same process.
//
//   build/bench/rebuild --benchmark_filter='W1/(rows|pairs)/2$' --benchmark_out=record.json
//   python3 bench/table.py record.json
//
// Points and numbers of pairs are checked before anything is timed. Every timed build sees points
// displaced by 0.05 of their support. Contestants of a group alternate in random order. sh
// bench/run.sh makes record, table and charts.

#include <exception>
#include <iostream>

#include "processes.hpp"

int main(int argc, char** argv) {
    try {
        const auto job = connectivity::bench::job_of_this_process();
        return job ? connectivity::bench::run_job(*job, argc, argv)
                   : connectivity::bench::run_groups(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "error: " << error.what() << '\n';
        return 1;
    }
}
