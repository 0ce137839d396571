// SPDX-License-Identifier: BSD-3-Clause
#include "memory_speed.hpp"

#include <algorithm>
#include <chrono>
#include <new>

#include <sys/mman.h>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <connectivity/base/parallel.hpp>
#include <connectivity/base/runtime.hpp>

namespace connectivity::bench {
namespace {

constexpr std::size_t n_bytes = std::size_t{128} << 20, chunk = std::size_t{1} << 20;

/// Memory of the system that nobody has touched.
class NewMemory {
public:
    explicit NewMemory(bool large_pages) {
        bytes_ = mmap(nullptr, n_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (bytes_ == MAP_FAILED) throw std::bad_alloc();
        if (large_pages) madvise(bytes_, n_bytes, MADV_HUGEPAGE);
    }
    ~NewMemory() { munmap(bytes_, n_bytes); }
    NewMemory(const NewMemory&) = delete;
    NewMemory& operator=(const NewMemory&) = delete;
    char* data() const { return static_cast<char*>(bytes_); }

private:
    void* bytes_;
};

void fill(char* to, int value) {
#if defined(__SSE2__)
    const __m128i values = _mm_set1_epi32(value);
    for (std::size_t k = 0; k < chunk; k += 16)
        _mm_stream_si128(reinterpret_cast<__m128i*>(to + k), values);
    _mm_sfence();
#else
    std::fill_n(reinterpret_cast<volatile int*>(to), chunk / sizeof(int), value);
#endif
}

double fill_all_seconds(char* memory, int value) {
    const auto start = std::chrono::steady_clock::now();
    for_each_dynamic("bench/stores", static_cast<Offset>(n_bytes / chunk), [=](int, Offset k) {
        fill(memory + static_cast<std::size_t>(k) * chunk, value);
    });
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

MemorySpeed measure_memory_speed() {
    start_runtime();
    constexpr auto size = static_cast<double>(n_bytes);
    MemorySpeed speed;
    speed.touch = size / fill_all_seconds(NewMemory(false).data(), 1);
    const NewMemory memory(true);
    speed.touch_large = size / fill_all_seconds(memory.data(), 1);
    for (int k = 0; k < 5; ++k)
        speed.store = std::max(speed.store, size / fill_all_seconds(memory.data(), k));
    return speed;
}

}  // namespace connectivity::bench
