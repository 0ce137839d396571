// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Checks that a call ends in the library's error, with a status and certain words in its text.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

namespace connectivity::test {

template <class Call>
::testing::AssertionResult fails_with(Status status, const std::vector<std::string>& words,
                                      const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        if (error.status() != status)
            return ::testing::AssertionFailure()
                   << "status is " << status_text(error.status()) << ": " << error.what();
        for (const std::string& word : words)
            if (std::string(error.what()).find(word) == std::string::npos)
                return ::testing::AssertionFailure()
                       << "no \"" << word << "\" in: " << error.what();
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "no error was thrown";
}

}  // namespace connectivity::test
