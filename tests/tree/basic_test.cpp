// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <connectivity/tree/box_tree.hpp>

namespace connectivity::test {
namespace {

TEST(BoxTree, without_particles_is_its_root) {
    BoxTree tree;
    EXPECT_EQ(tree.view().n_boxes, 0);
    TreeOptions options;
    options.max_particles_in_box = 1;
    tree.build({}, options);
    EXPECT_EQ(tree.view().n_boxes, 1);
    EXPECT_EQ(tree.view().n_levels, 1);
    EXPECT_EQ(tree.view().box_flags(0), 0);
}

}  // namespace
}  // namespace connectivity::test
