// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The life of Kokkos inside the library: started lazily, never stopped behind the host's back.
///
/// Invariants: nothing runs in static initialisers and no View has static storage. Kokkos can be
/// started once in a process; after it was finalised every call ends in Error{finalized}. Whoever
/// started Kokkos owns it.

#include <functional>
#include <new>
#include <string>
#include <vector>

#include <connectivity/base/error.hpp>
#include <connectivity/base/kokkos_shim.hpp>

namespace connectivity {

struct RuntimeOptions {
    int n_threads = 0;   ///< 0: what Kokkos chooses (OMP_NUM_THREADS, all cores)
    int device_id = -1;  ///< -1: what Kokkos chooses
};

/// Starts Kokkos if nobody did. Safe from several threads. Options count only for the call that
/// starts it. Throws Error{finalized}, Error{forked}.
void start_runtime(const RuntimeOptions& options = {});

/// Throws Error{finalized} or Error{forked} if kernels cannot run any more.
void require_runtime();

/// Finalises Kokkos if this library started it; otherwise does nothing.
void stop_runtime();

bool runtime_is_running();

/// Number of host threads that kernels use (0 before the start).
int runtime_threads();

/// Runs body() where Kokkos may launch kernels, started if need be, also for a caller inside an
/// OpenMP region or on a thread of its own. Throws what body does, Error{memory} for
/// std::bad_alloc.
template <class Body>
void run_kernels(const std::string& what, const Body& body) {
    shim::outside_parallel_region([&] {
        start_runtime();
        try {
            body();
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, what + ": out of memory");
        }
    });
}

/// Called right before Kokkos is finalised, by whomever; lets go of every View a registry still
/// holds.
void at_runtime_stop(std::function<void()> release);

/// "Kokkos 4.6.1 OpenMP Serial" and the like.
std::string runtime_description();

/// Kokkos's execution spaces by name, those of devices first.
std::vector<std::string> runtime_backends();

/// Whether one of them runs on what is no host.
bool runtime_has_device();

}  // namespace connectivity
