// SPDX-License-Identifier: BSD-3-Clause
// H5Part: steps, dimensions and boxes.
#include <gtest/gtest.h>

#include <connectivity/io/snapshot.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

/// Steps 2, 9 and 10, of two nodes each; x of the first node is the number of the step.
void write_steps(const std::string& path) {
    auto file = PlainFile::create(path);
    for (const int step : {2, 9, 10}) {
        const std::string group = "Step#" + std::to_string(step);
        file.data<double>(group + "/x", {1.0 * step, 1})
            .data<double>(group + "/y", {2, 3})
            .data<float>(group + "/z", {4, 5})
            .data<double>(group + "/h", {0.5, 0.25})
            .data<double>(group + "/m", {1, 2})
            .data<double>(group + "/rho", {3, 4})
            .data<std::uint64_t>(group + "/id", {11, 12});
    }
}

TEST(H5Part, the_last_step_is_read_unless_told) {
    const TemporaryFolder folder;
    write_steps(folder / "a.h5");
    ReadOptions options;
    EXPECT_EQ(open_snapshot(folder / "a.h5")->read("particles", {}).nodes.positions()(0), 10);
    options.step = 9;
    EXPECT_EQ(open_snapshot(folder / "a.h5", options)->read("particles", {}).nodes.positions()(0),
              9);
    options.step = 3;
    expect_error(Status::argument, {"no step 3", "2 to 10"},
                 [&] { open_snapshot(folder / "a.h5", options); });
}

TEST(H5Part, fields_are_read_as_written) {
    const TemporaryFolder folder;
    write_steps(folder / "a.h5");
    const auto reader = open_snapshot(folder / "a.h5");
    EXPECT_EQ(reader->info().dim, 3);
    EXPECT_FALSE(reader->info().domain.any_periodic(3));
    const auto list = reader->read("particles", {true, true, true, true});
    const double expected[] = {10, 2, 4, 1, 3, 5};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(list.nodes.positions()(k), expected[k]);
    EXPECT_EQ(list.nodes.kernel_extent(), 2);
    EXPECT_EQ(list.nodes.h()(1), 0.25);
    EXPECT_EQ(list.mass(1), 2);
    EXPECT_EQ(list.density(1), 4);
    EXPECT_EQ(list.global_id(1), 12);
}

TEST(H5Part, dimension_is_the_number_of_coordinates) {
    const TemporaryFolder folder;
    { PlainFile::create(folder / "a.h5").data<double>("Step#0/x", {1, 2}); }
    EXPECT_EQ(open_snapshot(folder / "a.h5")->info().dim, 1);
    {
        PlainFile::create(folder / "a.h5")
            .data<double>("Step#0/x", {1})
            .data<double>("Step#0/y", {1});
    }
    EXPECT_EQ(open_snapshot(folder / "a.h5")->info().dim, 2);
}

TEST(H5Part, box_of_the_step_is_used_unless_open) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "a.h5");
        file.data<double>("Step#0/x", {1}).data<double>("Step#0/y", {1});
        file.attribute("Step#0", "box", std::vector<double>{-1, 1, 0, 3, 0, 0})
            .attribute("Step#0", "boundaryType", std::vector<int>{1, 0, 2});
    }
    const auto domain = open_snapshot(folder / "a.h5")->info().domain;
    EXPECT_EQ(domain.periodic, (std::array<bool, 3>{true, false, false}));
    EXPECT_EQ(domain.length(0), 2);
    ReadOptions options;
    options.open = true;
    EXPECT_FALSE(open_snapshot(folder / "a.h5", options)->info().domain.any_periodic(2));
}

TEST(H5Part, axes_of_different_length_are_an_error) {
    const TemporaryFolder folder;
    {
        PlainFile::create(folder / "a.h5")
            .data<double>("Step#0/x", {1, 2})
            .data<double>("Step#0/y", {1});
    }
    expect_error(Status::format, {"Step#0/y", "[1]", "[2]"},
                 [&] { open_snapshot(folder / "a.h5")->read("particles", {}); });
}

TEST(H5Part, a_step_without_coordinates_is_an_error) {
    const TemporaryFolder folder;
    { PlainFile::create(folder / "a.h5").data<double>("Step#0/h", {1}); }
    expect_error(Status::format, {"Step#0", "coordinates"},
                 [&] { open_snapshot(folder / "a.h5"); });
}

}  // namespace
}  // namespace connectivity::test
