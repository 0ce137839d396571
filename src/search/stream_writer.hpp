// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A sequential writer of slots that passes the caches: whole lines go straight to memory.
///
/// A list is larger than any cache and read later; plain stores would first read every line they
/// overwrite. The destination is filled from low to high; `finish` writes what is left.

#include <cstdint>
#include <cstring>

#include <connectivity/base/types.hpp>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace connectivity::detail {

class StreamWriter {
public:
    explicit StreamWriter(Slot* to) : to_(to) {}
    StreamWriter(const StreamWriter&) = delete;
    StreamWriter& operator=(const StreamWriter&) = delete;

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
    static constexpr Offset line = 16, capacity = 256 * line;

    void flush() {
        if (filled_ == 0) return;  // without values there is no place to write to
        Offset k = 0;
#if defined(__SSE2__)
        while (k < filled_ && reinterpret_cast<std::uintptr_t>(to_ + k) % 64 != 0)
            to_[k] = buffer_[k], ++k;
        for (; k + line <= filled_; k += line)
            for (Offset part = k; part < k + line; part += 4)
                _mm_stream_si128(reinterpret_cast<__m128i*>(to_ + part),
                                 _mm_loadu_si128(reinterpret_cast<const __m128i*>(buffer_ + part)));
#endif
        std::memcpy(to_ + k, buffer_ + k, static_cast<std::size_t>(filled_ - k) * sizeof(Slot));
        to_ += filled_;
        filled_ = 0;
    }

    Slot* to_;
    Offset filled_ = 0;
    alignas(64) Slot buffer_[capacity];
};

}  // namespace connectivity::detail
