// SPDX-License-Identifier: BSD-3-Clause
// GADGET and SWIFT snapshots: what was written is what is read.
#include <functional>

#include <gtest/gtest.h>

#include <connectivity/io/snapshot.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

template <class T>
std::vector<double> plain(const T& view) {
    return {view.data(), view.data() + view.size()};
}

const FieldRequest everything{true, true, true, true};

using More = std::function<void(PlainFile&)>;
const More nothing = [](PlainFile&) {};

/// Two gas and three dark-matter particles in a box of 10, and what a test adds.
template <class Real>
void write_gadget(const std::string& path, const More& more = nothing) {
    auto file = PlainFile::create(path);
    file.attribute("Header", "BoxSize", 10.0)
        .attribute("Header", "MassTable", std::vector<double>{0, 7.5})
        .attribute("Header", "NumPart_ThisFile", std::vector<unsigned>{2, 3})
        .attribute("Header", "NumFilesPerSnapshot", 1);
    file.data<Real>("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, {2, 3})
        .template data<Real>("PartType0/SmoothingLength", {0.5, 0.25})
        .template data<Real>("PartType0/Masses", {2, 4})
        .template data<Real>("PartType0/Density", {8, 16})
        .template data<unsigned>("PartType0/ParticleIDs", {4000000000u, 7});
    file.data<Real>("PartType1/Coordinates", {9, 8, 7, 6, 5, 4, 3, 2, 1}, {3, 3});
    more(file);
}

template <class Real>
void expect_gadget(const std::string& path) {
    const auto reader = open_snapshot(path);
    const auto& info = reader->info();
    EXPECT_EQ(info.format, "GADGET");
    EXPECT_EQ(info.dim, 3);
    ASSERT_EQ(info.lists.size(), 2u);
    EXPECT_EQ(info.lists[0].n, 2);
    EXPECT_TRUE(info.lists[0].has_support);
    EXPECT_EQ(info.lists[1].n, 3);
    EXPECT_FALSE(info.lists[1].has_support);
    const auto gas = reader->read("PartType0", everything);
    EXPECT_EQ(plain(gas.nodes.positions()), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(plain(gas.nodes.h()), (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(gas.nodes.kernel_extent(), 1);
    EXPECT_EQ(gas.nodes.n_internal(), 2);
    EXPECT_EQ(plain(gas.mass), (std::vector<double>{2, 4}));
    EXPECT_EQ(plain(gas.density), (std::vector<double>{8, 16}));
    EXPECT_EQ(gas.global_id(0), 4000000000);
    const auto dark = reader->read("PartType1", everything);
    EXPECT_EQ(plain(dark.nodes.h()), (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(plain(dark.mass), (std::vector<double>{7.5, 7.5, 7.5}));
    EXPECT_EQ(dark.density.size(), 0u);
}

TEST(Gadget, single_precision_is_read_exactly) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5");
    expect_gadget<float>(folder / "a.hdf5");
}

TEST(Gadget, double_precision_is_read_exactly) {
    const TemporaryFolder folder;
    write_gadget<double>(folder / "a.hdf5");
    expect_gadget<double>(folder / "a.hdf5");
}

TEST(Gadget, fields_nobody_asked_for_are_not_read) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5");
    const auto gas = open_snapshot(folder / "a.hdf5")->read("PartType0", {});
    EXPECT_EQ(gas.mass.size() + gas.density.size() + gas.global_id.size(), 0u);
}

TEST(Gadget, box_is_periodic_if_config_says_so) {
    const TemporaryFolder folder;
    for (const bool periodic : {true, false}) {
        write_gadget<float>(folder / "a.hdf5", [&](PlainFile& file) {
            file.group("Config");
            if (periodic) file.attribute("Config", "PERIODIC", "");
        });
        const auto domain = open_snapshot(folder / "a.hdf5")->info().domain;
        EXPECT_EQ(domain.any_periodic(3), periodic);
        EXPECT_EQ(domain.length(2), periodic ? 10 : 0);
    }
}

TEST(Gadget, box_without_config_is_periodic_if_it_has_a_size) {
    const TemporaryFolder folder;
    for (const double size : {10.0, 0.0}) {
        {
            auto file = PlainFile::create(folder / "a.hdf5");
            file.attribute("Header", "BoxSize", size);
            file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3});
        }
        EXPECT_EQ(open_snapshot(folder / "a.hdf5")->info().domain.any_periodic(3), size > 0);
        ReadOptions open;
        open.open = true;
        EXPECT_FALSE(open_snapshot(folder / "a.hdf5", open)->info().domain.any_periodic(3));
    }
}

TEST(Gadget, stretched_box_has_its_own_length_on_each_axis) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5", [](PlainFile& file) {
        file.attribute("Config", "PERIODIC", "")
            .attribute("Config", "LONG_X", 4.0)
            .attribute("Config", "LONG_Z_BITS", 1.0);
    });
    EXPECT_EQ(open_snapshot(folder / "a.hdf5")->info().domain.hi,
              (std::array<double, 3>{40, 10, 5}));
}

TEST(Gadget, two_dimensional_runs_have_two_coordinates) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5", [](PlainFile& file) {
        file.attribute("Config", "TWODIMS", "").attribute("Config", "PERIODIC", "");
    });
    const auto reader = open_snapshot(folder / "a.hdf5");
    EXPECT_EQ(reader->info().dim, 2);
    EXPECT_FALSE(reader->info().domain.periodic[2]);
    EXPECT_EQ(plain(reader->read("PartType0", {}).nodes.positions()),
              (std::vector<double>{1, 2, 4, 5}));
}

TEST(Gadget, extent_can_be_chosen) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5");
    ReadOptions options;
    options.kernel_extent = 2.5;
    const auto list = open_snapshot(folder / "a.hdf5", options)->read("PartType0", {});
    EXPECT_EQ(list.nodes.kernel_extent(), 2.5);
}

TEST(Gadget, one_file_of_many_is_an_error) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "a.hdf5");
        file.attribute("Header", "NumFilesPerSnapshot", 4)
            .attribute("Header", "NumPart_ThisFile", std::vector<unsigned>{1})
            .attribute("Header", "NumPart_Total", std::vector<unsigned>{4});
        file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3});
    }
    expect_error(Status::unsupported, {"a.hdf5", "4 files"},
                 [&] { open_snapshot(folder / "a.hdf5"); });
}

TEST(Lists, those_with_supports_take_part_unless_told) {
    const TemporaryFolder folder;
    write_gadget<float>(folder / "a.hdf5");
    const auto reader = open_snapshot(folder / "a.hdf5");
    using Names = std::vector<std::string>;
    EXPECT_EQ(select_lists(reader->info(), {}), Names{"PartType0"});
    EXPECT_EQ(select_lists(reader->info(), {"PartType1", "PartType0"}),
              (Names{"PartType1", "PartType0"}));
    expect_error(Status::argument, {"PartType5", "PartType0, PartType1"},
                 [&] { select_lists(reader->info(), {"PartType5"}); });
    expect_error(Status::argument, {"PartType0", "twice"}, [&] {
        select_lists(reader->info(), {"PartType0", "PartType0"});
    });
}

/// One gas particle as SWIFT writes it.
void write_swift(const std::string& path, const char* kernel, const More& more = nothing) {
    auto file = PlainFile::create(path);
    file.attribute("Code", "Code", "SWIFT")
        .attribute("Header", "BoxSize", std::vector<double>{2, 4, 8})
        .attribute("Header", "Dimension", std::vector<int>{3});
    if (kernel) file.attribute("HydroScheme", "Kernel function", kernel);
    file.data<double>("PartType0/Coordinates", {1, 2, 3}, {1, 3})
        .data<float>("PartType0/SmoothingLengths", {0.5})
        .data<float>("PartType0/Masses", {2})
        .data<float>("PartType0/Densities", {8})
        .data<std::int64_t>("PartType0/ParticleIDs", {std::int64_t{1} << 60});
    more(file);
}

TEST(Swift, names_box_vector_and_kernel_are_read) {
    const TemporaryFolder folder;
    write_swift(folder / "a.hdf5", "Cubic spline (M4)");
    const auto reader = open_snapshot(folder / "a.hdf5");
    EXPECT_EQ(reader->info().format, "SWIFT");
    EXPECT_EQ(reader->info().domain.hi, (std::array<double, 3>{2, 4, 8}));
    EXPECT_TRUE(reader->info().domain.periodic[0]);
    const auto gas = reader->read("PartType0", everything);
    EXPECT_EQ(gas.nodes.kernel_extent(), 1.825742);
    EXPECT_EQ(plain(gas.nodes.h()), std::vector<double>{0.5});
    EXPECT_EQ(plain(gas.mass), std::vector<double>{2});
    EXPECT_EQ(plain(gas.density), std::vector<double>{8});
    EXPECT_EQ(gas.global_id(0), std::int64_t{1} << 60);
}

TEST(Swift, extent_must_be_given_if_the_kernel_is_unknown) {
    const TemporaryFolder folder;
    write_swift(folder / "a.hdf5", nullptr);
    expect_error(Status::format, {"kernel extent"}, [&] { open_snapshot(folder / "a.hdf5"); });
    ReadOptions options;
    options.kernel_extent = 1.9;
    EXPECT_EQ(
        open_snapshot(folder / "a.hdf5", options)->read("PartType0", {}).nodes.kernel_extent(),
        1.9);
}

TEST(Swift, its_parameters_decide_on_periodicity) {
    const TemporaryFolder folder;
    write_swift(folder / "a.hdf5", "Wendland C2", [](PlainFile& file) {
        file.attribute("Parameters", "InitialConditions:periodic", "0");
    });
    EXPECT_FALSE(open_snapshot(folder / "a.hdf5")->info().domain.any_periodic(3));
}

}  // namespace
}  // namespace connectivity::test
