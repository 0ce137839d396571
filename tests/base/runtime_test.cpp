// SPDX-License-Identifier: BSD-3-Clause
// Kokkos is started once, by whoever comes first, and serves every thread until it is stopped.

#include <thread>
#include <vector>

#include <connectivity/base/runtime.hpp>
#include <connectivity/base/spaces.hpp>

#include <support/expect_error.hpp>
#include <support/process.hpp>

#if defined(KOKKOS_ENABLE_OPENMP)
#include <omp.h>
#endif

namespace connectivity::test {
namespace {

/// Sum of 0 .. n-1 by a scan, the kernel that is most particular about its threads.
Offset sum_below(int n) {
    Offset total = 0;
    Kokkos::parallel_scan(
        "test/scan", Kokkos::RangePolicy<HostExec>(0, n),
        [](const int i, Offset& sum, const bool) { sum += i; }, total);
    return total;
}

TEST(Runtime, starting_twice_is_starting_once) {
    start_runtime();
    const int n_threads = runtime_threads();
    start_runtime({n_threads + 1, -1});
    EXPECT_TRUE(runtime_is_running());
    EXPECT_GE(n_threads, 1);
    EXPECT_EQ(runtime_threads(), n_threads);
    EXPECT_EQ(runtime_description().rfind("Kokkos ", 0), 0u);
}

TEST(Runtime, kernels_run_from_any_thread) {
    start_runtime();
    EXPECT_EQ(sum_below(1000), 499500);
    std::vector<Offset> sums(4);
    for (Offset& sum : sums)
        std::thread([&sum] {
            require_runtime();
            sum = sum_below(1000);
        }).join();
    EXPECT_EQ(sums, std::vector<Offset>(4, 499500));
}

// Each of these ends or starts Kokkos for good, so each runs in a process of its own.

TEST(RuntimeAlone, DISABLED_stop) {
    EXPECT_FALSE(runtime_is_running());
    EXPECT_EQ(runtime_threads(), 0);
    stop_runtime();  // nothing to stop
    start_runtime({2, -1});
    bool released = false;
    auto held = allocate<double>("test/held", 100);
    at_runtime_stop([&] {
        released = runtime_threads() == 0;  // no call may come in from here on
        held = {};
    });
    at_runtime_stop([] { throw Error(Status::internal, "a release that throws harms nobody"); });
    stop_runtime();
    EXPECT_TRUE(released);
    EXPECT_FALSE(runtime_is_running());
    EXPECT_TRUE(fails_with(Status::finalized, {"second time"}, [] { start_runtime(); }));
    EXPECT_TRUE(fails_with(Status::finalized, {}, [] { require_runtime(); }));
    stop_runtime();
}

TEST(RuntimeAlone, DISABLED_foreign) {
    Kokkos::initialize();
    start_runtime();
    stop_runtime();
    EXPECT_TRUE(Kokkos::is_initialized()) << "what the host started is the host's to stop";
    EXPECT_TRUE(runtime_is_running());
    Kokkos::finalize();
    EXPECT_TRUE(fails_with(Status::finalized, {}, [] { require_runtime(); }));
}

TEST(RuntimeAlone, DISABLED_threads) {
#if defined(KOKKOS_ENABLE_OPENMP)
    omp_set_num_threads(7);
    start_runtime({2, -1});
    EXPECT_EQ(runtime_threads(), 2);
    EXPECT_EQ(omp_get_max_threads(), 7) << "the host's own regions keep their threads";
#endif
}

TEST(RuntimeAlone, DISABLED_race) {
    std::vector<std::thread> threads(8);
    for (std::thread& thread : threads) thread = std::thread([] { start_runtime({2, -1}); });
    for (std::thread& thread : threads) thread.join();
    start_runtime();
    EXPECT_EQ(sum_below(100), 4950);
}

::testing::AssertionResult passes_alone(const std::string& test) {
    const RunResult run =
        run_this_test_program("RuntimeAlone.DISABLED_" + test, "GTEST_ALSO_RUN_DISABLED_TESTS=1");
    if (run.status == 0 && run.out.find("[  PASSED  ] 1 test") != std::string::npos)
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "exit status " << run.status << "\n" << run.out;
}

TEST(Runtime, stopping_releases_what_is_held_and_is_final) { EXPECT_TRUE(passes_alone("stop")); }
TEST(Runtime, what_the_host_started_is_not_stopped) { EXPECT_TRUE(passes_alone("foreign")); }
TEST(Runtime, the_threads_of_the_host_are_not_touched) { EXPECT_TRUE(passes_alone("threads")); }
TEST(Runtime, threads_that_start_it_at_once_agree) { EXPECT_TRUE(passes_alone("race")); }

}  // namespace
}  // namespace connectivity::test
