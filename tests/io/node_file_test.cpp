// SPDX-License-Identifier: BSD-3-Clause
// The node file: written by the library and read plainly, written plainly and read by the library.
#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/node_file.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

template <class T>
ConstView<T> view(const std::vector<T>& values) {
    auto out = allocate<T>("test", static_cast<Offset>(values.size()));
    std::copy(values.begin(), values.end(), out.data());
    return out;
}

template <class T>
std::vector<double> plain(const T& values) {
    return {values.data(), values.data() + values.size()};
}

/// A list of scalars with ghosts and all fields, one of tensors, and an empty one; in 2D.
std::vector<connectivity::ListData> three_lists() {
    start_runtime();
    connectivity::ListData water{
        NodeList::with_h("water", 2, 1, view<double>({1, 2, 3, 4}), view<double>({0.5, 0}), 2)};
    water.mass = view<double>({3, 4});
    water.softening = view<double>({0.1, 0.2});
    water.global_id = view<std::int64_t>({std::int64_t{1} << 62, 5});
    connectivity::ListData air{
        NodeList::with_H("air", 2, 1, view<double>({5, 6}), view<double>({2, 0.5, 3}), 3)};
    connectivity::ListData none{
        NodeList::with_h("none", 2, 0, view<double>({}), view<double>({}), 1)};
    return {water, air, none};
}

Domain half_periodic() {
    Domain domain;
    domain.periodic = {false, true, false};
    domain.lo = {0, -1, 0};
    domain.hi = {0, 8, 0};
    return domain;
}

TEST(NodeFile, written_file_has_the_documented_parts) {
    const TemporaryFolder folder;
    write_node_file(folder / "a.h5", three_lists(), half_periodic(), "who made it");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.h5"});
    const auto file = PlainFile::open(folder / "a.h5");
    EXPECT_EQ(file.numbers<int>("/", "dim"), std::vector<int>{2});
    EXPECT_EQ(file.numbers<double>("/", "kernel_extent"), (std::vector<double>{2, 3, 1}));
    EXPECT_EQ(file.numbers<int>("/", "periodic"), (std::vector<int>{0, 1}));
    EXPECT_EQ(file.numbers<double>("/", "box_lo"), (std::vector<double>{0, -1}));
    EXPECT_EQ(file.numbers<double>("/", "box_hi"), (std::vector<double>{0, 8}));
    EXPECT_EQ(file.numbers<int>("node_lists/water", "n_internal"), std::vector<int>{1});
    EXPECT_EQ(file.numbers<int>("node_lists/air", "order"), std::vector<int>{1});
    EXPECT_EQ(file.extents("node_lists/water/positions"), (Extents{2, 2}));
    EXPECT_EQ(file.read<double>("node_lists/water/positions"), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(file.read<double>("node_lists/water/h"), (std::vector<double>{0.5, 0}));
    EXPECT_EQ(file.read<double>("node_lists/water/mass"), (std::vector<double>{3, 4}));
    EXPECT_EQ(file.read<double>("node_lists/water/softening"), (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(file.read<std::int64_t>("node_lists/water/global_id")[0], std::int64_t{1} << 62);
    EXPECT_FALSE(file.has("node_lists/water/H"));
    EXPECT_EQ(file.extents("node_lists/air/H"), (Extents{1, 3}));
    EXPECT_EQ(file.extents("node_lists/none/positions"), (Extents{0, 2}));
}

TEST(NodeFile, reading_gives_back_what_was_written) {
    const TemporaryFolder folder;
    const auto lists = three_lists();
    write_node_file(folder / "a.h5", lists, half_periodic(), "");
    const auto reader = open_snapshot(folder / "a.h5");
    EXPECT_EQ(reader->info().domain.periodic, half_periodic().periodic);
    EXPECT_EQ(reader->info().domain.length(1), 9);
    ASSERT_EQ(reader->info().lists.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& wrote = lists[k];
        EXPECT_EQ(reader->info().lists[k].name, wrote.nodes.name());
        const auto read = reader->read(wrote.nodes.name(), {true, true, true, true});
        EXPECT_EQ(read.nodes.n(), wrote.nodes.n());
        EXPECT_EQ(read.nodes.n_internal(), wrote.nodes.n_internal());
        EXPECT_EQ(read.nodes.kernel_extent(), wrote.nodes.kernel_extent());
        EXPECT_EQ(plain(read.nodes.positions()), plain(wrote.nodes.positions()));
        EXPECT_EQ(plain(read.nodes.h()), plain(wrote.nodes.h()));
        EXPECT_EQ(plain(read.nodes.H()), plain(wrote.nodes.H()));
        EXPECT_EQ(plain(read.mass), plain(wrote.mass));
        EXPECT_EQ(plain(read.softening), plain(wrote.softening));
        EXPECT_EQ(read.global_id.size(), wrote.global_id.size());
    }
    EXPECT_EQ(reader->read("water", {false, false, false, true}).global_id(0),
              std::int64_t{1} << 62);
}

TEST(NodeFile, lists_stand_in_the_order_of_their_attribute) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "a.h5");
        file.attribute("/", "dim", 1).attribute("/", "kernel_extent", std::vector<double>{4, 5});
        for (const auto& [name, order] : {std::pair{"a", 1}, std::pair{"b", 0}}) {
            const std::string group = std::string("node_lists/") + name;
            file.data<double>(group + "/positions", {1}, {1, 1}).data<double>(group + "/h", {1});
            file.attribute(group, "n_internal", 1).attribute(group, "order", order);
        }
    }
    const auto reader = open_snapshot(folder / "a.h5");
    EXPECT_EQ(select_lists(reader->info(), {}), (std::vector<std::string>{"b", "a"}));
    EXPECT_EQ(reader->read("b", {}).nodes.kernel_extent(), 4);
    EXPECT_EQ(reader->read("a", {}).nodes.kernel_extent(), 5);
}

TEST(NodeFile, field_of_the_wrong_length_is_not_written) {
    const TemporaryFolder folder;
    auto lists = three_lists();
    lists[0].mass = view<double>({1});
    expect_error(Status::argument, {"water", "mass", "1 values", "2"},
                 [&] { write_node_file(folder / "a.h5", lists, {}, ""); });
    EXPECT_TRUE(folder.names().empty());
}

TEST(NodeFile, a_failed_write_leaves_the_old_file) {
    const TemporaryFolder folder;
    auto lists = three_lists();
    write_node_file(folder / "a.h5", lists, {}, "first");
    lists[2].mass = view<double>({1});
    EXPECT_THROW(write_node_file(folder / "a.h5", lists, {}, "second"), Error);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.h5"});
    EXPECT_EQ(PlainFile::open(folder / "a.h5").strings("/", "command"),
              std::vector<std::string>{"first"});
}

TEST(NodeFile, a_bad_place_is_an_error) {
    const TemporaryFolder folder;
    expect_error(Status::file, {"no folder"},
                 [&] { write_node_file(folder / "nowhere/a.h5", three_lists(), {}, ""); });
    expect_error(Status::file, {"it is a folder"},
                 [&] { write_node_file(folder.path(), three_lists(), {}, ""); });
}

}  // namespace
}  // namespace connectivity::test
