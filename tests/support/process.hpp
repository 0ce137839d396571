// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What tests ask of the operating system: memory in use, and a run of the test executable in a
/// process of its own.

#include <cstdint>
#include <string>

namespace connectivity::test {

/// Whether a sanitizer slows this process down and keeps freed memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

/// Bytes of this process in memory now (0 where the system does not tell).
std::int64_t resident_bytes();

/// Largest number of bytes in memory since the last reset_peak().
std::int64_t peak_resident_bytes();
void reset_peak();

struct RunResult {
    int status = -1;  ///< exit status, -1 if it did not exit by itself
    std::string out;  ///< standard output
};

RunResult run_command(const std::string& shell_command);

/// Runs one test of this executable with additional environment, "NAME=value NAME=value".
RunResult run_this_test_program(const std::string& gtest_filter, const std::string& environment);

/// Absolute path of this executable.
std::string program_path();

}  // namespace connectivity::test
