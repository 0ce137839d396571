// SPDX-License-Identifier: BSD-3-Clause
// Sums over pairs at their nodes, in three ways, against a loop over pairs from the definition.

#include <map>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/pair_sum.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

Case random_pairs(std::uint64_t seed, int max_nodes = 100) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, max_nodes, 0});
    c.mode = SearchMode::gather_scatter;
    return c;
}

struct Pair {
    Slot i, j;
};

/// In the order of the list, from the definition.
std::vector<Pair> pairs_of(const Case& c) {
    const Expected e = brute_force(c);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i + 1 < e.pair_offsets.size(); ++i)
        for (Offset p = e.pair_offsets[i]; p < e.pair_offsets[i + 1]; ++p)
            pairs.push_back({static_cast<Slot>(i), e.pair_j[static_cast<std::size_t>(p)]});
    return pairs;
}

/// Whole numbers: sums are exact in any order.
constexpr auto whole = [](Offset k, Slot i, Slot j) {
    return PairContribution<double, 2>{{static_cast<double>(k), 3.0 * i + j},
                                       {static_cast<double>(-2 * k), 7.0 * j - i}};
};

using Sums = std::vector<double>;

/// Start values that are neither zero nor equal.
View<double> started(Offset n) {
    View<double> out("out", static_cast<std::size_t>(n));
    for (Offset s = 0; s < n; ++s) out(s) = static_cast<double>(5 * s);
    return out;
}

Sums expected(const Case& c) {
    const auto n = static_cast<std::size_t>(2 * c.n_slots());
    Sums sums(n);
    for (std::size_t s = 0; s < n; ++s) sums[s] = 5.0 * static_cast<double>(s);
    Offset k = 0;
    for (const auto& [i, j] : pairs_of(c)) {
        const auto add = whole(k++, i, j);
        for (std::size_t e = 0; e < 2; ++e) {
            sums[2 * static_cast<std::size_t>(i) + e] += add.i[e];
            sums[2 * static_cast<std::size_t>(j) + e] += add.j[e];
        }
    }
    return sums;
}

::testing::AssertionResult same(const View<double>& got, const Sums& want) {
    for (std::size_t s = 0; s < want.size(); ++s)
        if (got(s) != want[s])
            return ::testing::AssertionFailure()
                   << "sum " << s << " is " << got(s) << " instead of " << want[s];
    return ::testing::AssertionSuccess();
}

TEST(RowPairs, every_entry_has_the_number_of_its_pair) {
    RowPairs kept;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        kept.rebuild(map);
        std::map<std::pair<Slot, Slot>, Offset> numbers;
        for (const auto& [i, j] : pairs_of(c))
            numbers.insert({{i, j}, static_cast<Offset>(numbers.size())});
        const auto of = kept.view(map);
        ASSERT_EQ(of.size(), of.rows.size());
        ASSERT_EQ(static_cast<Offset>(of.slot.size()), of.rows.n_rows());
        for (Offset row = 0; row < of.rows.n_rows(); ++row) {
            const auto a = static_cast<Slot>(map.layout().slot_of_row(row));
            ASSERT_EQ(of.slot(row), a) << c.text;
            for (const Slot& b : of.rows[row])
                ASSERT_EQ(of[&b - of.rows.data()], (numbers.at({std::min(a, b), std::max(a, b)})))
                    << c.text;
        }
    }
}

TEST(RowPairs, they_need_rows_and_pairs_of_the_same_rebuild) {
    const Case c = cloud(200, 1);
    ConnectivityMap map, twin;
    rebuild(map, c);
    rebuild(twin, c);
    RowPairs of(map);
    EXPECT_TRUE(of.is_current(map));
    EXPECT_TRUE(fails_with(Status::stale, {"row pairs"}, [&] { of.view(twin); }));
    MapOptions options;
    options.rows = false;
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::not_built, {"rows"}, [&] { of.rebuild(map); }));
    EXPECT_TRUE(fails_with(Status::stale, {"row pairs"}, [&] { of.view(map); }));
    options.rows = true, options.pairs = false;
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::not_built, {"pairs"}, [&] { of.rebuild(map); }));
    EXPECT_TRUE(fails_with(Status::stale, {}, [&] { RowPairs().view(twin); }));
    of.rebuild(twin);
    EXPECT_TRUE(of.is_current(twin));
}

TEST(RowPairs, they_do_not_hold_the_lists_back) {
    const Case c = cloud(200, 1);
    ConnectivityMap map;
    for (int round = 0; round < 3; ++round) rebuild(map, c);
    const RowPairs of(map);
    const Slot* const memory = map.rows().slots.data();
    rebuild(map, c);
    EXPECT_EQ(map.rows().slots.data(), memory);
}

TEST(PairSum, atomic_sums_are_those_of_a_loop_over_pairs) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        const auto out = started(2 * c.n_slots());
        add_pairs_atomically(HostExec(), map.pairs().view(), whole, out);
        ASSERT_TRUE(same(out, expected(c))) << c.text;
    }
}

TEST(PairSum, sums_by_rows_are_those_of_a_loop_over_pairs_for_stored_nodes_and_touch_no_other) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        const RowPairs of(map);
        const auto out = started(2 * c.n_slots());
        add_pairs_by_rows(HostExec(), of.view(map), whole, out);
        Sums want = expected(c);
        for (std::size_t s = 0; s < want.size(); ++s)
            if (!map.layout().is_stored(static_cast<Offset>(s / 2)))
                want[s] = 5 * static_cast<double>(s);
        ASSERT_TRUE(same(out, want)) << c.text;
    }
}

TEST(PairSum, sums_by_colours_are_those_of_a_loop_over_pairs) {
    PairColours colours;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        MapOptions options = map_options(c);
        options.spatial_order = seed % 3 == 0;
        map.rebuild(node_lists(c), options);
        colours.rebuild(map.pairs(), seed % 3 == 0 ? map.spatial_order() : ConstView<Slot>(),
                        1 + static_cast<Offset>(seed % 17));
        const auto out = started(2 * c.n_slots());
        add_pairs_by_colours(HostExec(), colours, map.pairs().view(), whole, out);
        ASSERT_TRUE(same(out, expected(c))) << c.text;
    }
}

/// Colour of the block that a slot is in.
std::vector<std::size_t> colour_of_blocks(const PairColours& colours) {
    std::vector<std::size_t> colour;
    for (std::size_t c = 0; c + 1 < colours.colour_offset().size(); ++c)
        colour.resize(static_cast<std::size_t>(colours.colour_offset()[c + 1]), c);
    return colour;
}

TEST(PairColours, blocks_of_a_colour_have_no_node_in_common_and_every_slot_one_block) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Case c = random_pairs(seed, 400);
        ConnectivityMap map;
        rebuild(map, c);
        const PairColours colours(map.pairs(), {}, 1 + static_cast<Offset>(seed % 5));
        const auto colour = colour_of_blocks(colours);
        ASSERT_EQ(static_cast<Offset>(colour.size()), colours.n_blocks());
        std::vector<std::size_t> block(static_cast<std::size_t>(c.n_slots()), colour.size());
        for (std::size_t b = 0; b < colour.size(); ++b)
            for (Offset s = colours.block_offset()(b); s < colours.block_offset()(b + 1); ++s) {
                const auto slot = static_cast<std::size_t>(colours.slots()(s));
                ASSERT_EQ(block[slot], colour.size()) << "twice";
                block[slot] = b;
            }
        // (node, colour) -> the one block of that colour that adds to the node
        std::map<std::pair<Slot, std::size_t>, std::size_t> owner;
        for (const auto& [i, j] : pairs_of(c)) {
            const std::size_t b = block[static_cast<std::size_t>(i)];
            ASSERT_LT(b, colour.size());
            for (const Slot node : {i, j})
                ASSERT_EQ(owner.try_emplace({node, colour[b]}, b).first->second, b) << c.text;
        }
    }
}

/// Key order, few active nodes, or pairs left out.
MapOptions with_extras(const Case& c, std::uint64_t seed, const View<std::uint8_t>& active) {
    MapOptions options = map_options(c);
    Random random(seed);
    for (std::size_t s = 0; s < active.size(); ++s) active(s) = random.chance(0.3) ? 1 : 0;
    if (seed % 3 == 0) options.order = ListOrder::key;
    if (seed % 3 == 1) options.active = active;
    if (seed % 3 == 2)
        options.exclude =
            std::make_shared<const PairPredicate>([](Slot i, Slot j) { return (i + j) % 4 == 0; });
    return options;
}

TEST(PairSum, any_order_and_selection_of_the_lists_has_the_sums_of_a_loop_over_its_pairs) {
    start_runtime();
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        const Case c = random_pairs(seed);
        const View<std::uint8_t> active("active", static_cast<std::size_t>(c.n_slots()));
        const MapOptions options = with_extras(c, seed, active);
        ConnectivityMap map;
        map.rebuild(node_lists(c), options);
        const auto flat = map.pairs().expanded_view();
        std::map<std::pair<Slot, Slot>, Offset> numbers;
        Sums all = {}, stored;
        for (Offset s = 0; s < 2 * c.n_slots(); ++s) all.push_back(static_cast<double>(5 * s));
        stored = all;
        for (Offset k = 0; k < flat.size(); ++k) {
            const Slot i = flat.i(k), j = flat.j(k);
            numbers[{std::min(i, j), std::max(i, j)}] = k;
            const auto add = whole(k, i, j);
            for (std::size_t e = 0; e < 2; ++e) {
                all[2 * static_cast<std::size_t>(i) + e] += add.i[e];
                all[2 * static_cast<std::size_t>(j) + e] += add.j[e];
            }
        }
        for (std::size_t s = 0; s < all.size(); ++s)
            if (map.layout().is_stored(static_cast<Offset>(s / 2))) stored[s] = all[s];
        const auto rows = map.rows();
        const RowPairs of(map);
        const auto view = of.view(map);
        for (Offset row = 0; row < rows.n_rows(); ++row)
            for (const Slot& b : rows[row]) {
                const Slot a = view.slot(row);
                ASSERT_EQ(view[&b - rows.data()], (numbers.at({std::min(a, b), std::max(a, b)})))
                    << c.text;
            }
        const auto atomic = started(2 * c.n_slots()), by_rows = started(2 * c.n_slots()),
                   by_colours = started(2 * c.n_slots());
        const PairColours colours(map.pairs(), {}, 3);
        const auto pairs = map.pairs().view();
        add_pairs_atomically(HostExec(), pairs, whole, atomic);
        add_pairs_by_rows(HostExec(), view, whole, by_rows);
        add_pairs_by_colours(HostExec(), colours, pairs, whole, by_colours);
        ASSERT_TRUE(same(atomic, all)) << c.text;
        ASSERT_TRUE(same(by_rows, stored)) << c.text;
        ASSERT_TRUE(same(by_colours, all)) << c.text;
    }
}

TEST(PairColours, more_than_sixty_four_colours_are_no_obstacle) {
    const Case c = cloud(300, 2, 1.0);  // everybody sees everybody
    ConnectivityMap map;
    rebuild(map, c);
    const PairColours colours(map.pairs(), {}, 1);
    EXPECT_EQ(colours.n_colours(), 299);  // the last slot has no pairs: it takes any colour
    const auto out = started(2 * c.n_slots());
    add_pairs_by_colours(HostExec(), colours, map.pairs().view(), whole, out);
    EXPECT_TRUE(same(out, expected(c)));
}

TEST(PairColours, bad_requests_are_refused) {
    ConnectivityMap map;
    rebuild(map, cloud(5, 1));
    const std::vector<Slot> twice = {0, 1, 2, 3, 1}, outside = {0, 1, 2, 3, 5};
    const auto view = [](const std::vector<Slot>& order) {
        return ConstView<Slot>(order.data(), order.size());
    };
    EXPECT_TRUE(fails_with(Status::argument, {"order[4] = 1"},
                           [&] { PairColours(map.pairs(), view(twice)); }));
    EXPECT_TRUE(fails_with(Status::argument, {"order[4] = 5"},
                           [&] { PairColours(map.pairs(), view(outside)); }));
    EXPECT_TRUE(fails_with(Status::argument, {"3 slots", "5"}, [&] {
        PairColours(map.pairs(), view({0, 1, 2}));
    }));
    EXPECT_TRUE(
        fails_with(Status::argument, {"at least 1"}, [&] { PairColours(map.pairs(), {}, 0); }));
    EXPECT_TRUE(fails_with(Status::not_built, {}, [&] { const PairColours c{NodePairList()}; }));
}

TEST(PairSum, stored_values_go_to_both_ends_with_the_sign_they_have_there) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        PairwiseField<double, 2> field(map.pairs());
        for (Offset v = 0; v < 2 * field.size(); ++v)
            field.data()[v] = static_cast<double>(v * v % 1009);
        const auto n = static_cast<std::size_t>(c.n_slots());
        Sums opposite(2 * n), equal(2 * n), own(n);
        Offset k = 0;
        for (const auto& [i, j] : pairs_of(c)) {
            const double* const v = field[k++];
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            for (std::size_t e = 0; e < 2; ++e) {
                opposite[2 * a + e] += v[e], opposite[2 * b + e] -= v[e];
                equal[2 * a + e] += v[e], equal[2 * b + e] += v[e];
            }
            own[a] += v[0], own[b] += v[1];
        }
        const auto pairs = map.pairs().view();
        const View<double> out("a", 2 * n), out2("b", 2 * n), out3("c", n);
        add_pairs_atomically(HostExec(), pairs, antisymmetric(field.view(map.pairs())), out);
        add_pairs_atomically(HostExec(), pairs, symmetric(std::as_const(field).view()), out2);
        add_pairs_atomically(HostExec(), pairs, two_sided(field.view()), out3);
        ASSERT_TRUE(same(out, opposite) && same(out2, equal) && same(out3, own)) << c.text;
    }
}

TEST(PairSum, what_belongs_to_another_list_or_has_another_size_is_refused) {
    ConnectivityMap map, twin;
    rebuild(map, cloud(200, 1));
    rebuild(twin, cloud(200, 1));
    const PairwiseField<double> field(map.pairs());
    const auto forces = antisymmetric(field.view());
    const View<double> out("out", 200), wrong("out", 199);
    const RowPairs of(twin);
    const PairColours colours(map.pairs()), other(twin.pairs());
    const auto pairs = map.pairs().view(), others = twin.pairs().view();
    const HostExec exec;
    EXPECT_TRUE(fails_with(Status::stale, {"field"},
                           [&] { add_pairs_atomically(exec, others, forces, out); }));
    EXPECT_TRUE(fails_with(Status::stale, {"field"},
                           [&] { add_pairs_by_rows(exec, of.view(twin), forces, out); }));
    EXPECT_TRUE(fails_with(Status::stale, {"field"},
                           [&] { add_pairs_by_colours(exec, other, others, forces, out); }));
    EXPECT_TRUE(fails_with(Status::stale, {"colours"},
                           [&] { add_pairs_by_colours(exec, other, pairs, forces, out); }));
    EXPECT_TRUE(fails_with(Status::argument, {"199", "1 for each of 200"},
                           [&] { add_pairs_atomically(exec, pairs, forces, wrong); }));
    for (int s = 0; s < 200; ++s) ASSERT_EQ(out(s), 0);
}

}  // namespace
}  // namespace connectivity::test
