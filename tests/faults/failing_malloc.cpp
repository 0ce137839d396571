// SPDX-License-Identifier: BSD-3-Clause
#include "failing_malloc.hpp"

#include <cerrno>
#include <cstdlib>

#include <gtest/gtest.h>

#if defined(_OPENMP)
#include <omp.h>
#endif

// Sanitizers bring a malloc of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAS_OTHER_MALLOC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HAS_OTHER_MALLOC
#endif
#endif

namespace connectivity::test {

long allocations_left = -1, allocated_bytes = 0;

namespace {

/// The OpenMP runtime ends the process where it lacks memory; one thread takes none.
class OneThread : public ::testing::Environment {
    void SetUp() override {
#if defined(_OPENMP)
        omp_set_num_threads(1);
#endif
    }
};
[[maybe_unused]] const auto* const one_thread = ::testing::AddGlobalTestEnvironment(new OneThread);

}  // namespace

#if defined(HAS_OTHER_MALLOC)
const bool can_fail = false;
#else
const bool can_fail = true;

namespace {

bool fails_now(std::size_t bytes) {
    allocated_bytes += static_cast<long>(bytes);
    if (allocations_left < 0 || allocations_left-- != 0) return false;
    errno = ENOMEM;
    return true;
}

}  // namespace
#endif

}  // namespace connectivity::test

#if !defined(HAS_OTHER_MALLOC)
using connectivity::test::fails_now;

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) { return fails_now(size) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) {
    return fails_now(n * size) ? nullptr : __libc_calloc(n, size);
}
void* realloc(void* old, std::size_t size) {
    return fails_now(size) ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return fails_now(size) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
    void* const found = fails_now(size) ? nullptr : __libc_memalign(alignment, size);
    if (found == nullptr) return ENOMEM;
    *out = found;
    return 0;
}
}
#endif
