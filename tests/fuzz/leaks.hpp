// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Leaks: libFuzzer looks for them after each input that frees less than it allocates, and gives up
/// after a thousand of these, which HDF5 and OpenMP with their caches soon have; so we look, too.

#include <cstdio>
#include <cstdlib>

#include <sanitizer/lsan_interface.h>

namespace connectivity::test {

/// Ends the process if memory was lost since the last look, with a report of it.
inline void check_for_leaks() {
    if (__lsan_do_recoverable_leak_check() == 0) return;
    std::fprintf(stderr, "leaked by one of the last inputs; -detect_leaks=1 tells by which\n");
    std::abort();
}

}  // namespace connectivity::test
