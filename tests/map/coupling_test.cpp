// SPDX-License-Identifier: BSD-3-Clause
// Coupling of pairs: 1 and no storage unless set, only values in [0, 1], what a rebuild and a patch
// do to it.

#include <cmath>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

Case random_pairs(std::uint64_t seed) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 80, 0});
    c.mode = SearchMode::gather_scatter;
    return c;
}

constexpr auto factor = [](Slot i, Slot j) { return ((7 * i + 3 * j) % 101) / 100.0; };

TEST(Coupling, it_is_one_and_takes_no_memory_until_set) {
    ConnectivityMap map;
    rebuild(map, cloud(300, 1));
    NodePairList& pairs = map.pairs();
    const Offset bytes = pairs.bytes();
    EXPECT_FALSE(pairs.has_coupling());
    EXPECT_EQ(pairs.view().coupling.size(), 0u);
    EXPECT_EQ(pairs.coupling(5), 1);
    pairs.set_coupling(5, 0.25);
    EXPECT_EQ(pairs.bytes(), bytes + 8 * pairs.size());
    EXPECT_EQ(pairs.coupling(5), 0.25);
    EXPECT_EQ(pairs.coupling(6), 1);
    EXPECT_EQ(static_cast<Offset>(pairs.view().coupling.size()), pairs.size());
    pairs.clear_coupling();
    EXPECT_EQ(pairs.bytes(), bytes);
    EXPECT_EQ(pairs.coupling(5), 1);
}

TEST(Coupling, an_array_sets_every_pair_in_list_order) {
    for (const ListOrder order : {ListOrder::slot, ListOrder::key})
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const Case c = random_pairs(seed);
            MapOptions options = map_options(c);
            options.pairs = true, options.order = order;
            ConnectivityMap map;
            map.rebuild(node_lists(c), options);
            NodePairList& pairs = map.pairs();
            std::vector<double> values(static_cast<std::size_t>(pairs.size()));
            for (std::size_t k = 0; k < values.size(); ++k)
                values[k] = static_cast<double>(k % 97) / 97;
            pairs.set_coupling(std::span<const double>(values));
            for (std::size_t k = 0; k < values.size(); ++k)
                ASSERT_EQ(pairs.coupling(static_cast<Offset>(k)), values[k]) << c.text;
            std::vector<double> longer = values;
            longer.push_back(0);
            EXPECT_TRUE(fails_with(
                Status::argument,
                {std::to_string(longer.size()) + " values", std::to_string(values.size())},
                [&] { pairs.set_coupling(std::span<const double>(longer)); }));
            if (values.empty()) continue;
            const std::size_t bad = values.size() / 2;
            std::vector<double> spoilt = values;
            spoilt[bad] = std::nan(""), spoilt.back() = 2;
            const std::size_t first = std::min(bad, values.size() - 1);
            EXPECT_TRUE(fails_with(Status::argument, {"pair " + std::to_string(first), "[0, 1]"},
                                   [&] { pairs.set_coupling(std::span<const double>(spoilt)); }));
            EXPECT_EQ(pairs.coupling(0), values[0]);
        }
}

TEST(Coupling, a_functor_sets_every_pair) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Case c = random_pairs(seed);
        const Expected e = brute_force(c);
        ConnectivityMap map;
        rebuild(map, c);
        map.pairs().set_coupling(factor);
        const auto view = map.pairs().view();
        ASSERT_EQ(view.coupling.size(), e.pair_j.size()) << c.text;
        for (std::size_t i = 0; i + 1 < e.pair_offsets.size(); ++i)
            for (Offset k = e.pair_offsets[i]; k < e.pair_offsets[i + 1]; ++k) {
                const double want =
                    factor(static_cast<Slot>(i), e.pair_j[static_cast<std::size_t>(k)]);
                ASSERT_EQ(map.pairs().coupling(k), want) << c.text;
                ASSERT_EQ(view.coupling(k), want);
            }
    }
}

TEST(Coupling, a_functor_sees_the_nodes_of_the_pair_in_key_order_too) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        MapOptions options = map_options(c);
        options.order = ListOrder::key;
        map.rebuild(node_lists(c), options);
        map.pairs().set_coupling(factor);
        const auto flat = map.pairs().expanded_view();
        for (Offset k = 0; k < flat.size(); ++k)
            ASSERT_EQ(flat.coupling(k), factor(flat.i(k), flat.j(k))) << c.text;
    }
}

TEST(Coupling, a_value_that_is_not_in_zero_to_one_is_refused_and_the_old_ones_stay) {
    ConnectivityMap map;
    rebuild(map, cloud(2000, 3, 0.06));
    NodePairList& pairs = map.pairs();
    ASSERT_GT(pairs.size(), 10000);
    const auto view = pairs.view();
    for (const double bad : {-1e-300, 1 + 1e-15, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
        const Offset first = 777, second = 9000;
        const auto broken = [&](Slot i, Slot j) {
            const Offset k = view.find(i, j);
            return k == first || k == second ? bad : 0.5;
        };
        const std::vector<std::string> words = {
            "pair 777",
            "slots " + std::to_string(view[first].i) + " and " + std::to_string(view[first].j),
            "[0, 1]"};
        EXPECT_TRUE(fails_with(Status::argument, words, [&] { pairs.set_coupling(broken); }));
        EXPECT_FALSE(pairs.has_coupling());
        EXPECT_TRUE(fails_with(Status::argument, words, [&] { pairs.set_coupling(first, bad); }));
        EXPECT_FALSE(pairs.has_coupling());
    }
    pairs.set_coupling(factor);
    EXPECT_TRUE(fails_with(Status::argument, {"= 2"},
                           [&] { pairs.set_coupling([](Slot, Slot) { return 2.0; }); }));
    EXPECT_TRUE(fails_with(Status::argument, {"pair -1"}, [&] { pairs.set_coupling(-1, 0.5); }));
    EXPECT_TRUE(fails_with(Status::argument, {"must be in [0, " + std::to_string(pairs.size())},
                           [&] { pairs.set_coupling(pairs.size(), 0.5); }));
    for (Offset k = 0; k < pairs.size(); ++k)
        ASSERT_EQ(pairs.coupling(k), factor(view[k].i, view[k].j));
}

TEST(Coupling, what_a_functor_throws_arrives_and_the_old_values_stay) {
    ConnectivityMap map;
    rebuild(map, cloud(2000, 3, 0.06));
    NodePairList& pairs = map.pairs();
    pairs.set_coupling([](Slot, Slot) { return 0.5; });
    const auto broken = [](Slot i, Slot) -> double {
        if (i == 1234) throw std::domain_error("no damage");
        return 0;
    };
    EXPECT_THROW(pairs.set_coupling(broken), std::domain_error);
    for (Offset k = 0; k < pairs.size(); ++k) ASSERT_EQ(pairs.coupling(k), 0.5);
}

TEST(Coupling, views_keep_the_values_they_saw) {
    ConnectivityMap map;
    rebuild(map, cloud(300, 1));
    NodePairList& pairs = map.pairs();
    pairs.set_coupling([](Slot, Slot) { return 0.5; });
    const auto view = pairs.view();
    pairs.set_coupling(0, 0.0);
    EXPECT_EQ(view.coupling(0), 0.5);
    EXPECT_EQ(pairs.coupling(0), 0.0);
    EXPECT_EQ(pairs.coupling(1), 0.5);
    const auto later = pairs.view();
    for (int round = 0; round < 4; ++round) pairs.set_coupling(factor);
    EXPECT_EQ(later.coupling(0), 0.0);
    EXPECT_EQ(later.coupling(1), 0.5);
    EXPECT_EQ(view.coupling(0), 0.5);
}

TEST(Coupling, a_rebuild_forgets_it_and_setting_it_again_takes_no_new_memory) {
    ConnectivityMap map;
    rebuild(map, cloud(300, 1));
    map.pairs().set_coupling(factor);
    const double* const memory = map.pairs().view().coupling.data();
    rebuild(map, cloud(290, 1));
    EXPECT_FALSE(map.pairs().has_coupling());
    EXPECT_EQ(map.pairs().coupling(3), 1);
    map.pairs().set_coupling(3, 0.5);
    EXPECT_EQ(map.pairs().view().coupling.data(), memory);
}

TEST(Coupling, memory_that_nobody_asks_for_any_more_goes_back) {
    const Case c = cloud(300, 1);
    ConnectivityMap map;
    for (int round = 0; round < 4; ++round) rebuild(map, c);  // lists keep their size from here on
    const Offset bytes = map.pairs().bytes();
    map.pairs().set_coupling(factor);
    rebuild(map, c);
    EXPECT_EQ(map.pairs().bytes(), bytes + 8 * map.pairs().size());
    rebuild(map, c);
    EXPECT_EQ(map.pairs().bytes(), bytes);
    map.pairs().set_coupling(factor);
    MapOptions no_pairs = map_options(c);
    no_pairs.pairs = false;
    map.rebuild(node_lists(c), no_pairs);
    EXPECT_EQ(map.report().find("pairs")->bytes, 0);
}

TEST(Coupling, a_list_that_was_never_built_has_no_pairs_to_couple) {
    NodePairList pairs;
    EXPECT_TRUE(
        fails_with(Status::not_built, {"set_coupling"}, [&] { pairs.set_coupling(factor); }));
    EXPECT_TRUE(fails_with(Status::not_built, {"set_coupling"}, [&] { pairs.set_coupling(0, 1); }));
}

TEST(Coupling, no_pairs_are_coupled_without_error) {
    ConnectivityMap map;
    rebuild(map, uniform_case(1, {0, 10}, 1));
    map.pairs().set_coupling([](Slot, Slot) { return 5.0; });
    EXPECT_EQ(map.pairs().size(), 0);
}

TEST(Coupling, a_patch_carries_the_values_of_surviving_pairs) {
    start_runtime();
    const std::vector<Offset> offsets = {0, 2, 3, 3};
    const std::vector<Slot> j = {1, 2, 2};
    const ConstView<Offset> all(offsets.data(), offsets.size());
    const ConstView<Slot> partners(j.data(), j.size());
    const std::vector<Offset> kept = {0, 2};
    PairCoupling coupling;
    coupling.prepare_remap(ConstView<Offset>(kept.data(), kept.size()));
    coupling.commit_remap();
    EXPECT_FALSE(coupling.exists());
    coupling.set({all, partners, {}}, NodeCoupling(factor));
    coupling.prepare_remap(ConstView<Offset>(kept.data(), kept.size()));
    coupling.abandon_remap();
    EXPECT_EQ(coupling.values().size(), 3u);
    coupling.prepare_remap(ConstView<Offset>(kept.data(), kept.size()));
    coupling.commit_remap();
    ASSERT_EQ(coupling.values().size(), 2u);
    EXPECT_EQ(coupling[0], factor(0, 1));
    EXPECT_EQ(coupling[1], factor(1, 2));
}

}  // namespace
}  // namespace connectivity::test
