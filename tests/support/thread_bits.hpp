// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The same bits with any number of threads. Their number is fixed for a process, so a test prints
/// the fingerprint of its results, and another one runs it with one, two and three threads.

#include <cstdint>
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include "support/process.hpp"

namespace connectivity::test {

inline void print_fingerprint(std::uint64_t value) {
    std::cout << "\nfingerprint: " << runtime_threads() << " threads " << std::hex << value
              << std::endl;
}

/// What the named test of this program prints, run with so many threads.
inline std::string fingerprint(const std::string& test, const std::string& threads) {
    const RunResult run = run_this_test_program(test, "OMP_NUM_THREADS=" + threads);
    EXPECT_EQ(run.status, 0) << run.out;
    const std::string word = "fingerprint: " + threads + " threads ";
    const auto at = run.out.find(word);
    EXPECT_NE(at, std::string::npos) << run.out;
    return at == std::string::npos ? "" : run.out.substr(at + word.size(), 16);
}

inline void expect_same_bits_with_one_two_and_three_threads(const std::string& test) {
    start_runtime();
    if (runtime_description().find("OpenMP") == std::string::npos)
        GTEST_SKIP() << "this Kokkos has no OpenMP: " << runtime_description();
    const std::string one = fingerprint(test, "1");
    EXPECT_EQ(fingerprint(test, "2"), one);
    EXPECT_EQ(fingerprint(test, "3"), one);
}

}  // namespace connectivity::test
