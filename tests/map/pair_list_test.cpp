// SPDX-License-Identifier: BSD-3-Clause
// The pair list: order, uniqueness, lookup, the expanded first slots.

#include <set>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

Case random_pairs(std::uint64_t seed) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 120, 20});
    c.mode = SearchMode::gather_scatter;
    return c;
}

using Pairs = std::set<std::pair<Slot, Slot>>;

/// Unordered pairs with at least one stored row, from the definition.
Pairs pairs_of(const Case& c) {
    const Expected e = brute_force(c);
    Pairs pairs;
    for (std::size_t i = 0; i + 1 < e.pair_offsets.size(); ++i)
        for (Offset p = e.pair_offsets[i]; p < e.pair_offsets[i + 1]; ++p)
            pairs.insert({static_cast<Slot>(i), e.pair_j[static_cast<std::size_t>(p)]});
    return pairs;
}

TEST(PairList, each_pair_appears_once_and_in_order) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        const auto pairs = map.pairs().view();
        Pairs seen;
        for (Offset k = 0; k < pairs.size(); ++k) {
            const auto [i, j] = pairs[k];
            ASSERT_LT(i, j) << c.text;
            ASSERT_TRUE(map.layout().is_stored(i) || map.layout().is_stored(j)) << c.text;
            if (k > 0) {
                ASSERT_LT(std::pair(pairs[k - 1].i, pairs[k - 1].j), std::pair(i, j)) << c.text;
            }
            seen.insert({i, j});
        }
        ASSERT_EQ(seen, pairs_of(c)) << c.text;
        ASSERT_EQ(map.pairs().size(), static_cast<Offset>(seen.size()));
    }
}

TEST(PairList, lookup_finds_every_pair_in_both_orientations_and_no_other) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Case c = random_pairs(seed);
        const Pairs want = pairs_of(c);
        ConnectivityMap map;
        rebuild(map, c);
        const auto pairs = map.pairs().view();
        const auto n = static_cast<Slot>(c.n_slots());
        for (Slot i = 0; i < n; ++i)
            for (Slot j = i; j < n; ++j) {
                const Offset k = pairs.find(i, j);
                ASSERT_EQ(k >= 0, want.contains({i, j})) << c.text;
                ASSERT_EQ(pairs.find(j, i), k);
                ASSERT_TRUE(k < 0 || (pairs[k].i == i && pairs[k].j == j));
            }
    }
}

TEST(PairList, lookup_of_slots_out_of_range_finds_nothing) {
    ConnectivityMap map;
    rebuild(map, uniform_case(1, {0, 1, 2}, 1));
    const auto pairs = map.pairs().view();
    EXPECT_EQ(pairs.find(-1, 0), -1);
    EXPECT_EQ(pairs.find(0, 3), -1);
    EXPECT_EQ(pairs.find(3, 4), -1);
    EXPECT_EQ(pairs.find(-5, 1000), -1);
    EXPECT_EQ(pairs.find(1, 1), -1);
}

TEST(PairList, expanded_first_slots_agree_with_the_offsets) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        ConnectivityMap map;
        rebuild(map, random_pairs(seed));
        const auto flat = map.pairs().expanded_view();
        const auto packed = map.pairs().view();
        ASSERT_EQ(flat.size(), packed.size());
        ASSERT_EQ(static_cast<Offset>(flat.i.size()), flat.size());
        for (Offset k = 0; k < flat.size(); ++k) {
            ASSERT_EQ(flat[k].i, packed[k].i);
            ASSERT_EQ(flat[k].j, packed[k].j);
        }
        EXPECT_EQ(map.pairs().expanded_view().i.data(), flat.i.data());  // made once per generation
    }
}

TEST(PairList, expansion_follows_every_rebuild) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Case c = random_pairs(seed);
        rebuild(map, c);
        const auto flat = map.pairs().expanded_view();
        EXPECT_EQ(flat.generation, map.generation());
        for (Slot i = 0; i < flat.n_slots(); ++i)
            for (Offset p = flat.offsets(i); p < flat.offsets(i + 1); ++p) ASSERT_EQ(flat.i(p), i);
    }
}

TEST(PairList, two_slots_of_thirty_one_bits_do_not_collide) {
    const std::vector<Offset> offsets = {0, 2, 3, 4, 4};
    const std::vector<Slot> j = {1, 3, 2, 3};
    const NodePairList::View<> view{ConstView<Offset>(offsets.data(), offsets.size()),
                                    ConstView<Slot>(j.data(), j.size()),
                                    {},
                                    1};
    EXPECT_EQ(view.find(0, 3), 1);
    EXPECT_EQ(view.find(max_slots, max_slots - 1), -1);
    EXPECT_EQ(view.find(0, max_slots), -1);
    static_assert(std::is_same_v<Offset, std::int64_t> && std::is_same_v<Slot, std::int32_t>);
}

}  // namespace
}  // namespace connectivity::test
