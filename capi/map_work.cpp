// SPDX-License-Identifier: BSD-3-Clause
#include "map_work.hpp"

#include <cstdio>
#include <set>

namespace connectivity::capi {

namespace {

std::string name_of(const conn_map& map, const char* work) {
    return "map " + std::to_string(map.number) + ": " + work + ": ";
}

std::string decimals(double ms) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f ms", ms);
    return text;
}

void log_entries(const conn_map& map, const char* work) {
    for (const ReportEntry& entry : map.map->report().entries())
        if (entry.built)
            map.log->write(CONN_LOG_DEBUG, name_of(map, work) + entry.product + ": asked by " +
                                               entry.asked_by + ", " + entry.reason + ", " +
                                               std::to_string(entry.bytes) + " bytes, " +
                                               decimals(entry.ms));
}

void log_success(const conn_map& map, const char* work, double ms) {
    const ConnectivityMap& ours = *map.map;
    const bool is_built = ours.generation() > 0;
    const auto number = [](std::int64_t n, const char* what) {
        return std::to_string(n) + " " + what + ", ";
    };
    map.log->write(
        CONN_LOG_INFO,
        name_of(map, work) + "generation " + std::to_string(ours.generation()) + ", " +
            number(ours.layout().n_lists(), "lists") + number(ours.layout().n_slots(), "slots") +
            number(ours.layout().n_rows(), "rows") +
            number(is_built && ours.options().rows ? ours.rows().size() : 0, "entries") +
            number(is_built && ours.options().wants_pairs() ? ours.pairs().size() : 0, "pairs") +
            number(held_bytes(map), "bytes") + decimals(ms));
    if (map.log->wants(CONN_LOG_DEBUG)) log_entries(map, work);
}

}  // namespace

Offset held_bytes(const conn_map& map) {
    if (!map.map) return 0;
    Offset bytes = map.map->report().total_bytes() + map.row_pairs.bytes() + map.based.bytes() +
                   static_cast<Offset>(map.options.active.size());
    const ReportEntry* const pairs = map.map->report().find("pairs");
    // Coupling and expanded i come after the report of the rebuild.
    if (map.map->generation() > 0 && map.map->options().wants_pairs() && pairs != nullptr)
        bytes += map.map->pairs().bytes() - pairs->bytes;
    return bytes;
}

Offset pinned_bytes(const conn_map& map) {
    std::set<const void*> counted;  // several views may hold an array
    Offset bytes = 0;
    for (const ViewPin* const pin : ViewPin::live()) {
        // Views of the present generation hold the map's own arrays.
        const bool is_current = map.map && pin->generation == map.map->generation();
        if (pin->map_number != map.number || is_current) continue;
        pin->for_each_array([&](const void* data, std::size_t size) {
            if (data != nullptr && counted.insert(data).second) bytes += static_cast<Offset>(size);
        });
    }
    return bytes;
}

Offset memory_now(const conn_map& map) {
    const Offset held = held_bytes(map), bytes = held + pinned_bytes(map);
    map.held_when_noted = held;
    map.high_water = std::max(map.high_water, bytes);
    return bytes;
}

void note_memory(const conn_map& map) noexcept {
    try {
        memory_now(map);
    } catch (...) {  // counted next time
    }
}

// Views of old lists become fewer until the next rebuild or patch, which is noted: unless the map
// itself holds more, no more than was noted is held.
void note_acquired(const conn_map& map) noexcept try {
    if (held_bytes(map) > map.held_when_noted) memory_now(map);
} catch (...) {  // counted next time
}

void log_failure(const conn_map& map, const char* work, const char* text) noexcept try {
    if (map.log->wants(CONN_LOG_ERROR)) map.log->write(CONN_LOG_ERROR, name_of(map, work) + text);
} catch (...) {
}

void note_success(const conn_map& map, const char* work, double ms) noexcept try {
    note_memory(map);
    if (map.log->wants(CONN_LOG_INFO)) log_success(map, work, ms);
} catch (...) {
}

}  // namespace connectivity::capi
