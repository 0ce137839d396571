// SPDX-License-Identifier: BSD-3-Clause
// The result file: types, shapes and atomicity. (Its content is compared with brute force in
// tests/program.)
#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/result_file.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

ConstView<double> view(const std::vector<double>& values) {
    auto out = allocate<double>("test", static_cast<Offset>(values.size()));
    std::copy(values.begin(), values.end(), out.data());
    return out;
}

/// Nodes at 0, 1 and 2 of one line see their next; a second list is empty.
std::vector<NodeList> chain() {
    start_runtime();
    return {NodeList::with_h("chain", 1, 2, view({0, 1, 2}), view({0.5, 0.5, 0.5}), 2),
            NodeList::with_h("empty", 1, 0, view({}), view({}), 2)};
}

TEST(ResultFile, has_the_documented_parts_and_types) {
    const TemporaryFolder folder;
    const auto lists = chain();
    ConnectivityMap map;
    map.rebuild(lists, {});
    {
        ResultFile out(folder / "r.h5");
        out.write(map, "the command");
        out.write_density("chain", view({1, 2, 3}), "g/cm");
        out.commit();
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"r.h5"});
    const auto file = PlainFile::open(folder / "r.h5");
    EXPECT_TRUE(file.is_stored_as<std::int64_t>("rows/offsets"));
    EXPECT_TRUE(file.is_stored_as<int>("rows/slots"));
    EXPECT_TRUE(file.is_stored_as<int>("pairs/i"));
    EXPECT_TRUE(file.is_stored_as<int>("pairs/j"));
    EXPECT_EQ(file.read<std::int64_t>("rows/offsets"), (std::vector<std::int64_t>{0, 1, 1, 3, 3}));
    EXPECT_EQ(file.read<int>("rows/slots"), (std::vector<int>{1, 0, 2}));
    EXPECT_EQ(file.read<int>("pairs/i"), (std::vector<int>{0, 1}));
    EXPECT_EQ(file.read<int>("pairs/j"), (std::vector<int>{1, 2}));
    EXPECT_EQ(file.read<double>("density/chain"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(file.strings("density/chain", "units"), std::vector<std::string>{"g/cm"});
    EXPECT_EQ(file.numbers<std::int64_t>("/", "list_offset"), (std::vector<std::int64_t>{0, 3, 3}));
    EXPECT_EQ(file.numbers<std::int64_t>("/", "row_offset"), (std::vector<std::int64_t>{0, 2, 2}));
    EXPECT_EQ(file.numbers<std::int64_t>("/", "n_internal"), (std::vector<std::int64_t>{2, 0}));
    EXPECT_EQ(file.numbers<std::int64_t>("/", "generation"), std::vector<std::int64_t>{1});
    EXPECT_EQ(file.strings("/", "list_names"), (std::vector<std::string>{"chain", "empty"}));
    EXPECT_EQ(file.strings("/", "command"), std::vector<std::string>{"the command"});
    EXPECT_FALSE(file.strings("/", "library_version")[0].empty());
}

TEST(ResultFile, nothing_is_left_unless_committed) {
    const TemporaryFolder folder;
    {
        ResultFile out(folder / "r.h5");
        EXPECT_EQ(folder.names().size(), 1u);
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(ResultFile, rows_without_neighbours_are_written) {
    const TemporaryFolder folder;
    start_runtime();
    const std::vector<NodeList> lists{NodeList::with_h("alone", 1, 1, view({0}), view({0}), 2)};
    ConnectivityMap map;
    map.rebuild(lists, {});
    ResultFile out(folder / "r.h5");
    out.write(map, "");
    out.commit();
    const auto file = PlainFile::open(folder / "r.h5");
    EXPECT_EQ(file.extents("rows/slots"), Extents{0});
    EXPECT_EQ(file.extents("pairs/i"), Extents{0});
    EXPECT_EQ(file.extents("pairs/j"), Extents{0});
}

TEST(ResultFile, a_bad_place_is_found_at_once) {
    expect_error(Status::file, {"/nowhere/r.h5", "no folder"},
                 [] { const ResultFile out("/nowhere/r.h5"); });
}

}  // namespace
}  // namespace connectivity::test
