// SPDX-License-Identifier: BSD-3-Clause
// A17, stale use: what was made for other lists, or never made, is an error; old data is never
// given out as new.

#include <array>
#include <functional>

#include <gtest/gtest.h>

#include <connectivity/map/copy_to.hpp>
#include <connectivity/map/pair_sum.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

using Field = PairwiseField<double, 3>;

struct Change {
    const char* name;
    std::function<void(ConnectivityMap&)> apply;
};

Case start() { return cloud(400, 1, 0.12); }

/// Node 399 goes, all others change places.
void patch(ConnectivityMap& map, std::span<PairFieldBase* const> fields = {}) {
    std::vector<Slot> keep(400, 1), old2new(400);
    keep.back() = 0;
    for (std::size_t k = 0; k < 399; ++k) old2new[k] = static_cast<Slot>(398 - k);
    map.patch(keep, old2new, fields);
}

/// All ways to new lists; the first one even gives the very same pairs.
const Change changes[] = {
    {"rebuild of the same", [](ConnectivityMap& map) { rebuild(map, start()); }},
    {"rebuild of others", [](ConnectivityMap& map) { rebuild(map, cloud(300, 2, 0.15)); }},
    {"patch", [](ConnectivityMap& map) { patch(map); }},
    {"removal", [](ConnectivityMap& map) {
         map.remove_pairs([](Slot i, Slot j) { return (i + j) % 3 == 0; });
     }}};

/// What a host holds besides the map.
struct Held {
    explicit Held(const ConnectivityMap& map)
        : first(map.pairs().view()[0]),
          field(map.pairs()),
          copy(copy_to<HostMemory>(field)),
          of_rows(map),
          colours(map.pairs()) {
        field(map.pairs(), first.i, first.j)[0] = 1;
    }

    NodePairList::View<>::Pair first;
    Field field;
    Field::View<> copy;
    RowPairs of_rows;
    PairColours colours;
};

/// Every use of it must be an error once the map has other lists.
void expect_stale(ConnectivityMap& map, Held& held) {
    const HostExec exec;
    const NodePairList& pairs = map.pairs();
    const View<double> out("out", static_cast<std::size_t>(3 * map.layout().list_offset().back()));
    Field target(pairs), &field = held.field;
    const Slot a = held.first.i, b = held.first.j;
    const auto old = antisymmetric(Field::ConstView<>(field.view())),
               fresh = antisymmetric(Field::ConstView<>(target.view()));
    const std::array<PairFieldBase*, 1> fields{&field};
    const std::function<void()> uses[] = {
        [&] { field(pairs, a, b)[0] = 2; },
        [&] { std::as_const(field)(pairs, a, b); },
        [&] { field.find(pairs, a, b); },
        [&] { field.view(pairs); },
        [&] { std::as_const(field).view(pairs); },
        [&] { copy_back(held.copy, target); },
        [&] { held.of_rows.view(map); },
        [&] { add_pairs_atomically(exec, pairs.view(), old, out); },
        [&] { add_pairs_by_rows(exec, RowPairs(map).view(map), old, out); },
        [&] { add_pairs_by_colours(exec, PairColours(pairs), pairs.view(), old, out); },
        [&] { add_pairs_by_colours(exec, held.colours, pairs.view(), fresh, out); },
        [&] { map.patch({}, {}, fields); },
        [&] { map.remove_pairs([](Slot, Slot) { return true; }, fields); }};
    for (std::size_t k = 0; k < std::size(uses); ++k)
        EXPECT_TRUE(fails_with(Status::stale, {}, uses[k])) << "use " << k;
    for (std::size_t k = 0; k < out.size(); ++k) ASSERT_EQ(out(k), 0);
}

TEST(StaleUse, nothing_made_before_a_rebuild_or_a_patch_is_accepted_after_it) {
    for (const Change& change : changes) {
        SCOPED_TRACE(change.name);
        ConnectivityMap map;
        rebuild(map, start());
        Held held(map);
        change.apply(map);
        const Generation generation = map.generation();
        const Offset n_pairs = map.pairs().size();
        expect_stale(map, held);
        EXPECT_FALSE(held.field.is_current(map.pairs()));
        EXPECT_FALSE(held.of_rows.is_current(map));
        EXPECT_EQ(map.generation(), generation);
        EXPECT_EQ(map.pairs().size(), n_pairs);
        EXPECT_EQ(held.field[0][0], 1) << "the owner still has the old values";
    }
}

TEST(StaleUse, a_patch_carries_the_fields_it_is_given_and_no_others) {
    ConnectivityMap map;
    rebuild(map, start());
    PairwiseField<double> given(map.pairs()), forgotten(map.pairs());
    const auto before = map.pairs().expanded_view();
    for (Offset k = 0; k < before.size(); ++k)
        given[k] = forgotten[k] =
            1000.0 * std::min(before[k].i, before[k].j) + std::max(before[k].i, before[k].j);
    patch(map, std::array<PairFieldBase*, 1>{&given});
    EXPECT_TRUE(given.is_current(map.pairs()));
    EXPECT_FALSE(forgotten.is_current(map.pairs()));
    const auto after = map.pairs().expanded_view();
    ASSERT_GT(after.size(), 1000);
    for (Offset k = 0; k < after.size(); ++k) {
        const Slot a = 398 - after[k].i, b = 398 - after[k].j;  // their old slots
        ASSERT_EQ(given(map.pairs(), after[k].i, after[k].j),
                  1000.0 * std::min(a, b) + std::max(a, b));
    }
}

TEST(StaleUse, views_that_are_held_stay_as_they_were_and_tell_that_they_are_old) {
    for (const Change& change : changes) {
        SCOPED_TRACE(change.name);
        const Expected expected = brute_force(start());
        ConnectivityMap map;
        rebuild(map, start());
        const RowsView<> rows = map.rows();
        const auto pairs = map.pairs().view();
        EXPECT_EQ(rows.generation, map.generation());
        EXPECT_EQ(pairs.stamp, map.pairs().stamp());
        change.apply(map);
        EXPECT_TRUE(rows_equal(rows, expected));
        EXPECT_TRUE(pairs_equal(pairs, expected));
        EXPECT_LT(rows.generation, map.generation());
        EXPECT_LT(pairs.generation, map.generation());
        EXPECT_NE(pairs.stamp, map.pairs().stamp());
        EXPECT_EQ(map.rows().generation, map.generation());
        EXPECT_EQ(map.pairs().view().generation, map.generation());
    }
}

TEST(StaleUse, rows_of_ghosts_that_were_not_built_are_an_error_even_if_they_were_there_before) {
    Case c = start();
    c.lists[0].n_internal = 250;
    ConnectivityMap map;
    for (const bool ghost_rows : {true, false, true, false}) {
        c.ghost_rows = ghost_rows;
        rebuild(map, c);
        const Slot ghost = 399, internal = 3;
        if (ghost_rows) {
            EXPECT_EQ(map.common_neighbours(ghost, ghost).size(),
                      static_cast<std::size_t>(map.rows()[399].size()) + 1);
            continue;
        }
        EXPECT_EQ(map.rows().n_rows(), 250);
        EXPECT_EQ(map.layout().row_of_slot(ghost), -1);
        for (const auto& [a, b] : {std::pair{ghost, internal}, {internal, ghost}}) {
            EXPECT_TRUE(
                fails_with(Status::argument, {"399"}, [&] { map.common_neighbours(a, b); }));
            EXPECT_TRUE(fails_with(Status::argument, {"399"}, [&] { map.all_neighbours(a, b); }));
        }
    }
}

TEST(StaleUse, products_that_were_not_asked_for_are_errors_even_if_they_were_there_before) {
    const Case c = start();
    MapOptions all, none;
    all.overlap = all.spatial_order = true;
    all.intersection = IntersectionKind::all;
    all.order = ListOrder::key;
    none.rows = none.pairs = false;
    ConnectivityMap map;
    const std::pair<const char*, std::function<void()>> products[] = {
        {"rows", [&] { map.rows(); }},
        {"pairs", [&] { map.pairs(); }},
        {"overlap", [&] { map.overlap(); }},
        {"intersection", [&] { map.intersection(); }},
        {"key_order", [&] { map.key_order(); }},
        {"spatial_order", [&] { map.spatial_order(); }},
        {"rows", [&] { map.common_neighbours(0, 1); }},
        {"rows", [&] { map.all_neighbours(0, 1); }}};
    const auto expect_none = [&] {
        for (const auto& [name, ask] : products)
            EXPECT_TRUE(fails_with(Status::not_built, {}, ask)) << name;
    };
    expect_none();
    for (int round = 0; round < 2; ++round) {
        map.rebuild(node_lists(c), all);
        for (const auto& [name, ask] : products) EXPECT_NO_THROW(ask()) << name;
        map.rebuild(node_lists(c), none);
        expect_none();
    }
}

}  // namespace
}  // namespace connectivity::test
