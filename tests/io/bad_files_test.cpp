// SPDX-License-Identifier: BSD-3-Clause
// Files that are not what they should be: one sentence that names the file, the part and the fault.
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include <connectivity/io/snapshot.hpp>

#include <io/expect_error.hpp>
#include <io/plain_hdf5.hpp>

namespace connectivity::test {
namespace {

/// Opens a file and reads every list with all its fields.
void read_all(const std::string& path) {
    const auto reader = open_snapshot(path);
    for (const auto& list : reader->info().lists) reader->read(list.name, {true, true, true, true});
}

void expect_bad(const std::vector<std::string>& words,
                const std::function<void(PlainFile&)>& write) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "bad.h5");
        write(file);
    }
    std::vector<std::string> all = words;
    all.push_back("bad.h5");
    expect_error(Status::format, all, [&] { read_all(folder / "bad.h5"); });
}

void write_text(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

TEST(BadFile, missing) {
    const TemporaryFolder folder;
    expect_error(Status::file, {"nothing.h5", "no such file"},
                 [&] { read_all(folder / "nothing.h5"); });
}

TEST(BadFile, folder) {
    const TemporaryFolder folder;
    expect_error(Status::file, {"folder"}, [&] { read_all(folder.path()); });
}

TEST(BadFile, unreadable) {
    if (geteuid() == 0) GTEST_SKIP() << "root reads every file";
    const TemporaryFolder folder;
    write_text(folder / "a.h5", "x");
    std::filesystem::permissions(folder / "a.h5", std::filesystem::perms::none);
    expect_error(Status::file, {"a.h5", "ermission"}, [&] { read_all(folder / "a.h5"); });
}

TEST(BadFile, empty) {
    const TemporaryFolder folder;
    write_text(folder / "a.h5", "");
    expect_error(Status::format, {"a.h5", "empty"}, [&] { read_all(folder / "a.h5"); });
}

TEST(BadFile, not_hdf5) {
    const TemporaryFolder folder;
    write_text(folder / "a.h5", std::string(5000, 'x'));
    expect_error(Status::format, {"a.h5", "not an HDF5 file"}, [&] { read_all(folder / "a.h5"); });
}

TEST(BadFile, truncated_anywhere) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "a.h5");
        file.data<float>("PartType0/Coordinates", std::vector<float>(3000, 1), {1000, 3});
    }
    const auto size = std::filesystem::file_size(folder / "a.h5");
    for (const double share : {0.999, 0.9, 0.5, 0.1, 0.02}) {
        const auto kept = static_cast<std::uintmax_t>(share * static_cast<double>(size));
        std::filesystem::resize_file(folder / "a.h5", kept);
        expect_error(Status::file, {"a.h5", "truncated"}, [&] { read_all(folder / "a.h5"); });
    }
}

TEST(BadFile, hdf5_of_another_format) {
    expect_bad({"no GADGET, SWIFT, H5Part or node file"},
               [](PlainFile& file) { file.data<double>("results/energy", {1}); });
}

TEST(BadFile, step_asked_of_a_file_without_steps) {
    const TemporaryFolder folder;
    { PlainFile::create(folder / "a.h5").data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3}); }
    ReadOptions options;
    options.step = 1;
    expect_error(Status::argument, {"a.h5", "step"},
                 [&] { open_snapshot(folder / "a.h5", options); });
}

TEST(BadFile, more_nodes_than_slots_without_data) {
    const TemporaryFolder folder;
    PlainFile::create(folder / "bad.h5")
        .unwritten("PartType0/Coordinates", {100000000000000000, 3});
    expect_error(Status::too_many, {"bad.h5", "Coordinates", "100000000000000000"},
                 [&] { read_all(folder / "bad.h5"); });
}

TEST(BadFile, positions_that_were_never_written) {
    expect_bad({"Coordinates", "[2000000000, 3]", "not all of its data"}, [](PlainFile& file) {
        file.unwritten("PartType0/Coordinates", {2000000000, 3});
    });
    expect_bad({"node_lists/a/positions", "not all of its data"}, [](PlainFile& file) {
        file.attribute("/", "dim", 1).attribute("/", "kernel_extent", 2.0);
        file.unwritten("node_lists/a/positions", {2000000000, 1}, {1000, 1});
    });
}

TEST(BadFile, a_field_of_which_a_chunk_is_missing) {
    expect_bad({"SmoothingLength", "[5]", "not all of its data"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", std::vector<float>(15, 1), {5, 3})
            .unwritten("PartType0/SmoothingLength", {5}, {2}, 4);
    });
}

TEST(BadGadget, no_coordinates) {
    expect_bad({"PartType0", "Coordinates"},
               [](PlainFile& file) { file.data<float>("PartType0/SmoothingLength", {1}); });
}

TEST(BadGadget, flat_coordinates) {
    expect_bad({"PartType0/Coordinates", "[6]", "[n, 3]"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3, 4, 5, 6});
    });
}

TEST(BadGadget, too_few_coordinates) {
    expect_bad({"[3, 2]", "[n, 3]"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, {3, 2});
    });
}

TEST(BadGadget, wrong_number_of_smoothing_lengths) {
    expect_bad({"PartType0/SmoothingLength", "[3]", "[1]"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3})
            .data<float>("PartType0/SmoothingLength", {1, 2, 3});
    });
}

TEST(BadGadget, wrong_number_of_masses) {
    expect_bad({"PartType0/Masses", "[2]", "[1]"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3})
            .data<float>("PartType0/Masses", {1, 2});
    });
}

TEST(BadGadget, ids_that_are_no_whole_numbers) {
    expect_bad({"ParticleIDs", "whole"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3})
            .data<float>("PartType0/ParticleIDs", {1.5});
    });
}

TEST(BadGadget, ids_beyond_63_bits) {
    expect_bad({"ParticleIDs", "18446744073709551615", "node 1"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, {2, 3})
            .data<std::uint64_t>("PartType0/ParticleIDs", {7, ~std::uint64_t{0}});
    });
}

TEST(BadGadget, periodic_without_a_box) {
    expect_bad({"BoxSize"}, [](PlainFile& file) {
        file.data<float>("PartType0/Coordinates", {1, 2, 3}, {1, 3});
        file.attribute("Config", "PERIODIC", "");
    });
}

/// A good node file of one list and dimension 2, with attributes as told.
struct NodeFileParts {
    int dim = 2, n_internal = 1, order = 0;
    std::vector<double> kernel_extent{2}, periodic, box_lo{0, 0}, box_hi{1, 1};
    bool h = true, H = false, extent = true;
    Extents h_extents{2};

    void operator()(PlainFile& file) const {
        file.attribute("/", "dim", dim).attribute("node_lists/a", "order", order);
        file.attribute("node_lists/a", "n_internal", n_internal);
        if (extent) file.attribute("/", "kernel_extent", kernel_extent);
        if (!periodic.empty())
            file.attribute("/", "periodic", periodic)
                .attribute("/", "box_lo", box_lo)
                .attribute("/", "box_hi", box_hi);
        file.data<double>("node_lists/a/positions", {1, 2, 3, 4}, {2, 2});
        hsize_t n = 1;
        for (const hsize_t extent_of : h_extents) n *= extent_of;
        if (h) file.data<double>("node_lists/a/h", std::vector<double>(n, 0.1), h_extents);
        if (H) file.data<double>("node_lists/a/H", {1, 0, 1, 1, 0, 1}, {2, 3});
    }
};

NodeFileParts with(const std::function<void(NodeFileParts&)>& change) {
    NodeFileParts parts;
    change(parts);
    return parts;
}

TEST(BadNodeFile, the_unchanged_parts_are_good) {
    const TemporaryFolder folder;
    {
        auto file = PlainFile::create(folder / "good.h5");
        NodeFileParts{}(file);
    }
    EXPECT_NO_THROW(read_all(folder / "good.h5"));
}

TEST(BadNodeFile, both_h_and_H) {
    expect_bad({"both h and H", "exactly one"}, with([](auto& p) { p.H = true; }));
}

TEST(BadNodeFile, neither_h_nor_H) {
    expect_bad({"neither h nor H", "exactly one"}, with([](auto& p) { p.h = false; }));
}

TEST(BadNodeFile, dimension_out_of_range) {
    expect_bad({"dim = 4", "1 to 3"}, with([](auto& p) { p.dim = 4; }));
}

TEST(BadNodeFile, positions_of_another_dimension) {
    expect_bad({"[2, 2]", "[n, 3]"}, with([](auto& p) { p.dim = 3; }));
}

TEST(BadNodeFile, more_internal_nodes_than_nodes) {
    expect_bad({"n_internal = 3", "0 to 2"}, with([](auto& p) { p.n_internal = 3; }));
}

TEST(BadNodeFile, negative_number_of_internal_nodes) {
    expect_bad({"n_internal = -1"}, with([](auto& p) { p.n_internal = -1; }));
}

TEST(BadNodeFile, order_out_of_range) {
    expect_bad({"order = 1", "0 to 0"}, with([](auto& p) { p.order = 1; }));
}

TEST(BadNodeFile, kernel_extent_of_the_wrong_length) {
    expect_bad({"kernel_extent", "2 values", "must have 1"}, with([](auto& p) {
                   p.kernel_extent = {1, 2};
               }));
    expect_bad({"kernel_extent"}, with([](auto& p) { p.extent = false; }));
}

TEST(BadNodeFile, h_of_the_wrong_shape) {
    expect_bad({"/h", "[3]", "[2]"}, with([](auto& p) { p.h_extents = {3}; }));
    expect_bad({"/h", "[2, 1]", "[2]"}, with([](auto& p) { p.h_extents = {2, 1}; }));
}

TEST(BadNodeFile, periodic_of_the_wrong_length_or_value) {
    expect_bad({"periodic", "3 values"}, with([](auto& p) { p.periodic = {1, 0, 0}; }));
    expect_bad({"periodic[1] = 2"}, with([](auto& p) { p.periodic = {1, 2}; }));
    expect_bad({"box_lo"}, with([](auto& p) {
                   p.periodic = {1, 1};
                   p.box_lo = {0};
               }));
}

TEST(BadNodeFile, no_lists) {
    expect_bad({"node_lists", "empty"}, [](PlainFile& file) {
        file.attribute("/", "dim", 3).attribute("/", "kernel_extent", 2.0).group("node_lists");
    });
}

TEST(BadNodeFile, positions_missing) {
    expect_bad({"node_lists/a", "no positions"}, [](PlainFile& file) {
        file.attribute("/", "dim", 3).attribute("/", "kernel_extent", 2.0);
        file.data<double>("node_lists/a/h", {1});
    });
}

TEST(BadNodeFile, text_instead_of_numbers) {
    expect_bad({"dim", "no number"},
               [](PlainFile& file) { file.attribute("/", "dim", "two").group("node_lists"); });
}

}  // namespace
}  // namespace connectivity::test
