// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where kernels of this layer may start, and loops that stay serial while they are small.

#include <new>
#include <string>

#include <connectivity/base/error.hpp>
#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/parallel.hpp>
#include <connectivity/base/runtime.hpp>

namespace connectivity::detail {

/// Runs body() where Kokkos may launch kernels, also for a caller inside an OpenMP region. Says who
/// ran out of memory.
template <class Body>
void launch(const char* what, const Body& body) {
    shim::outside_parallel_region([&] {
        start_runtime();
        try {
            body();
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, std::string(what) + ": out of memory");
        }
    });
}

/// body(k) for k in [0, n), in parallel where that pays.
template <class Body>
void for_each_item(const char* label, Offset n, const Body& body) {
    if (n <= few_items) {
        for (Offset k = 0; k < n; ++k) body(k);
        return;
    }
    Kokkos::parallel_for(label, Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         body);
    HostExec().fence();
}

}  // namespace connectivity::detail
