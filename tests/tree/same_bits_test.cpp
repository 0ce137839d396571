// SPDX-License-Identifier: BSD-3-Clause
// The same tree with any number of threads.

#include <gtest/gtest.h>

#include <support/hash.hpp>
#include <support/thread_bits.hpp>
#include <tree/tree_case.hpp>

namespace connectivity::test {
namespace {

void add_tree(Fnv1a& hash, const TreeView& t) {
    hash.add_view(t.box_parent_ids);
    hash.add_view(t.box_child_ids);
    hash.add_view(t.box_centers);
    hash.add_view(t.box_flags);
    hash.add_view(t.user_source_ids);
    hash.add_view(t.sorted_target_ids);
    for (const TreeParticles* kind : {&t.sources, &t.targets}) {
        hash.add_view(kind->positions);
        hash.add_view(kind->box_starts);
        hash.add_view(kind->box_counts_nonchild);
        hash.add_view(kind->bounding_box_min);
    }
}

/// Enough particles for several blocks and threads.
TreeCase large_case(TreeKind kind, bool radii) {
    TreeCase c;
    c.n_sources = 60000;
    c.n_targets = radii ? 50000 : -1;
    for (int i = 0; i < 3 * c.n(); ++i) c.x.push_back(std::pow(u01(1, i), 3));
    c.target_radii = radii;
    if (radii) {
        c.options.stick_out_factor = 0.25;
        for (int i = 0; i < c.n(); ++i) c.radii.push_back(std::exp2(-12 + 10 * u01(2, i)));
    }
    c.options.kind = kind;
    c.options.max_particles_in_box = 30;
    c.options.hulls = Hulls::always;
    return c;
}

TEST(TreeBits, a_second_time_agrees) {
    std::uint64_t values[2];
    for (std::uint64_t& value : values) {
        Fnv1a hash;
        for (const bool radii : {false, true})
            for (const TreeKind kind : {TreeKind::adaptive, TreeKind::adaptive_level_restricted,
                                        TreeKind::non_adaptive}) {
                if (kind == TreeKind::non_adaptive && radii) continue;
                const TreeCase c = large_case(kind, radii);
                add_tree(hash, BuiltTree(c).view());
            }
        value = hash.value();
    }
    EXPECT_EQ(values[0], values[1]);
    print_fingerprint(values[0]);
}

TEST(TreeBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads("TreeBits.a_second_time_agrees");
}

}  // namespace
}  // namespace connectivity::test
