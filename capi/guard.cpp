// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"

#include <cstdio>
#include <cstring>

namespace connectivity::capi {

ThreadState& this_thread() noexcept {
    static thread_local ThreadState state;
    return state;
}

const char* last_error() noexcept { return this_thread().error; }

void clear_error() noexcept { this_thread().error[0] = '\0'; }

// The text may be the one that conn_last_error() returned.
void set_error(const char* text) noexcept {
    ThreadState& thread = this_thread();
    const std::size_t length = strnlen(text, sizeof thread.error - 1);
    std::memmove(thread.error, text, length);
    thread.error[length] = '\0';
}

bool in_callback() noexcept { return this_thread().is_in_callback; }

void require_no_callback() {
    if (in_callback())
        throw Error(Status::callback,
                    "called from a callback, which must not call the library but for "
                    "conn_set_error, conn_last_error, texts and versions");
}

conn_status record_error(Status status, const char* function, const char* text) noexcept {
    ThreadState& thread = this_thread();
    std::snprintf(thread.error, sizeof thread.error, "%s: %s", function, text);
    return static_cast<conn_status>(status);
}

std::mutex& call_mutex() {
    static auto* const leaked = new std::mutex;  // no destructor may run while other threads call
    return *leaked;
}

}  // namespace connectivity::capi
