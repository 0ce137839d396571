// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The oracle: every node against every other, written from the definition and sharing no code
/// with the library's search.

#include <vector>

#include <gtest/gtest.h>

#include <support/case.hpp>

namespace connectivity::test {

/// What the library has to deliver, as plain arrays.
struct Expected {
    std::vector<Offset> list_offset, row_offset;  ///< [n_lists + 1]
    std::vector<Offset> row_offsets;              ///< [n_rows * n_lists + 1]
    std::vector<Slot> row_slots;
    std::vector<Offset> pair_offsets;  ///< [n_slots + 1]; empty where the mode has no pairs
    std::vector<Slot> pair_j;
};

/// Does slot i see slot j? (The definition, for any two different slots.)
bool sees(const Case& c, Offset i, Offset j);

Expected brute_force(const Case& c);

/// Whether rows, pairs and layout of a map are what is expected; says where they first differ.
::testing::AssertionResult equals(const ConnectivityMap& map, const Expected& expected);
::testing::AssertionResult rows_equal(const RowsView<>& rows, const Expected& expected);
::testing::AssertionResult pairs_equal(const NodePairList::View<>& pairs, const Expected& expected);

}  // namespace connectivity::test
