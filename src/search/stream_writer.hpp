// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Writing slots past the caches: whole lines go straight to memory.
///
/// A list is larger than any cache and read later; plain stores would first read every line they
/// overwrite.

#include <cstdint>
#include <cstring>

#include <connectivity/base/types.hpp>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace connectivity::detail {

constexpr Offset slots_per_line = 16;

/// Copies n slots; the whole lines of `to` pass the caches.
inline void stream_copy(Slot* to, const Slot* from, Offset n) {
    Offset k = 0;
#if defined(__SSE2__)
    while (k < n && reinterpret_cast<std::uintptr_t>(to + k) % 64 != 0) to[k] = from[k], ++k;
    for (; k + slots_per_line <= n; k += slots_per_line)
        for (Offset part = k; part < k + slots_per_line; part += 4)
            _mm_stream_si128(reinterpret_cast<__m128i*>(to + part),
                             _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + part)));
#endif
    if (k < n) std::memcpy(to + k, from + k, static_cast<std::size_t>(n - k) * sizeof(Slot));
}

/// A sequential writer; the destination is filled from low to high, `finish` writes what is left.
class StreamWriter {
public:
    explicit StreamWriter(bool past_caches) : past_caches_(past_caches) {}
    StreamWriter(const StreamWriter&) = delete;
    StreamWriter& operator=(const StreamWriter&) = delete;

    void start(Slot* to) { to_ = to; }
    bool started() const { return to_ != nullptr; }

    void append(const Slot* from, Offset n) {
        while (n > 0) {
            const Offset part = n < capacity - filled_ ? n : capacity - filled_;
            std::memcpy(buffer_ + filled_, from, static_cast<std::size_t>(part) * sizeof(Slot));
            filled_ += part, from += part, n -= part;
            if (filled_ == capacity) flush();
        }
    }

    void finish() {
        flush();
#if defined(__SSE2__)
        _mm_sfence();
#endif
    }

private:
    static constexpr Offset capacity = 64 * slots_per_line;

    void flush() {
        if (filled_ == 0) return;  // without values there is no place to write to
        if (past_caches_)
            stream_copy(to_, buffer_, filled_);
        else
            std::memcpy(to_, buffer_, static_cast<std::size_t>(filled_) * sizeof(Slot));
        to_ += filled_;
        filled_ = 0;
    }

    Slot* to_ = nullptr;
    const bool past_caches_;
    Offset filled_ = 0;
    alignas(64) Slot buffer_[capacity];
};

}  // namespace connectivity::detail
