// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What goes around every call that changes a map: its line in the log, and the high-water mark of
/// its memory.

#include <exception>

#include <connectivity/base/report.hpp>

#include "objects.hpp"

namespace connectivity::capi {

/// Bytes the map holds now, without what only views of older generations hold.
Offset held_bytes(const conn_map& map);

/// Bytes that views of older generations hold.
Offset pinned_bytes(const conn_map& map);

/// Bytes the map and views of it hold; sees to the high-water mark. Throws std::bad_alloc.
Offset memory_now(const conn_map& map);

/// Sees to the high-water mark if there is memory to count with; call it wherever memory may have
/// grown, when nothing may fail any more.
void note_memory(const conn_map& map) noexcept;

/// The same after a view was acquired, at a cost that does not depend on how many there are.
void note_acquired(const conn_map& map) noexcept;

/// Lines about a piece of work that failed, or succeeded. That there is no memory for a line says
/// nothing about the work, so they are then left out.
void log_failure(const conn_map& map, const char* work, const char* text) noexcept;
void note_success(const conn_map& map, const char* work, double ms) noexcept;

/// Runs body() as a piece of work on the map.
template <class Body>
void work_on(const conn_map& map, const char* work, const Body& body) {
    const Stopwatch watch;
    try {
        body();
    } catch (const std::exception& e) {
        log_failure(map, work, e.what());
        throw;
    }
    note_success(map, work, watch.ms());
}

}  // namespace connectivity::capi
