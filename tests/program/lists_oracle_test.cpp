// SPDX-License-Identifier: BSD-3-Clause
// `connectivity lists` on boxtree's own cases: every array it wrote is in our file, the same.
#include <gtest/gtest.h>

#include <support/boxtree_oracle.hpp>

#include <program/lists_result.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

class ListsOfBoxtree : public ::testing::TestWithParam<std::filesystem::path> {
protected:
    std::string name() const { return GetParam().stem().string(); }
    std::string path() const { return GetParam().string(); }
    /// a3 has no parameters in the file.
    std::vector<std::string> flags() const {
        if (name() != "a3_linked") return {};
        return {"--leaf", "20", "--stick-out", "0.25", "--tree-only"};
    }
    void run(const std::string& out) const {
        std::vector<std::string> words{"lists", path(), "--out", out};
        const auto more = flags();
        words.insert(words.end(), more.begin(), more.end());
        const auto outcome = run_program(words);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
};

TEST_P(ListsOfBoxtree, each_array_is_the_same_and_there_are_no_others) {
    const TemporaryFolder folder;
    run(folder / "out.h5");
    if (HasFatalFailure()) return;
    expect_same_result(folder / "out.h5", path());
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out.h5"});
    if (name().starts_with("a")) return;  // those have a part of boxtree's arrays only
    EXPECT_EQ(PlainFile::open(folder / "out.h5").names(), result_names(PlainFile::open(path())));
}

INSTANTIATE_TEST_SUITE_P(Files, ListsOfBoxtree, ::testing::ValuesIn(boxtree_files()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(ListsFile, names_the_command_and_the_version) {
    const TemporaryFolder folder;
    const std::string in = boxtree_files().at(1).string(), out = folder / "out.h5";
    ASSERT_EQ(run_program({"lists", in, "--tree-only", "--leaf", "9", "--out", out}).status, 0);
    const auto file = PlainFile::open(out);
    EXPECT_EQ(file.strings("/", "command").at(0),
              "connectivity lists " + in + " --tree-only --leaf 9 --out " + out);
    EXPECT_FALSE(file.strings("/", "library_version").at(0).empty());
}

}  // namespace
}  // namespace connectivity::test
