// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"

#include <cstdio>

namespace connectivity::capi {

namespace {
// Plain memory: nothing to construct, to destroy at the end of a thread, or to run out of.
thread_local char error_text[2048];
}  // namespace

const char* last_error() noexcept { return error_text; }

void clear_error() noexcept { error_text[0] = '\0'; }

conn_status record_error(Status status, const char* function, const char* text) noexcept {
    std::snprintf(error_text, sizeof error_text, "%s: %s", function, text);
    return static_cast<conn_status>(status);
}

std::mutex& call_mutex() {
    static auto* const leaked = new std::mutex;  // no destructor may run while other threads call
    return *leaked;
}

}  // namespace connectivity::capi
