// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A yardstick: any program that measures the same workloads in its own way, run next to ours.
///
/// CONNECTIVITY_YARDSTICK=<program> in the environment names it. It is run as
/// `<program> -w W1 -m abr -t 2 -r 5 -nocheck` (a rows, b pairs) and has to print, somewhere,
/// "steady <ms>", "min <ms>", "first <seconds>", "rows <n>", "pairs <n>" and "peak <MB>". Its
/// points do not move between its builds.

#include <nlohmann/json.hpp>

#include "cases.hpp"

namespace connectivity::bench {

bool yardstick_is_set();

/// A run of the record, in Google Benchmark's form; null, with a line on stderr, if the program
/// fails or finds other than `n_pairs` pairs (-1: unknown).
nlohmann::json run_yardstick(const CaseName& c, std::int64_t n_pairs);

}  // namespace connectivity::bench
