// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The one place where a C call enters C++: every exception becomes a status and a text.
///
/// Invariants: calls run one at a time; the last error belongs to the calling thread and is ""
/// after a success.

#include <exception>
#include <mutex>
#include <new>

#include <connectivity/base/error.hpp>
#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>

#include "connectivity.h"

namespace connectivity::capi {

/// What a thread keeps between calls. Plain memory: nothing to construct, to destroy at the end of
/// a thread, or to run out of.
struct ThreadState {
    char error[2048];
    bool is_in_callback;
};
ThreadState& this_thread() noexcept;

const char* last_error() noexcept;
void clear_error() noexcept;

/// Keeps "function: text" as the error of this thread and returns the status for C.
conn_status record_error(Status status, const char* function, const char* text) noexcept;

/// The error of this thread as the host words it; at most 2047 bytes are kept.
void set_error(const char* text) noexcept;

/// While one lives, this thread is inside a callback of the host, from which nothing that takes
/// the call mutex may be called: the call that waits for the callback holds it. Looks the thread up
/// once, which is most of its cost.
class CallbackScope {
public:
    CallbackScope() noexcept : thread_(this_thread()) { thread_.is_in_callback = true; }
    ~CallbackScope() { thread_.is_in_callback = false; }
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;

    void clear_error() noexcept { thread_.error[0] = '\0'; }

private:
    ThreadState& thread_;
};
bool in_callback() noexcept;

/// Throws Error{callback} inside a callback.
void require_no_callback();

/// Held by every call from start to end; also by a fork, so that no child sees an object half-way.
std::mutex& call_mutex();

/// Runs body() under the call mutex.
template <class Body>
conn_status guarded(const char* function, const Body& body) noexcept {
    clear_error();
    try {
        require_no_callback();
        const std::lock_guard lock(call_mutex());
        body();
        clear_error();  // a callback may have left one
        return CONN_OK;
    } catch (const Error& e) {
        return record_error(e.status(), function, e.what());
    } catch (const std::bad_alloc& e) {
        return record_error(Status::memory, function, e.what());
    } catch (const std::exception& e) {
        return record_error(Status::internal, function, e.what());
    } catch (...) {
        return record_error(Status::internal, function, "unknown exception");
    }
}

/// The same for bodies that need Kokkos alive: all but destroying and releasing.
template <class Body>
conn_status guarded_with_runtime(const char* function, const Body& body) noexcept {
    return guarded(function, [&] {
        shim::outside_parallel_region([&] {
            require_runtime();
            body();
        });
    });
}

}  // namespace connectivity::capi
