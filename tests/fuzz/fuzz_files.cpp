// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer chooses what stands in a well-formed HDF5 file; every reader has a go at it. Whatever
// it is, a reader succeeds or throws Error, leaks nothing, not even inside HDF5, and takes no more
// memory than the file justifies.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/lists_input.hpp>
#include <connectivity/io/snapshot.hpp>
#include <connectivity/lists/traversal.hpp>
#include <connectivity/map/connectivity_map.hpp>
#include <connectivity/tree/box_tree.hpp>

#include "hdf5_maker.hpp"
#include "leaks.hpp"

namespace connectivity::test {
namespace {

struct Counts {
    long long files = 0, opened = 0, lists = 0, built = 0, trees = 0;
} counts;

std::string path() {
    static const std::string folder =
        std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
    static const std::string name =
        folder + "/connectivity-fuzz-" + std::to_string(getpid()) + ".h5";
    return name;
}

void at_end() {
    check_for_leaks();
    std::error_code ignored;
    std::filesystem::remove(path(), ignored);
    std::fprintf(
        stderr,
        "fuzz_files: %lld files; %lld were opened, %lld lists read, %lld maps and %lld trees "
        "with interaction lists built\n",
        counts.files, counts.opened, counts.lists, counts.built, counts.trees);
}

void make_file(Random& random) {
    Hdf5Maker file(path(), random);
    switch (random.below(6)) {
        case 0: file.node_file(); break;
        case 1: file.gadget(); break;
        case 2: file.swift(); break;
        case 3: file.h5part(); break;
        case 4: file.lists_case(); break;
        default: file.node_file(), file.gadget(), file.h5part(); break;
    }
    for (int k = 0; k < 6 && !random.exhausted(); ++k) file.anything();
}

/// Is false where it threw Error; other exceptions leave the process.
bool succeeds(const std::function<void()>& body) {
    try {
        body();
        return true;
    } catch (const Error& e) {
        EXPECT_GT(std::string(e.what()).size(), 10u);
        return false;
    }
}

void check_map(const SnapshotInfo& info, const std::vector<NodeList>& lists, Random& random) {
    MapOptions options;
    options.domain = info.domain;
    options.overlap = random.chance(0.1);
    if (random.chance(0.1)) options.order = ListOrder::key;
    ConnectivityMap map;
    if (succeeds([&] { map.rebuild(lists, options); })) ++counts.built;
}

void read(const ReadOptions& options, Random& random) {
    std::unique_ptr<SnapshotReader> reader;
    if (!succeeds([&] { reader = open_snapshot(path(), options); })) return;
    ++counts.opened;
    const SnapshotInfo& info = reader->info();
    EXPECT_TRUE(info.dim >= 1 && info.dim <= 3);
    succeeds([&] { select_lists(info, {}); });
    std::vector<NodeList> lists;
    for (const ListInfo& entry : info.lists)
        succeeds([&] {
            const ListData data = reader->read(entry.name, {true, true, true, true});
            EXPECT_EQ(data.nodes.n(), entry.n);
            EXPECT_EQ(data.nodes.n_internal(), entry.n_internal);
            for (const auto n : {data.mass.size(), data.density.size(), data.softening.size(),
                                 data.global_id.size()})
                EXPECT_TRUE(n == 0 || static_cast<Offset>(n) == entry.n);
            lists.push_back(data.nodes);
            ++counts.lists;
        });
    if (!lists.empty()) check_map(info, lists, random);
}

void read_case() {
    succeeds([] {
        if (!is_lists_input(path())) return;
        const ListsInput input = read_lists_input(path());
        EXPECT_TRUE(input.dim >= 1 && input.dim <= 3);
        BoxTree tree;
        tree.build(input.particles(), input.tree);
        if (input.tree_only) return;
        const FMMTraversalInfo lists(tree.view(), input.lists);
        EXPECT_EQ(lists.nboxes(), tree.view().n_boxes);
        ++counts.trees;
    });
}

/// HDF5 keeps what is not closed, so leaks of it are counted here.
std::array<hsize_t, 7> open_identifiers() {
    std::array<hsize_t, 7> n{};
    const H5I_type_t types[] = {H5I_FILE,    H5I_GROUP, H5I_DATATYPE,   H5I_DATASPACE,
                                H5I_DATASET, H5I_ATTR,  H5I_GENPROP_LST};
    for (std::size_t k = 0; k < n.size(); ++k) H5Inmembers(types[k], &n[k]);
    return n;
}

ReadOptions options_from(Random& random) {
    ReadOptions options;
    options.open = random.chance(0.2);
    if (random.chance(0.2)) options.kernel_extent = random.pick({1.0, 2.0, 0.0, -1.0, 1e300});
    if (random.chance(0.1)) options.step = random.below(9);
    return options;
}

}  // namespace
}  // namespace connectivity::test

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    ::testing::GTEST_FLAG(break_on_failure) = true;  // libFuzzer keeps the input of an abort
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    connectivity::start_runtime({.n_threads = 1});
    connectivity::test::path();  // made before, and hence destroyed after, what is called at exit
    std::atexit(connectivity::test::at_end);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace connectivity::test;
    Random random(std::span(data, size));
    const connectivity::ReadOptions options = options_from(random);
    make_file(random);
    const auto before = open_identifiers();
    read(options, random);
    read_case();
    EXPECT_EQ(open_identifiers(), before);
    if (++counts.files % 512 == 0) check_for_leaks();
    return 0;
}
