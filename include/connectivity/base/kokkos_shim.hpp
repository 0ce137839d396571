// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where Kokkos 3.4 to 5.x differ, said once. Nothing else in the library asks for the version.
///
/// Before 3.7 there is no `is_finalized`, initialisation takes another struct, and the OpenMP
/// backend serves only the thread that started it: it finds its threads through a thread-local
/// pointer. `adopt_thread` lends it to others.

#include <exception>
#include <string>
#include <thread>

#include <Kokkos_Core.hpp>

#if defined(KOKKOS_ENABLE_OPENMP)
#include <omp.h>
#endif

namespace connectivity::shim {

inline bool kokkos_is_finalized() {
#if KOKKOS_VERSION >= 30700
    return Kokkos::is_finalized();
#else
    return false;  // the finalize hook is the only witness
#endif
}

inline void kokkos_initialize(int n_threads, int device_id) {
#if KOKKOS_VERSION >= 30700
    Kokkos::InitializationSettings settings;
    if (n_threads > 0) settings.set_num_threads(n_threads);
    if (device_id >= 0) settings.set_device_id(device_id);
    settings.set_disable_warnings(true);
#else
    Kokkos::InitArguments settings;
    if (n_threads > 0) settings.num_threads = n_threads;
    if (device_id >= 0) settings.device_id = device_id;
    settings.disable_warnings = true;
#endif
    Kokkos::initialize(settings);
}

/// What the OpenMP backend keeps for the thread that started it; opaque, nullptr where a Kokkos
/// needs no help.
using ThreadPool = void*;

inline ThreadPool pool_of_this_thread() {
#if defined(KOKKOS_ENABLE_OPENMP) && KOKKOS_VERSION < 30700
    return Kokkos::Impl::t_openmp_instance;
#else
    return nullptr;
#endif
}

/// Lets the calling thread launch kernels on the pool. Kernels of different threads must not
/// overlap.
inline void adopt_thread([[maybe_unused]] ThreadPool pool) {
#if defined(KOKKOS_ENABLE_OPENMP) && KOKKOS_VERSION < 30700
    if (Kokkos::Impl::t_openmp_instance == nullptr)
        Kokkos::Impl::t_openmp_instance = static_cast<Kokkos::Impl::OpenMPExec*>(pool);
#endif
}

inline bool inside_parallel_region() {
#if defined(KOKKOS_ENABLE_OPENMP)
    return omp_get_level() > 0;
#else
    return false;
#endif
}

/// Runs body() where Kokkos may start, stop and scan: inside a parallel region of the host that is
/// a thread of its own.
template <class Body>
void outside_parallel_region(const Body& body) {
    if (!inside_parallel_region()) return body();
    std::exception_ptr failure;
    std::thread([&] {
        try {
            body();
        } catch (...) {
            failure = std::current_exception();
        }
    }).join();
    if (failure) std::rethrow_exception(failure);
}

/// Keeps the number of threads that the host's own OpenMP regions use; Kokkos sets it when it
/// starts.
class KeepOpenMPThreads {
public:
#if defined(KOKKOS_ENABLE_OPENMP)
    KeepOpenMPThreads() : n_threads_(omp_get_max_threads()) {}
    ~KeepOpenMPThreads() { omp_set_num_threads(n_threads_); }

private:
    int n_threads_;
#else
    KeepOpenMPThreads() {}
#endif
    KeepOpenMPThreads(const KeepOpenMPThreads&) = delete;
    KeepOpenMPThreads& operator=(const KeepOpenMPThreads&) = delete;
};

/// A named stretch of time for profilers: "map/rebuild".
class ProfilingRegion {
public:
    explicit ProfilingRegion(const std::string& name) { Kokkos::Profiling::pushRegion(name); }
    ~ProfilingRegion() { Kokkos::Profiling::popRegion(); }

private:
    ProfilingRegion(const ProfilingRegion&) = delete;
    ProfilingRegion& operator=(const ProfilingRegion&) = delete;
};

}  // namespace connectivity::shim
