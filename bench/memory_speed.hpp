// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What this machine's memory can do, measured with the threads that Kokkos has: the limits that
/// builds are held against.

#include <cstdint>

namespace connectivity::bench {

struct MemorySpeed {
    double store = 0;        ///< bytes/s of streaming stores into memory in use
    double touch = 0;        ///< bytes/s of first stores into new memory, pages as they come
    double touch_large = 0;  ///< the same where large pages were asked for
};

/// Takes about 0.3 s and 128 MiB, which it gives back. Starts the runtime.
MemorySpeed measure_memory_speed();

/// Least seconds of a build: 5 ns a node, and its result at the speed of stores.
inline double floor_seconds(const MemorySpeed& speed, std::int64_t n_nodes, std::int64_t n_bytes) {
    return 5e-9 * static_cast<double>(n_nodes) + static_cast<double>(n_bytes) / speed.store;
}

}  // namespace connectivity::bench
