// SPDX-License-Identifier: BSD-3-Clause
#include "failing_malloc.hpp"

#include <cerrno>
#include <cstdlib>

#include <gtest/gtest.h>
#include <omp.h>

namespace connectivity::test {

long allocations_left = -1;

namespace {

/// The OpenMP runtime ends the process where it lacks memory; one thread takes none.
class OneThread : public ::testing::Environment {
    void SetUp() override { omp_set_num_threads(1); }
};
[[maybe_unused]] const auto* const one_thread = ::testing::AddGlobalTestEnvironment(new OneThread);

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
const bool can_fail = false;
#else
const bool can_fail = true;

namespace {

bool fails_now() {
    if (allocations_left < 0 || allocations_left-- != 0) return false;
    errno = ENOMEM;
    return true;
}

}  // namespace
#endif

}  // namespace connectivity::test

#if !defined(__SANITIZE_ADDRESS__)
using connectivity::test::fails_now;

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) { return fails_now() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) {
    return fails_now() ? nullptr : __libc_calloc(n, size);
}
void* realloc(void* old, std::size_t size) {
    return fails_now() ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return fails_now() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
    void* const found = fails_now() ? nullptr : __libc_memalign(alignment, size);
    if (found == nullptr) return ENOMEM;
    *out = found;
    return 0;
}
}
#endif
