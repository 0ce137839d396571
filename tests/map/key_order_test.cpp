// SPDX-License-Identifier: BSD-3-Clause
// Key order: the order itself, rows and pairs in it, and that storage does not matter to them.

#include <numeric>

#include <gtest/gtest.h>

#include <support/expect_error.hpp>
#include <support/key_order.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

MapOptions by_key(const Case& c, SearchMethod method = SearchMethod::automatic) {
    MapOptions options = map_options(c, method);
    options.order = ListOrder::key;
    return options;
}

template <class T>
ConstView<T> wrap(const std::vector<T>& values) {
    return ConstView<T>(values.data(), values.size());
}

std::vector<NodeList> named_lists(const Case& c, const NodeNames& names) {
    std::vector<NodeList> lists = node_lists(c);
    for (std::size_t l = 0; l < lists.size(); ++l) {
        if (!names.global_id.empty()) lists[l].set_global_ids(wrap(names.global_id[l]));
        if (!names.owner.empty()) lists[l].set_owners(wrap(names.owner[l]));
    }
    return lists;
}

template <class V, class T>
std::vector<T> copied(const V& view, const std::vector<T>&) {
    return {view.data(), view.data() + view.size()};
}

void expect_order(const ConnectivityMap& map, const ExpectedOrder& want, const std::string& text) {
    const KeyOrderView<> got = map.key_order();
    EXPECT_EQ(copied(got.slots, want.slots), want.slots) << text;
    EXPECT_EQ(copied(got.ranks, want.ranks), want.ranks) << text;
    EXPECT_EQ(copied(got.keys, want.keys), want.keys) << text;
}

/// Positions on a lattice, where many keys and distances tie.
void snap_to_lattice(Case& c) {
    for (ListData& list : c.lists)
        for (double& x : list.x) x = std::round(x * 4) / 4;
}

TEST(KeyOrder, order_rows_and_pairs_are_those_of_the_definition) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 900; ++seed) {
        const bool periodic = seed % 2 != 0;
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, periodic, 120});
        if (seed % 5 == 0 && !periodic) snap_to_lattice(c);
        c.ghost_rows = true;
        c.mode = SearchMode::gather_scatter;
        const ExpectedOrder order = key_order_of(c);
        const Expected want = in_key_order(brute_force(c), order);
        map.rebuild(node_lists(c), by_key(c));
        expect_order(map, order, c.text);
        ASSERT_TRUE(rows_equal(map.rows(), want)) << c.text;
        ASSERT_TRUE(pairs_equal(map.pairs().view(), want)) << c.text;
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(KeyOrder, large_orders_are_sorted_by_all_threads_alike) {
    Case c = cloud(40000, 5, 0.02);
    snap_to_lattice(c);  // ties in plenty
    for (std::size_t k = 0; k < c.lists[0].x.size(); k += 7) c.lists[0].x[k] += 0.01;
    c.lists[0].h.assign(c.lists[0].h.size(), 1e-6);
    ConnectivityMap map;
    map.rebuild(node_lists(c), by_key(c));
    expect_order(map, key_order_of(c), "large");
}

TEST(KeyOrder, every_pair_is_found_in_either_orientation) {
    const Case c = cloud(300, 3, 0.1);
    ConnectivityMap map;
    map.rebuild(node_lists(c), by_key(c));
    const auto pairs = map.pairs().expanded_view();
    const KeyOrderView<> order = map.key_order();
    ASSERT_GT(pairs.size(), 100);
    for (Offset k = 0; k < pairs.size(); ++k) {
        const auto [i, j] = pairs[k];
        EXPECT_LT(order.ranks(i), order.ranks(j));
        EXPECT_EQ(pairs.find(i, j), k);
        EXPECT_EQ(pairs.find(j, i), k);
        EXPECT_EQ(map.pairs().view()[k].i, i);
        EXPECT_EQ(pairs.i(k), i);
    }
    EXPECT_EQ(pairs.find(0, 0), -1);
    EXPECT_EQ(pairs.find(-1, 0), -1);
    EXPECT_EQ(pairs.find(0, 300), -1);
}

/// A case stored in another way: nodes of each list permuted, others of them ghosts.
struct Stored {
    Case c;
    NodeNames names;
};

Stored shuffled(const Case& c, Random& random) {
    Stored out{c, {}};
    for (std::size_t l = 0; l < c.lists.size(); ++l) {
        const auto n = static_cast<std::size_t>(c.n(l)), dim = static_cast<std::size_t>(c.dim);
        std::vector<std::size_t> from(n);
        std::iota(from.begin(), from.end(), 0);
        for (std::size_t k = n; k > 1; --k)
            std::swap(from[k - 1],
                      from[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
        ListData& list = out.c.lists[l];
        const std::size_t n_H = list.H.size() / std::max<std::size_t>(n, 1);
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t d = 0; d < dim; ++d)
                list.x[k * dim + d] = c.lists[l].x[from[k] * dim + d];
            for (std::size_t d = 0; d < n_H; ++d)
                list.H[k * n_H + d] = c.lists[l].H[from[k] * n_H + d];
            if (!list.h.empty()) list.h[k] = c.lists[l].h[from[k]];
        }
        list.n_internal = static_cast<Offset>(random.uniform() * static_cast<double>(n + 1));
        if (list.n_internal > c.n(l)) list.n_internal = c.n(l);
        out.names.global_id.emplace_back(from.begin(), from.end());
    }
    return out;
}

/// Everything a map holds, by list and global id.
struct ByName {
    std::vector<std::pair<int, std::int64_t>> order;
    std::vector<std::vector<std::pair<int, std::int64_t>>> rows;  // by rank
    std::vector<std::array<std::int64_t, 4>> pairs;
    std::vector<std::vector<std::int64_t>> traversal;
    bool operator==(const ByName&) const = default;
};

ByName by_name(const ConnectivityMap& map, const NodeNames& names) {
    const SlotLayout& layout = map.layout();
    const auto name = [&](Slot slot) {
        const int list = layout.list_of_slot(slot);
        const auto l = static_cast<std::size_t>(list);
        return std::pair{
            list, names.global_id[l][static_cast<std::size_t>(slot - layout.list_offset()[l])]};
    };
    ByName out;
    const KeyOrderView<> order = map.key_order();
    for (std::size_t rank = 0; rank < order.slots.size(); ++rank) {
        out.order.push_back(name(order.slots(rank)));
        out.rows.emplace_back();
        for (const Slot j : map.rows()[layout.row_of_slot(order.slots(rank))])
            out.rows.back().push_back(name(j));
    }
    const auto pairs = map.pairs().view();
    for (Offset k = 0; k < pairs.size(); ++k) {
        const auto a = name(pairs[k].i), b = name(pairs[k].j);
        out.pairs.push_back({a.first, a.second, b.first, b.second});
    }
    for (int l = 0; l < layout.n_lists(); ++l) {
        out.traversal.emplace_back();
        const NodeTraversal nodes = map.traversal(l);
        for (const Slot node : nodes)
            out.traversal.back().push_back(
                names.global_id[static_cast<std::size_t>(l)][static_cast<std::size_t>(node)]);
        EXPECT_EQ(nodes.size(), static_cast<Offset>(out.traversal.back().size()));
    }
    return out;
}

TEST(KeyOrder, neither_storage_nor_ghosts_change_anything) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const bool periodic = seed % 3 == 0;
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, periodic, 100});
        if (seed % 4 == 0 && !periodic) snap_to_lattice(c);
        c.mode = SearchMode::gather_scatter;
        Random random(seed);
        ByName first;
        for (int k = 0; k < 3; ++k) {
            const Stored stored = shuffled(c, random);
            map.rebuild(named_lists(stored.c, stored.names), by_key(stored.c));
            const ByName now = by_name(map, stored.names);
            if (k == 0)
                first = now;
            else
                ASSERT_TRUE(now == first) << c.text;
        }
    }
}

TEST(KeyOrder, images_stand_with_their_owners_and_leave_the_box_alone) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, false, 60});
        c.mode = SearchMode::gather_scatter;
        c.ghost_rows = true;
        Random random(seed + 77);
        NodeNames names;
        for (std::size_t l = 0; l < c.lists.size(); ++l) {
            const Offset n_internal = c.lists[l].n_internal, n_ghosts = c.n(l) - n_internal;
            names.owner.emplace_back();
            for (Offset g = 0; g < n_ghosts; ++g)
                names.owner[l].push_back(
                    static_cast<Slot>(random.uniform() * static_cast<double>(n_internal + 1)) - 1);
            names.global_id.emplace_back();
            for (Offset a = 0; a < c.n(l); ++a) names.global_id[l].push_back(7 * a % 13);
        }
        const ExpectedOrder order = key_order_of(c, names);
        map.rebuild(named_lists(c, names), by_key(c));
        expect_order(map, order, c.text);
        ASSERT_TRUE(rows_equal(map.rows(), in_key_order(brute_force(c), order))) << c.text;
    }
}

TEST(KeyOrder, an_owner_that_is_no_internal_node_is_refused) {
    Case c = cloud(20, 1);
    c.lists[0].n_internal = 10;
    NodeNames names;
    names.owner = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 10}};
    ConnectivityMap map;
    rebuild(map, c);
    const Expected before = brute_force(c);
    EXPECT_TRUE(fails_with(Status::argument, {"ghost 9", "owner 10", "[-1, 10)"},
                           [&] { map.rebuild(named_lists(c, names), by_key(c)); }));
    EXPECT_TRUE(equals(map, before));
    EXPECT_TRUE(fails_with(Status::not_built, {"key_order"}, [&] { map.key_order(); }));
    const std::vector<Slot> short_of_one(9, 0);
    EXPECT_TRUE(fails_with(Status::argument, {"9 owners", "10 ghosts"},
                           [&] { node_lists(c)[0].set_owners(wrap(short_of_one)); }));
}

}  // namespace
}  // namespace connectivity::test
