// SPDX-License-Identifier: BSD-3-Clause
// The same tree with any number of threads. Their number is fixed for a process, so this program
// runs itself and compares fingerprints.
#include <iostream>
#include <sstream>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/hash.hpp>
#include <support/process.hpp>
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
    std::cout << "\nfingerprint: " << runtime_threads() << " threads " << std::hex << values[0]
              << std::endl;
}

std::string fingerprint(const std::string& threads) {
    const RunResult run =
        run_this_test_program("TreeBits.a_second_time_agrees", "OMP_NUM_THREADS=" + threads);
    EXPECT_EQ(run.status, 0) << run.out;
    const std::string word = "fingerprint: " + threads + " threads ";
    const auto at = run.out.find(word);
    EXPECT_NE(at, std::string::npos) << run.out;
    return at == std::string::npos ? "" : run.out.substr(at + word.size(), 16);
}

TEST(TreeBits, one_two_and_three_threads_agree) {
    start_runtime();
    if (runtime_description().find("OpenMP") == std::string::npos)
        GTEST_SKIP() << "this Kokkos has no OpenMP: " << runtime_description();
    const std::string one = fingerprint("1");
    EXPECT_EQ(fingerprint("2"), one);
    EXPECT_EQ(fingerprint("3"), one);
}

}  // namespace
}  // namespace connectivity::test
