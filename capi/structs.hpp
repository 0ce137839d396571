// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Structs that cross the boundary. They begin with their size and grow at the end only, so a host
/// compiled against an older or newer header is served: missing members keep our defaults, unknown
/// ones must be zero.

#include <cstddef>
#include <cstring>
#include <string>

#include <connectivity/base/error.hpp>

#include "connectivity_boundary.h"

namespace connectivity::capi {

/// Bytes up to the last member of the first released layout: hosts with less than that never
/// existed.
template <class T>
extern const std::size_t first_size;
#define CONNECTIVITY_FIRST_LAYOUT(Struct, last_member) \
    template <>                                        \
    inline constexpr std::size_t first_size<Struct> =  \
        offsetof(Struct, last_member) + sizeof(Struct::last_member)

CONNECTIVITY_FIRST_LAYOUT(conn_context_options, budget_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_map_options, budget_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_estimate, relative_error);
CONNECTIVITY_FIRST_LAYOUT(conn_map_info, n_report_counters);
CONNECTIVITY_FIRST_LAYOUT(conn_rows_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_pairs_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_intersection_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_boundary_nodes, global_id);
CONNECTIVITY_FIRST_LAYOUT(conn_report_entry, reused);

/// Larger than any struct will ever be; a size beyond it is garbage.
constexpr std::size_t largest_struct_size = 4096;

/// Throws Error{struct_size} or, if bytes this library does not know are in use,
/// Error{unsupported}.
inline void check_struct(const void* given, std::size_t size, std::size_t least, std::size_t known,
                         const char* name) {
    if (size < least || size > largest_struct_size)
        throw Error(Status::struct_size,
                    std::string(name) + "->struct_size = " + std::to_string(size) +
                        ", must be in [" + std::to_string(least) + ", " +
                        std::to_string(largest_struct_size) + "]: set it to sizeof *" + name);
    for (std::size_t b = known; b < size; ++b)
        if (static_cast<const unsigned char*>(given)[b] != 0)
            throw Error(Status::unsupported, std::string(name) + ": byte " + std::to_string(b) +
                                                 " is set, but this library knows only the first " +
                                                 std::to_string(known) + " of the struct");
}

/// Copy of the host's struct over our defaults; its struct_size stays the host's.
template <class T>
T read_struct(const T* given, const T& defaults, const char* name) {
    if (given == nullptr) throw Error(Status::null, std::string(name) + " is NULL");
    std::size_t size = 0;
    std::memcpy(&size, given, sizeof size);
    check_struct(given, size, first_size<T>, sizeof(T), name);
    T ours = defaults;
    std::memcpy(&ours, given, size < sizeof(T) ? size : sizeof(T));
    return ours;
}

/// Writes as much as the host's struct has room for and keeps its struct_size.
template <class T>
void write_struct(T* given, T ours, std::size_t size) {
    ours.struct_size = size;
    std::memcpy(given, &ours, size < sizeof(T) ? size : sizeof(T));
}

/// The body of conn_*_options_init.
template <class T>
void init_struct(T* given, std::size_t size, const T& defaults, const char* name) {
    if (given == nullptr) throw Error(Status::null, std::string(name) + " is NULL");
    check_struct(given, size, first_size<T>, size, name);
    std::memset(given, 0, size);
    write_struct(given, defaults, size);
}

/// 0 or 1. Throws Error{argument}.
inline bool read_flag(std::int32_t value, const std::string& name) {
    if (value == 0 || value == 1) return value == 1;
    throw Error(Status::argument, name + " = " + std::to_string(value) + ", must be 0 or 1");
}

/// A member of the options whose enumerators begin at `first`, ours at 0. Throws Error{argument}.
template <class Enum>
Enum read_choice(std::int32_t value, std::int32_t first, std::int32_t last,
                 const std::string& name) {
    if (value < first || value > last)
        throw Error(Status::argument, "options->" + name + " = " + std::to_string(value) +
                                          ", must be in [" + std::to_string(first) + ", " +
                                          std::to_string(last) + "]");
    return static_cast<Enum>(value - first);
}

}  // namespace connectivity::capi
