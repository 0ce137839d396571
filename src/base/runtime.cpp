// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/runtime.hpp>

#include <atomic>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include <pthread.h>

#include <connectivity/base/error.hpp>
#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/spaces.hpp>

namespace connectivity {

namespace {

enum class Phase { untouched, starting, running, finalized };

// Atomics with constant initialisers: no code of ours runs before main or after exit.
std::atomic<Phase> phase{Phase::untouched};
std::atomic<bool> is_forked{false};
std::atomic<int> n_threads_running{0};
std::atomic<shim::ThreadPool> pool{nullptr};

struct Record {
    std::mutex mutex;
    bool is_owned = false;
    std::vector<std::function<void()>> releases;
};

// Leaked on purpose: other threads may still be inside the library when the process exits.
Record& record() {
    static auto* const leaked = new Record;
    return *leaked;
}

// Threads do not survive a fork, so a kernel in the child would wait for them for ever.
void mark_child() {
    const Phase now = phase;
    if (now == Phase::starting || (now == Phase::running && n_threads_running > 1))
        is_forked = true;
}

// Kokkos ends the process if a hook throws, hence the empty handler.
void before_finalize() {
    phase = Phase::finalized;
    std::vector<std::function<void()>> releases;
    {
        const std::lock_guard lock(record().mutex);
        releases.swap(record().releases);
    }
    for (const auto& release : releases) {
        try {
            release();
        } catch (...) {
        }
    }
}

/// Kokkos' thread pool has room for so many, and does not check.
constexpr int most_threads = 512;

void check_threads(int n_threads) {
    if (n_threads >= 0 && n_threads <= most_threads) return;
    throw Error(Status::argument, "start_runtime: " + std::to_string(n_threads) +
                                      " threads, must be in [0, " + std::to_string(most_threads) +
                                      "]; 0 means automatic");
}

int default_threads() {
#if defined(KOKKOS_ENABLE_OPENMP)
    return omp_get_max_threads() > most_threads ? most_threads : 0;
#else
    return 0;
#endif
}

void start_kokkos(const RuntimeOptions& options) {
    const int n_threads = options.n_threads > 0 ? options.n_threads : default_threads();
    const bool is_ours = !Kokkos::is_initialized();
    if (is_ours) {
        const shim::KeepOpenMPThreads keep;
        shim::outside_parallel_region([&] {
            shim::kokkos_initialize(n_threads, options.device_id);
            pool = shim::pool_of_this_thread();
        });
    } else {
        pool = shim::pool_of_this_thread();
    }
    record().is_owned = is_ours;
    n_threads_running = HostExec().concurrency();
    Kokkos::push_finalize_hook(before_finalize);
}

}  // namespace

void start_runtime(const RuntimeOptions& options) {
    require_runtime();
    if (phase == Phase::running) return;
    const std::lock_guard lock(record().mutex);
    require_runtime();  // another thread may have been faster
    if (phase == Phase::running) return;
    check_threads(options.n_threads);
    static const int registered = pthread_atfork(nullptr, nullptr, mark_child);
    if (registered != 0)
        throw Error(Status::memory, "start_runtime: no memory for the fork handler");
    phase = Phase::starting;
    try {
        start_kokkos(options);
    } catch (const std::bad_alloc&) {
        phase = Phase::untouched;
        throw Error(Status::memory, "start_runtime: no memory for Kokkos to start");
    } catch (const std::exception& e) {
        phase = Phase::untouched;
        throw Error(Status::internal,
                    std::string("start_runtime: Kokkos did not start: ") + e.what());
    }
    phase = Phase::running;
    shim::adopt_thread(pool);
}

void require_runtime() {
    if (is_forked)
        throw Error(
            Status::forked,
            "this process was forked after the library had started " +
                std::to_string(n_threads_running) +
                " threads, which the child does not have; start the library after the fork, "
                "or with one thread");
    if (phase == Phase::finalized || shim::kokkos_is_finalized())
        throw Error(Status::finalized,
                    "Kokkos was finalised in this process and cannot be started a second time");
    if (phase == Phase::running) shim::adopt_thread(pool);
}

void stop_runtime() {
    if (phase != Phase::running) return;
    require_runtime();
    {
        const std::lock_guard lock(record().mutex);
        if (!std::exchange(record().is_owned, false)) return;
    }
    shim::outside_parallel_region([] {
        shim::adopt_thread(pool);
        Kokkos::finalize();
    });
}

bool runtime_is_running() {
    return phase == Phase::running && !is_forked && !shim::kokkos_is_finalized();
}

int runtime_threads() { return runtime_is_running() ? n_threads_running.load() : 0; }

void at_runtime_stop(std::function<void()> release) {
    const std::lock_guard lock(record().mutex);
    record().releases.push_back(std::move(release));
}

bool runtime_has_device() {
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(KOKKOS_ENABLE_SYCL)
    return true;
#else
    return false;
#endif
}

std::vector<std::string> runtime_backends() {
    std::vector<std::string> names;
#if defined(KOKKOS_ENABLE_CUDA)
    names.push_back("Cuda");
#endif
#if defined(KOKKOS_ENABLE_HIP)
    names.push_back("HIP");
#endif
#if defined(KOKKOS_ENABLE_SYCL)
    names.push_back("SYCL");
#endif
#if defined(KOKKOS_ENABLE_OPENMP)
    names.push_back("OpenMP");
#endif
#if defined(KOKKOS_ENABLE_THREADS)
    names.push_back("Threads");
#endif
#if defined(KOKKOS_ENABLE_SERIAL)
    names.push_back("Serial");
#endif
    return names;
}

std::string runtime_description() {
    std::string text = "Kokkos " + std::to_string(KOKKOS_VERSION / 10000) + "." +
                       std::to_string(KOKKOS_VERSION / 100 % 100) + "." +
                       std::to_string(KOKKOS_VERSION % 100);
    for (const std::string& name : runtime_backends()) text += " " + name;
    return text;
}

}  // namespace connectivity
