// SPDX-License-Identifier: BSD-3-Clause
#include "registry.hpp"

#include <pthread.h>

#include "guard.hpp"

namespace connectivity::capi {

namespace {
// A fork inside a callback: the call that waits for it holds the mutex already.
void lock_calls() {
    if (!in_callback()) call_mutex().lock();
}
void unlock_calls() {
    if (!in_callback()) call_mutex().unlock();
}

bool is_forked() {
    try {
        require_runtime();
        return false;
    } catch (const Error& e) {
        return e.status() == Status::forked;
    }
}
}  // namespace

Registry& Registry::instance() {
    static auto* const leaked = new Registry;  // Views must not be destroyed at exit, after Kokkos
    return *leaked;
}

void Registry::watch_runtime() {
    if (is_watching_) return;
    if (pthread_atfork(lock_calls, unlock_calls, unlock_calls) != 0)
        throw Error(Status::memory, "no memory for the fork handlers");
    at_runtime_stop([] {
        const std::lock_guard lock(call_mutex());
        instance().drop_all();
    });
    is_watching_ = true;
}

Handle* Registry::find(const void* pointer, const std::string& name) const {
    const auto found = live_.find(pointer);
    if (found != live_.end()) return found->second.get();
    throw Error(Status::handle,
                name + " is not a live handle: destroyed, or never made by this library");
}

// Kokkos destroys elements of Views in a kernel, which has no threads to run in after a fork: there
// the memory is left to the end of the process.
void Registry::remove(const void* pointer) {
    const auto found = live_.find(pointer);
    if (is_forked()) static_cast<void>(found->second.release());
    live_.erase(found);
}

void Registry::drop_all() noexcept {
    for (auto& [pointer, object] : live_) object->drop_views();
}

}  // namespace connectivity::capi
