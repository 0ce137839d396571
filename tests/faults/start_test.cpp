// SPDX-License-Identifier: BSD-3-Clause
// The start of the library while an allocation fails: one start a process, so each in a child.

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include "connectivity.h"
#include "failing_malloc.hpp"

namespace connectivity::test {
namespace {

enum Outcome { refused = 10, enough = 11, wrong = 12, refused_by_kokkos = 13 };

Outcome start_without_allocation(long k) {
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.n_threads = 1;
    conn_context* context = nullptr;
    allocations_left = k;
    const conn_status status = conn_context_create(&options, &context);
    const bool is_enough = allocations_left >= 0;
    allocations_left = -1;
    if (status == CONN_OK) return is_enough ? enough : wrong;
    if (context != nullptr) return wrong;
    // Kokkos has an error of its own for lack of memory, which cannot be told from its others.
    if (status == CONN_E_INTERNAL) return refused_by_kokkos;
    if (status != CONN_E_MEMORY) return wrong;
    return conn_context_create(&options, &context) == CONN_OK ? refused : wrong;
}

int exit_status_of_child(long k) {
    const pid_t child = fork();
    if (child == 0) _exit(start_without_allocation(k));
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StartWithoutMemory, is_refused_and_works_later) {
    if (!can_fail) GTEST_SKIP() << "the sanitizer has a malloc of its own";
    if (runtime_is_running()) GTEST_SKIP() << "the library runs already: run this test alone";
    int n_refused = 0, n_others = 0;
    for (long k = 0; k < 100000; ++k) {
        const int outcome = exit_status_of_child(k);
        ASSERT_NE(outcome, wrong) << "allocation " << k;
        if (outcome == enough) break;
        ++(outcome == refused ? n_refused : n_others);
    }
    // Where Kokkos and the OpenMP runtime make their threads they end the process themselves.
    EXPECT_GT(n_refused, 20);
    EXPECT_GT(n_refused, 9 * n_others);
}

}  // namespace
}  // namespace connectivity::test
