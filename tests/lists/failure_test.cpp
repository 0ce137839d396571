// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/work.hpp>

#include "support/expect_error.hpp"

namespace connectivity::test {
namespace {

TEST(EmptyTraversal, has_no_boxes_and_no_lists) {
    const FMMTraversalInfo none;
    EXPECT_EQ(none.nboxes(), 0);
    EXPECT_EQ(none.ntarget_boxes(), 0);
    EXPECT_TRUE(fails_with(Status::not_built, {"neighbor_source_boxes"},
                           [&] { none.neighbor_source_boxes(); }));
    EXPECT_TRUE(fails_with(Status::not_built, {"from_sep_siblings"},
                           [&] { TranslationClassesInfo classes(none); }));
    EXPECT_EQ(count_work(none).total, Work{});
}

}  // namespace
}  // namespace connectivity::test
