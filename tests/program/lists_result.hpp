// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A result of `connectivity lists` compared with a file of boxtree's answers, name by name:
/// integers exactly, floats to 1e-13 of the largest in the array (1e-6 in single precision), types
/// and shapes.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <io/plain_hdf5.hpp>

namespace connectivity::test {

/// Is it one that the program writes? Lookups and linked sources are for hosts.
inline bool is_result_name(const std::string& name) {
    if (name.find("point_source") != std::string::npos) return false;
    for (const char* prefix : {"tree_", "trav_", "merged_", "tc_", "tcall_", "rot_"})
        if (name.starts_with(prefix)) return true;
    return false;
}

inline std::vector<std::string> result_names(const PlainFile& file) {
    std::vector<std::string> names;
    for (const auto& name : file.names())
        if (is_result_name(name)) names.push_back(name);
    return names;
}

template <class T>
void expect_same_type(const std::string& name, const PlainFile& ours, const PlainFile& theirs) {
    EXPECT_EQ(ours.is_stored_as<T>(name), theirs.is_stored_as<T>(name)) << name;
}

inline void expect_close(const std::string& name, const PlainFile& ours, const PlainFile& theirs,
                         double tolerance) {
    const auto a = ours.read<double>(name), b = theirs.read<double>(name);
    const Extents extents = theirs.extents(name);
    const std::size_t columns = extents.empty() ? 1 : extents.back();
    const bool padded = name.find("box_centers") != std::string::npos ||
                        name.find("bounding_box") != std::string::npos;
    const std::size_t used =
        padded ? static_cast<std::size_t>(theirs.read<int>("tree_nboxes").at(0)) : columns;
    double scale = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (i % columns < used) scale = std::max(scale, std::abs(b[i]));
    for (std::size_t i = 0; i < b.size(); ++i)
        if (i % columns < used) {
            ASSERT_NEAR(a[i], b[i], tolerance * scale) << name << " " << i;
        }
}

/// One array or single value.
inline void expect_same_array(const std::string& name, const PlainFile& ours,
                              const PlainFile& theirs) {
    ASSERT_TRUE(ours.has(name)) << name;
    ASSERT_EQ(ours.extents(name), theirs.extents(name)) << name;
    expect_same_type<std::uint8_t>(name, ours, theirs);
    expect_same_type<int>(name, ours, theirs);
    expect_same_type<std::int64_t>(name, ours, theirs);
    expect_same_type<float>(name, ours, theirs);
    expect_same_type<double>(name, ours, theirs);
    if (theirs.is_stored_as<float>(name))
        expect_close(name, ours, theirs, 1e-6);
    else if (theirs.is_stored_as<double>(name))
        expect_close(name, ours, theirs, theirs.is_stored_as<float>("in_sources") ? 1e-6 : 1e-13);
    else
        EXPECT_EQ(ours.read<std::int64_t>(name), theirs.read<std::int64_t>(name)) << name;
}

/// All names of the one file that the program writes.
inline void expect_same_result(const std::string& our_path, const std::string& their_path) {
    const auto ours = PlainFile::open(our_path), theirs = PlainFile::open(their_path);
    for (const auto& name : result_names(theirs)) expect_same_array(name, ours, theirs);
}

}  // namespace connectivity::test
