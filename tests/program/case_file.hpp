// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A search problem as a node file, written plainly, and a result file compared with brute force.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <io/plain_hdf5.hpp>
#include <support/brute_force.hpp>

namespace connectivity::test {

inline void write_case(const std::string& path, const Case& c) {
    auto file = PlainFile::create(path);
    const auto dim = static_cast<std::size_t>(c.dim);
    const auto first = [&](const auto& a) {
        return std::vector<double>(a.begin(), a.begin() + c.dim);
    };
    std::vector<double> extents;
    for (std::size_t k = 0; k < c.lists.size(); ++k) {
        const auto& list = c.lists[k];
        const hsize_t n = list.x.size() / dim;
        const std::string group = "node_lists/" + list.name;
        extents.push_back(list.extent);
        file.data<double>(group + "/positions", list.x, {n, dim});
        if (list.tensor)
            file.data<double>(group + "/H", list.H, {n, static_cast<hsize_t>(n_symmetric(c.dim))});
        else
            file.data<double>(group + "/h", list.h, {n});
        file.attribute(group, "n_internal", list.n_internal);
        file.attribute(group, "order", static_cast<int>(k));
    }
    file.attribute("/", "dim", c.dim).attribute("/", "kernel_extent", extents);
    if (c.domain.any_periodic(c.dim))
        file.attribute("/", "periodic", first(c.domain.periodic))
            .attribute("/", "box_lo", first(c.domain.lo))
            .attribute("/", "box_hi", first(c.domain.hi));
}

/// Rows, pairs and offsets of a result file.
inline void expect_result(const std::string& path, const Expected& expected) {
    const auto file = PlainFile::open(path);
    EXPECT_EQ(file.numbers<std::int64_t>("/", "list_offset"), expected.list_offset);
    EXPECT_EQ(file.numbers<std::int64_t>("/", "row_offset"), expected.row_offset);
    EXPECT_EQ(file.read<std::int64_t>("rows/offsets"), expected.row_offsets);
    EXPECT_EQ(file.read<int>("rows/slots"), expected.row_slots);
    EXPECT_EQ(file.read<int>("pairs/j"), expected.pair_j);
    std::vector<int> i;
    for (std::size_t slot = 0; slot + 1 < expected.pair_offsets.size(); ++slot)
        i.resize(static_cast<std::size_t>(expected.pair_offsets[slot + 1]), static_cast<int>(slot));
    EXPECT_EQ(file.read<int>("pairs/i"), i);
}

}  // namespace connectivity::test
