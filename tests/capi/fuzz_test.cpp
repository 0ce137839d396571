// SPDX-License-Identifier: BSD-3-Clause
// Garbage in every argument: any status may come back, but the library stays whole. Pointers are
// NULL, live, dead or point to enough memory; everything else is random bytes.

#include "fuzz_calls.hpp"

namespace connectivity::test {
namespace {

TEST(CapiFuzz, garbage_never_breaks_the_library) {
    int n_built = 0, n_views = 0, n_traversed = 0, n_patched = 0, n_summed = 0, n_bounded = 0;
    int n_estimated = 0;
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
        Fuzz fuzz(seed);
        for (int k = 0; k < 4000; ++k) fuzz.call();
        n_built += fuzz.n_built;
        n_views += fuzz.n_views;
        n_traversed += fuzz.n_traversed;
        n_patched += fuzz.n_patched;
        n_summed += fuzz.n_summed;
        n_bounded += fuzz.n_bounded;
        n_estimated += fuzz.n_estimated;
    }
    EXPECT_GT(n_built, 50) << "too much of the garbage was refused at the door";
    EXPECT_GT(n_views, 50);
    EXPECT_GT(n_traversed, 50);
    EXPECT_GT(n_patched, 20);
    EXPECT_GT(n_summed, 20);
    EXPECT_GT(n_bounded, 20);
    EXPECT_GT(n_estimated, 20);
    const NodeSet set = random_nodes(3, 100, 1);
    EXPECT_EQ(lists_of(Context(), 3, {set}), brute_force(3, {set}));
}

}  // namespace
}  // namespace connectivity::test
