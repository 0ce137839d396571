// SPDX-License-Identifier: BSD-3-Clause
// Neighbours of any two nodes together, pair or not, equal their definition, in either order of the
// two, and what a pair's row holds.

#include <gtest/gtest.h>

#include <support/brute_overlap.hpp>
#include <support/key_order.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

class AnyTwoNodes : public ::testing::TestWithParam<ListOrder> {
protected:
    void build(const Case& source) {
        c = source;
        c.ghost_rows = true;
        c.mode = SearchMode::gather_scatter;
        lists = node_lists(c);
        MapOptions options = map_options(c);
        options.order = GetParam();
        map.rebuild(lists, options);
    }

    /// Is slot i the first of a pair with j?
    bool is_before(Slot i, Slot j) const {
        if (GetParam() == ListOrder::slot) return i < j;
        const KeyOrderView<> order = map.key_order();
        return order.ranks(i) < order.ranks(j);
    }

    std::vector<Slot> between(const Sight& sight, Slot i, Slot j) const {
        if (!is_before(i, j)) std::swap(i, j);
        std::vector<Slot> row;
        for (const Slot k : sight.intersection(i, j))
            if (k == i || k == j || is_in_segment(c, i, j, k)) row.push_back(k);
        return row;
    }

    Case c;
    std::vector<NodeList> lists;
    ConnectivityMap map;
};

TEST_P(AnyTwoNodes, common_and_all_neighbours_are_those_of_the_definition) {
    for (std::uint64_t seed = 2000; seed < 2300; ++seed) {
        build(random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 60, 1}));
        const Sight sight(c);
        if (sight.n() == 0) continue;
        Random random(seed);
        for (int trial = 0; trial < 40; ++trial) {
            const Slot a = random.below(sight.n()), b = random.below(sight.n());
            ASSERT_EQ(map.common_neighbours(a, b), sight.intersection(a, b)) << c.text;
            const std::vector<Slot> inside = map.common_neighbours(a, b, lists);
            ASSERT_EQ(inside, between(sight, a, b)) << c.text;
            ASSERT_EQ(map.common_neighbours(b, a, lists), inside) << c.text;
            std::vector<Slot> either;
            for (Slot k = 0; k < sight.n(); ++k)
                if (sight.neighbours(k, a) || sight.neighbours(k, b)) either.push_back(k);
            ASSERT_EQ(map.all_neighbours(a, b), either) << c.text;
        }
    }
}

TEST_P(AnyTwoNodes, coincident_ends_let_every_common_neighbour_pass) {
    using Slots = std::vector<Slot>;
    build(uniform_case(1, {0, 0, 0.5, -0.5, 2}, 0.5));
    EXPECT_EQ(map.common_neighbours(0, 1, lists), (Slots{0, 1, 2, 3}));
    EXPECT_EQ(map.common_neighbours(0, 0, lists), (Slots{0, 1, 2, 3}));
    EXPECT_EQ(map.common_neighbours(0, 2, lists), (Slots{0, 1, 2}));
    EXPECT_EQ(map.common_neighbours(4, 4, lists), (Slots{4}));
}

INSTANTIATE_TEST_SUITE_P(All, AnyTwoNodes, ::testing::Values(ListOrder::slot, ListOrder::key),
                         [](const auto& kind) {
                             return std::string(kind.param == ListOrder::key ? "by_key"
                                                                             : "by_slot");
                         });

}  // namespace
}  // namespace connectivity::test
