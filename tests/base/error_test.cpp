// SPDX-License-Identifier: BSD-3-Clause
// Statuses: one list, distinct numbers, a text for each.

#include <set>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

namespace connectivity::test {
namespace {

struct Entry {
    const char* name;
    std::int32_t value;
    const char* text;
};

const Entry entries[] = {
#define CONN_STATUS_ENTRY(NAME, name, value, text) {#NAME, value, text},
    CONN_STATUS_LIST(CONN_STATUS_ENTRY)
#undef CONN_STATUS_ENTRY
};

TEST(StatusList, numbers_and_texts_are_distinct) {
    std::set<std::int32_t> values;
    std::set<std::string> texts;
    for (const Entry& entry : entries) {
        EXPECT_TRUE(values.insert(entry.value).second) << entry.name;
        EXPECT_TRUE(texts.insert(entry.text).second) << entry.name;
    }
}

TEST(StatusList, every_status_has_its_text_and_other_numbers_say_unknown) {
    for (const Entry& entry : entries)
        EXPECT_STREQ(status_text(static_cast<Status>(entry.value)), entry.text);
    EXPECT_STREQ(status_text(static_cast<Status>(12345)), "unknown status");
    EXPECT_STREQ(status_text(static_cast<Status>(-12345)), "unknown status");
}

TEST(StatusList, only_success_is_zero_and_only_defects_are_negative) {
    for (const Entry& entry : entries) {
        const std::string name = entry.name;
        EXPECT_EQ(entry.value == 0, name == "OK");
        EXPECT_EQ(entry.value < 0, name == "E_INTERNAL") << name;
    }
}

TEST(ErrorException, carries_status_and_text) {
    try {
        throw Error(Status::box, "box: axis 2 is empty");
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "box: axis 2 is empty");
        EXPECT_EQ(dynamic_cast<const Error&>(e).status(), Status::box);
    }
}

}  // namespace
}  // namespace connectivity::test
