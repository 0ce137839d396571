// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"

#include <cstdio>
#include <cstring>

namespace connectivity::capi {

namespace {
// Plain memory: nothing to construct, to destroy at the end of a thread, or to run out of.
thread_local char error_text[2048];
thread_local bool is_in_callback = false;
}  // namespace

const char* last_error() noexcept { return error_text; }

void clear_error() noexcept { error_text[0] = '\0'; }

// The text may be the one that conn_last_error() returned.
void set_error(const char* text) noexcept {
    const std::size_t length = strnlen(text, sizeof error_text - 1);
    std::memmove(error_text, text, length);
    error_text[length] = '\0';
}

CallbackScope::CallbackScope() noexcept { is_in_callback = true; }
CallbackScope::~CallbackScope() { is_in_callback = false; }
bool in_callback() noexcept { return is_in_callback; }

void require_no_callback() {
    if (is_in_callback)
        throw Error(Status::callback,
                    "called from a callback, which must not call the library but for "
                    "conn_set_error, conn_last_error, texts and versions");
}

conn_status record_error(Status status, const char* function, const char* text) noexcept {
    std::snprintf(error_text, sizeof error_text, "%s: %s", function, text);
    return static_cast<conn_status>(status);
}

std::mutex& call_mutex() {
    static auto* const leaked = new std::mutex;  // no destructor may run while other threads call
    return *leaked;
}

}  // namespace connectivity::capi
