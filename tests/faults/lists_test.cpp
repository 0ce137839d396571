// SPDX-License-Identifier: BSD-3-Clause
// Box trees and interaction lists in C++ without memory, at every allocation: what there was stays;
// and what a rebuild allocates when it has all it needs.

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/lists/traversal.hpp>
#include <connectivity/tree/box_tree.hpp>
#include <support/hash.hpp>
#include <support/random.hpp>

#include "fail_each_allocation.hpp"

namespace connectivity::test {
namespace {

/// A cloud towards a corner, with radii: all kinds of lists have entries.
struct Cloud {
    Cloud(int n, std::uint64_t seed) {
        Random random(seed);
        for (int i = 0; i < 2 * n; ++i) {
            x.push_back(std::pow(random.uniform(), 4));
            y.push_back(std::pow(random.uniform(), 2));
        }
        for (int i = 0; i < n; ++i) r.push_back(random.log_uniform(1e-5, 0.05));
    }
    TreeInput input() const {
        const auto n = static_cast<Offset>(r.size());
        TreeInput in;
        in.dim = 2;
        in.sources = ParticleArray::interleaved(x.data(), n, 2);
        in.targets = ParticleArray::interleaved(y.data(), n, 2);
        in.targets->radii = r.data();
        return in;
    }
    static TreeOptions options(TreeKind kind = TreeKind::adaptive, bool periodic = false) {
        TreeOptions options;
        options.max_particles_in_box = 4;
        options.stick_out_factor = 0.25;
        options.kind = kind;
        options.budget.bytes = 1 << 30;  // without it the system is asked, which may fail unnoticed
        options.periodic = {periodic, periodic, false};
        if (periodic) options.bounding_box = {{}, {1, 1, 0}};
        return options;
    }
    std::vector<double> x, y, r;
};

std::uint64_t fingerprint(const TreeView& tree) {
    Fnv1a hash;
    hash.add_view(tree.box_parent_ids);
    hash.add_view(tree.box_child_ids);
    hash.add_view(tree.box_flags);
    hash.add_view(tree.user_source_ids);
    hash.add_view(tree.sorted_target_ids);
    hash.add_view(tree.targets.positions);
    hash.add_view(tree.targets.bounding_box_max);
    return hash.value();
}

std::uint64_t fingerprint(const FMMTraversalInfo& lists) {
    Fnv1a hash;
    const auto add = [&](const BoxList& list) {
        hash.add_view(list.starts);
        hash.add_view(list.lists);
        hash.add_view(list.images);
    };
    hash.add_view(lists.target_boxes());
    add(lists.same_level_non_well_sep_boxes());
    add(lists.neighbor_source_boxes());
    add(lists.from_sep_siblings());
    add(lists.from_sep_bigger());
    add(*lists.from_sep_close_smaller());
    add(*lists.from_sep_close_bigger());
    for (int level = 0; level < lists.nlevels(); ++level) add(lists.from_sep_smaller(level));
    return hash.value();
}

class TreeFaults : public ::testing::Test {
protected:
    void SetUp() override {
        if (!can_fail) GTEST_SKIP() << "the sanitizer has a malloc of its own";
        // The OpenMP runtime ends the process where it lacks memory; one thread takes none.
        start_runtime({.n_threads = 1});
    }
};

TEST_F(TreeFaults, a_tree_that_lacks_memory_stays_the_old_one) {
    const Cloud old(60, 1), now(150, 2);
    for (const TreeKind kind :
         {TreeKind::adaptive, TreeKind::adaptive_level_restricted, TreeKind::non_adaptive}) {
        BoxTree tree;
        tree.build(old.input(), Cloud::options());
        const std::uint64_t before = fingerprint(tree.view());
        TreeOptions options = Cloud::options(kind);
        if (kind == TreeKind::non_adaptive) options.max_particles_in_box = 60;
        const long n = fail_each_allocation([&] { tree.build(now.input(), options); },
                                            [&] { ASSERT_EQ(fingerprint(tree.view()), before); });
        EXPECT_GT(n, 30);
        EXPECT_NE(fingerprint(tree.view()), before);
        tree.build(old.input(), Cloud::options());
        EXPECT_EQ(fingerprint(tree.view()), before);
    }
}

TEST_F(TreeFaults, so_do_lists_whether_they_grow_or_reuse_what_there_is) {
    const Cloud few(40, 3), many(150, 4);
    for (const bool grow : {true, false})
        for (const bool periodic : {false, true}) {
            const Cloud &old = grow ? few : many, &now = grow ? many : few;
            BoxTree old_tree, tree;
            old_tree.build(old.input(), Cloud::options());
            tree.build(now.input(), Cloud::options(TreeKind::adaptive, periodic));
            FMMTraversalInfo lists(old_tree.view());
            const std::uint64_t before = fingerprint(lists);
            const long n =
                fail_each_allocation([&] { lists.rebuild(tree.view()); },
                                     [&] {
                                         ASSERT_EQ(lists.nboxes(), old_tree.view().n_boxes);
                                         ASSERT_EQ(fingerprint(lists), before);
                                     });
            EXPECT_GT(n, 20);
            EXPECT_EQ(fingerprint(lists), fingerprint(FMMTraversalInfo(tree.view())));
            lists.rebuild(old_tree.view());
            EXPECT_EQ(fingerprint(lists), before);
        }
}

TEST_F(TreeFaults, a_merge_that_lacks_memory_leaves_the_lists) {
    const Cloud cloud(100, 5);
    BoxTree tree;
    tree.build(cloud.input(), Cloud::options());
    const FMMTraversalInfo lists(tree.view());
    const std::uint64_t before = fingerprint(lists);
    fail_each_allocation([&] { lists.merge_close_lists(); },
                         [&] { ASSERT_EQ(fingerprint(lists), before); });
}

TEST_F(TreeFaults, lists_of_the_same_size_allocate_nothing_but_names) {
    const Cloud cloud(20000, 6);
    for (const bool periodic : {false, true}) {
        BoxTree tree;
        tree.build(cloud.input(), Cloud::options(TreeKind::adaptive, periodic));
        FMMTraversalInfo lists;
        Offset bytes[3];
        for (Offset& taken : bytes) {
            allocated_bytes = 0;
            lists.rebuild(tree.view());
            taken = allocated_bytes;
        }
        EXPECT_GT(bytes[0], 1 << 20);
        EXPECT_LT(bytes[2], 16 << 10);
    }
}

}  // namespace
}  // namespace connectivity::test
