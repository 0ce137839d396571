// SPDX-License-Identifier: BSD-3-Clause
// Patch: after nodes were dropped and renumbered everything is as after a rebuild on what is left.

#include <gtest/gtest.h>

#include <connectivity/map/pairwise_field.hpp>
#include <support/expect_error.hpp>
#include <support/key_order.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// Which nodes stay, and under which ids.
struct Cull {
    std::vector<Slot> keep, old2new;  // [n_slots]
    Case after;
};

/// Drops some nodes; the others keep their order, or not.
Cull random_cull(const Case& c, Random& random, bool ghosts_only, bool shuffles) {
    Cull cull;
    cull.after = c;
    const auto dim = static_cast<std::size_t>(c.dim);
    for (std::size_t l = 0; l < c.lists.size(); ++l) {
        const ListData& old = c.lists[l];
        std::vector<std::size_t> kept[2];  // internal nodes, ghosts
        for (Offset a = 0; a < c.n(l); ++a) {
            const bool ghost = a >= old.n_internal;
            const bool stays = (ghosts_only && !ghost) || random.uniform() < 0.7;
            cull.keep.push_back(stays);
            if (stays) kept[ghost].push_back(static_cast<std::size_t>(a));
        }
        ListData& list = cull.after.lists[l];
        list.n_internal = static_cast<Offset>(kept[0].size());
        for (auto& part : kept)
            for (std::size_t k = part.size(); shuffles && k > 1; --k)
                std::swap(
                    part[k - 1],
                    part[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
        const std::size_t n_H = old.H.size() / std::max<std::size_t>(old.x.size() / dim, 1);
        list.x.clear(), list.h.clear(), list.H.clear();
        std::vector<Slot> ids(static_cast<std::size_t>(c.n(l)), -12345);  // garbage where dropped
        Slot next = 0;
        for (const auto& part : kept)
            for (const std::size_t a : part) {
                ids[a] = next++;
                list.x.insert(list.x.end(), &old.x[a * dim], &old.x[a * dim] + dim);
                if (!old.h.empty()) list.h.push_back(old.h[a]);
                for (std::size_t d = 0; d < n_H; ++d) list.H.push_back(old.H[a * n_H + d]);
            }
        cull.old2new.insert(cull.old2new.end(), ids.begin(), ids.end());
    }
    return cull;
}

/// K is that of the case before: dropping nodes changes no extents.
Case any_case(std::uint64_t seed) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 110});
    c.mode = SearchMode::gather_scatter;
    return c;
}

class Patches : public ::testing::TestWithParam<std::tuple<bool, bool>> {};

TEST_P(Patches, equal_a_rebuild_on_what_is_left) {
    const auto [ghosts_only, shuffles] = GetParam();
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Case c = any_case(seed);
        Random random(seed);
        MapOptions options = map_options(c);
        options.spatial_order = seed % 2 == 0;
        map.rebuild(node_lists(c), options);
        const Generation before = map.generation();
        const Cull cull = random_cull(c, random, ghosts_only, shuffles);
        map.patch(cull.keep, cull.old2new);
        ASSERT_TRUE(equals(map, brute_force(cull.after))) << c.text;
        ASSERT_EQ(map.generation(), before + 1);
        if (!options.spatial_order) continue;
        std::vector<Slot> order(map.spatial_order().data(),
                                map.spatial_order().data() + map.spatial_order().size());
        std::sort(order.begin(), order.end());
        ASSERT_EQ(static_cast<Offset>(order.size()), map.layout().n_slots());
        for (std::size_t k = 0; k < order.size(); ++k) ASSERT_EQ(order[k], static_cast<Slot>(k));
    }
}

TEST_P(Patches, follow_one_another) {
    const auto [ghosts_only, shuffles] = GetParam();
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Case c = any_case(seed);
        Random random(seed);
        ConnectivityMap map;
        rebuild(map, c);
        for (int k = 0; k < 4; ++k) {
            const Cull cull = random_cull(c, random, ghosts_only, shuffles);
            map.patch(cull.keep, cull.old2new);
            c = cull.after;
            ASSERT_TRUE(equals(map, brute_force(c))) << c.text << " patch " << k;
        }
        rebuild(map, c);
        ASSERT_TRUE(equals(map, brute_force(c))) << c.text;
    }
}

TEST_P(Patches, carry_coupling_and_fields_of_surviving_pairs) {
    const auto [ghosts_only, shuffles] = GetParam();
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        const Case c = any_case(seed);
        Random random(seed);
        ConnectivityMap map;
        rebuild(map, c);
        const auto value = [](Slot i, Slot j) {
            return 1.0 / (1 + std::min(i, j) + 1000.0 * std::max(i, j));
        };
        map.pairs().set_coupling([&](Slot i, Slot j) { return value(i, j); });
        PairwiseField<double> carried(map.pairs()), left(map.pairs());
        const auto before = map.pairs().view();
        for (Offset k = 0; k < before.size(); ++k) carried(k) = value(before[k].i, before[k].j);
        const Cull cull = random_cull(c, random, ghosts_only, shuffles);
        std::vector<Slot> old_slot(static_cast<std::size_t>(cull.after.n_slots()));
        PairFieldBase* const fields[] = {&carried};
        map.patch(cull.keep, cull.old2new, fields);
        for (std::size_t s = 0; s < cull.keep.size(); ++s) {
            const auto list = static_cast<std::size_t>(before.n_slots() > 0 ? [&] {
                Offset end = 0;
                for (std::size_t l = 0; l < c.lists.size(); ++l)
                    if (static_cast<Offset>(s) < (end += c.n(l))) return l;
                return std::size_t{0};
            }() : 0);
            if (cull.keep[s])
                old_slot[static_cast<std::size_t>(map.layout().list_offset()[list] +
                                                  cull.old2new[s])] = static_cast<Slot>(s);
        }
        ASSERT_TRUE(carried.is_current(map.pairs()));
        ASSERT_FALSE(left.is_current(map.pairs()));
        const auto after = map.pairs().view();
        ASSERT_EQ(carried.size(), after.size());
        for (Offset k = 0; k < after.size(); ++k) {
            const double want = value(old_slot[static_cast<std::size_t>(after[k].i)],
                                      old_slot[static_cast<std::size_t>(after[k].j)]);
            ASSERT_EQ(carried(k), want) << c.text;
            ASSERT_EQ(map.pairs().coupling(k), want) << c.text;
        }
    }
}

std::string name_of_kind(const ::testing::TestParamInfo<std::tuple<bool, bool>>& kind) {
    const auto [ghosts_only, shuffles] = kind.param;
    return std::string(ghosts_only ? "ghosts" : "any_nodes") + (shuffles ? "_shuffled" : "_kept");
}

INSTANTIATE_TEST_SUITE_P(All, Patches, ::testing::Combine(::testing::Bool(), ::testing::Bool()),
                         name_of_kind);

/// The order of what is left, and the keys it had.
TEST(PatchByKey, keeps_the_order_of_what_is_left) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Case c = any_case(seed);
        c.ghost_rows = true;
        Random random(seed);
        MapOptions options = map_options(c);
        options.order = ListOrder::key;
        map.rebuild(node_lists(c), options);
        const ExpectedOrder before = key_order_of(c);
        Cull cull = random_cull(c, random, false, seed % 2 == 0);
        map.patch(cull.keep, cull.old2new);
        cull.after.ghost_rows = true;
        ExpectedOrder want;
        want.ranks.resize(static_cast<std::size_t>(cull.after.n_slots()));
        for (std::size_t rank = 0; rank < before.slots.size(); ++rank) {
            const auto old = static_cast<std::size_t>(before.slots[rank]);
            if (!cull.keep[old]) continue;
            std::size_t list = 0;
            for (Offset end = c.n(0); end <= static_cast<Offset>(old); end += c.n(++list)) {
            }
            const auto slot =
                static_cast<Slot>(map.layout().list_offset()[list] + cull.old2new[old]);
            want.ranks[static_cast<std::size_t>(slot)] = static_cast<Slot>(want.slots.size());
            want.slots.push_back(slot);
            want.keys.push_back(before.keys[rank]);
        }
        const KeyOrderView<> got = map.key_order();
        ASSERT_EQ(std::vector<Slot>(got.slots.data(), got.slots.data() + got.slots.size()),
                  want.slots);
        ASSERT_EQ(std::vector<std::uint64_t>(got.keys.data(), got.keys.data() + got.keys.size()),
                  want.keys);
        ASSERT_TRUE(equals(map, in_key_order(brute_force(cull.after), want))) << c.text;
    }
}

TEST(Patch, bad_input_changes_nothing) {
    Case c = cloud(30, 4, 0.3);
    c.lists[0].n_internal = 20;
    ConnectivityMap map;
    std::vector<Slot> keep(30, 1), ids(30);
    for (std::size_t k = 0; k < 30; ++k) ids[k] = static_cast<Slot>(k);
    EXPECT_TRUE(fails_with(Status::not_built, {"patch"}, [&] { map.patch(keep, ids); }));
    rebuild(map, c);
    PairwiseField<double> stale(map.pairs());
    rebuild(map, c);
    const auto refused = [&](Status status, const std::vector<std::string>& words, auto change,
                             std::span<PairFieldBase* const> fields = {}) {
        std::vector<Slot> k = keep, o = ids;
        change(k, o);
        EXPECT_TRUE(fails_with(status, words, [&] { map.patch(k, o, fields); }));
        EXPECT_TRUE(equals(map, brute_force(c)));
    };
    using V = std::vector<Slot>;
    refused(Status::argument, {"keep has 29", "30"}, [](V& k, V&) { k.pop_back(); });
    refused(Status::argument, {"old2new has 31", "30"}, [](V&, V& o) { o.push_back(0); });
    refused(Status::argument, {"node 7", "keep = 2"}, [](V& k, V&) { k[7] = 2; });
    refused(Status::argument, {"node 3", "earlier node"}, [](V&, V& o) { o[3] = 2; });
    refused(Status::argument, {"node 5", "old2new = -1", "[0, 20)"}, [](V&, V& o) { o[5] = -1; });
    refused(Status::argument, {"node 25", "old2new = 3", "[20, 30)", "ghost"},
            [](V&, V& o) { o[25] = 3; });
    refused(Status::argument, {"node 29", "old2new = 29", "[20, 29)"}, [](V& k, V&) { k[22] = 0; });
    PairFieldBase* const with_stale[] = {&stale};
    refused(
        Status::stale, {}, [](V&, V&) {}, with_stale);
    PairFieldBase* const with_null[] = {nullptr};
    refused(
        Status::null, {"fields[0]"}, [](V&, V&) {}, with_null);
}

TEST(Patch, held_views_stay_as_they_were) {
    Case c = cloud(200, 6, 0.2);
    ConnectivityMap map;
    rebuild(map, c);
    const RowsView<> rows = map.rows();
    const auto pairs = map.pairs().view();
    const Expected before = brute_force(c);
    Random random(1);
    for (int k = 0; k < 3; ++k) {
        const Cull cull = random_cull(c, random, false, true);
        map.patch(cull.keep, cull.old2new);
        c = cull.after;
        EXPECT_TRUE(rows_equal(rows, before));
        EXPECT_TRUE(pairs_equal(pairs, before));
    }
}

TEST(Patch, ends_the_life_of_a_skin) {
    const Case c = cloud(50, 2, 0.2);
    MapOptions options = map_options(c);
    options.skin = 0.1;
    ConnectivityMap map;
    map.rebuild(node_lists(c), options);
    EXPECT_FALSE(map.needs_rebuild(node_lists(c)));
    std::vector<Slot> keep(50, 1), ids(50);
    for (std::size_t k = 0; k < 50; ++k) ids[k] = static_cast<Slot>(k);
    map.patch(keep, ids);
    EXPECT_TRUE(map.needs_rebuild(node_lists(c)));
}

}  // namespace
}  // namespace connectivity::test
