// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Checks that an action ends in an Error of one status whose text names what is wrong.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

namespace connectivity::test {

template <class Action>
void expect_error(Status status, const std::vector<std::string>& words, const Action& action) {
    try {
        action();
    } catch (const Error& e) {
        const std::string text = e.what();
        EXPECT_EQ(static_cast<int>(e.status()), static_cast<int>(status)) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        for (const auto& word : words)
            EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
        return;
    }
    ADD_FAILURE() << "no error; expected status " << static_cast<int>(status);
}

}  // namespace connectivity::test
