// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Arguments that are no structs: names, arrays with a count, buffers for results.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include <connectivity/base/error.hpp>

#include "index_base.hpp"

namespace connectivity::capi {

/// Handles in one call: node lists, fields.
constexpr std::int32_t max_handles = 65536;

/// 1 to 255 bytes. Throws Error{null}, Error{argument}.
inline std::string read_name(const char* name) {
    constexpr std::size_t max_name = 255;
    if (name == nullptr) throw Error(Status::null, "name is NULL");
    const std::size_t length = strnlen(name, max_name + 1);
    if (length == 0 || length > max_name)
        throw Error(Status::argument, "name has " + std::string(length == 0 ? "no" : "too many") +
                                          " bytes, must have 1 to " + std::to_string(max_name));
    return {name, length};
}

/// Throws Error{argument} unless 0 <= n <= limit, Error{null} for n > 0 values that are nowhere.
inline void check_count(const void* data, std::int64_t n, std::int64_t limit,
                        const std::string& name, const std::string& count) {
    if (n < 0 || n > limit)
        throw Error(Status::argument, count + " = " + std::to_string(n) + ", must be in [0, " +
                                          std::to_string(limit) + "]");
    if (n > 0 && data == nullptr)
        throw Error(Status::null, name + " is NULL, but " + count + " = " + std::to_string(n));
}

template <class T>
T& required(T* pointer, const std::string& name) {
    if (pointer == nullptr) throw Error(Status::null, name + " is NULL");
    return *pointer;
}

inline void check_capacity(std::int64_t capacity, std::int64_t needed,
                           const std::string& name = "capacity") {
    if (capacity < needed)
        throw Error(Status::buffer, name + " = " + std::to_string(capacity) +
                                        ", must be at least " + std::to_string(needed));
}

/// Results for a buffer of the host, which asks with NULL for their number first: *count is set
/// even where the buffer is too small.
template <class Values, class T>
void copy_out(const Values& values, T* buffer, std::int64_t capacity, std::int64_t* count) {
    const auto n = static_cast<std::int64_t>(values.size());
    required(count, "count") = n;
    if (buffer == nullptr) return;
    check_capacity(capacity, n);
    std::copy_n(values.data(), n, buffer);
}

/// The same for numbers of nodes.
template <class Values>
void copy_nodes_out(const Values& values, IndexBase base, Slot* buffer, std::int64_t capacity,
                    std::int64_t* count) {
    copy_out(values, buffer, capacity, count);
    if (buffer != nullptr) base.copy_out(buffer, *count, buffer);
}

}  // namespace connectivity::capi
