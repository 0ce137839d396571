// SPDX-License-Identifier: BSD-3-Clause
// Slots and rows: a numbering without gaps, in both directions.

#include <gtest/gtest.h>

#include <connectivity/search/layout.hpp>

namespace connectivity::test {
namespace {

using Sizes = std::vector<ListSize>;

const Sizes all_sizes[] = {{},
                           {{0, 0}},
                           {{5, 5}},
                           {{5, 2}},
                           {{5, 0}},
                           {{0, 0}, {3, 1}},
                           {{3, 1}, {0, 0}},
                           {{3, 1}, {0, 0}, {0, 0}, {2, 2}, {0, 0}, {4, 0}, {1, 1}}};

TEST(Layout, slots_and_rows_are_numbered_list_by_list_without_gaps) {
    for (const Sizes& sizes : all_sizes)
        for (const bool ghost_rows : {false, true}) {
            const SlotLayout layout(sizes, ghost_rows);
            Offset slot = 0, row = 0;
            ASSERT_EQ(layout.n_lists(), static_cast<int>(sizes.size()));
            for (std::size_t l = 0; l < sizes.size(); ++l) {
                EXPECT_EQ(layout.list_offset()[l], slot);
                EXPECT_EQ(layout.row_offset()[l], row);
                const Offset stored = ghost_rows ? sizes[l].n : sizes[l].n_internal;
                for (Offset a = 0; a < sizes[l].n; ++a, ++slot) {
                    EXPECT_EQ(layout.list_of_slot(slot), static_cast<int>(l));
                    EXPECT_EQ(layout.is_stored(slot), a < stored);
                    EXPECT_EQ(layout.row_of_slot(slot), a < stored ? row : -1);
                    if (a >= stored) continue;
                    EXPECT_EQ(layout.list_of_row(row), static_cast<int>(l));
                    EXPECT_EQ(layout.slot_of_row(row), slot);
                    ++row;
                }
            }
            EXPECT_EQ(layout.n_slots(), slot);
            EXPECT_EQ(layout.n_rows(), row);
        }
}

TEST(Layout, equal_sizes_give_equal_layouts) {
    EXPECT_EQ(SlotLayout({{3, 1}, {2, 2}}, false), SlotLayout({{3, 1}, {2, 2}}, false));
    EXPECT_NE(SlotLayout({{3, 1}, {2, 2}}, false), SlotLayout({{3, 1}, {2, 2}}, true));
    EXPECT_NE(SlotLayout({{3, 1}}, false), SlotLayout({{3, 2}}, false));
    EXPECT_EQ(SlotLayout(), SlotLayout({}, false));
}

}  // namespace
}  // namespace connectivity::test
