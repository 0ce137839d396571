// SPDX-License-Identifier: BSD-3-Clause
// Thousands of random problems: every search method gives exactly what brute force gives.

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

class RandomCases : public ::testing::TestWithParam<std::tuple<int, bool>> {
protected:
    static CaseKind kind(int min_nodes, int max_nodes) {
        const auto [dim, periodic] = GetParam();
        return {dim, periodic, max_nodes, min_nodes};
    }

    /// One map for all cases, so that storage of every build serves the next one.
    void check(std::uint64_t first, std::uint64_t n_cases, const CaseKind& kind) {
        for (std::uint64_t seed = first; seed < first + n_cases; ++seed) {
            const Case c = random_case(seed, kind);
            const Expected expected = brute_force(c);
            for (const SearchMethod method : all_methods) {
                rebuild(map_, c, method);
                ASSERT_TRUE(equals(map_, expected)) << name_of(method) << ", " << c.text;
                if (expected.pair_offsets.empty()) continue;
                MapOptions pairs_only = map_options(c, method);
                pairs_only.rows = false;
                map_.rebuild(node_lists(c), pairs_only);
                ASSERT_TRUE(pairs_equal(map_.pairs().view(), expected))
                    << "pairs alone, " << name_of(method) << ", " << c.text;
            }
        }
    }

private:
    ConnectivityMap map_;
};

TEST_P(RandomCases, small_ones_equal_brute_force_in_every_method) { check(0, 800, kind(0, 200)); }

TEST_P(RandomCases, larger_ones_equal_brute_force_in_every_method) {
    check(5000, 10, kind(600, 2500));
}

std::string name_of_kind(const ::testing::TestParamInfo<std::tuple<int, bool>>& info) {
    const auto [dim, periodic] = info.param;
    return std::to_string(dim) + "d_" + (periodic ? "periodic" : "open");
}

INSTANTIATE_TEST_SUITE_P(All, RandomCases,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Bool()),
                         name_of_kind);

}  // namespace
}  // namespace connectivity::test
