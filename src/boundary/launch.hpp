// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where kernels of this layer may start.

#include <new>
#include <string>

#include <connectivity/base/error.hpp>
#include <connectivity/base/kokkos_shim.hpp>
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

}  // namespace connectivity::detail
