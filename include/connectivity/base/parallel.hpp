// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Dynamic parallel loop over host work of uneven size, with the worker's number for scratch
/// memory.

#include <atomic>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Workers that `for_each_dynamic` may use.
inline int n_workers() { return HostExec().concurrency(); }

/// Cheap loops over fewer items cost less than waking the threads for them.
constexpr Offset few_items = 4096;

/// body(worker, item) for every item in [0, n_items), in ascending order of start; worker <
/// n_workers(). Which worker takes an item depends on the run, so results must not depend on the
/// worker. `body` must not throw.
template <class Body>
void for_each_dynamic(const std::string& label, Offset n_items, const Body& body) {
    if (n_items == 1) return body(0, 0);
    std::atomic<Offset> next{0};
    auto* const counter = &next;
    Kokkos::parallel_for(
        label, Kokkos::RangePolicy<HostExec, Kokkos::Schedule<Kokkos::Static>>(0, n_workers()),
        [=](const int worker) {
            for (Offset item; (item = counter->fetch_add(1, std::memory_order_relaxed)) < n_items;)
                body(worker, item);
        });
    HostExec().fence();
}

}  // namespace connectivity
