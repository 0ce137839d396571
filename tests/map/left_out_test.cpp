// SPDX-License-Identifier: BSD-3-Clause
// Pairs left out by lists or by a predicate, and rows of active nodes only.

#include <gtest/gtest.h>

#include <connectivity/map/pairwise_field.hpp>
#include <support/expect_error.hpp>
#include <support/key_order.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// Brute force lists without the pairs for which keep(i, j) is false.
template <class Keep>
Expected filtered(const Expected& all, const Keep& keep) {
    Expected out = all;
    out.row_slots.clear(), out.pair_j.clear();
    const std::size_t n_lists = all.list_offset.size() - 1;
    std::size_t row = 0;
    out.row_offsets = {0};
    for (std::size_t l = 0; l < n_lists; ++l)
        for (Offset a = 0; a < all.row_offset[l + 1] - all.row_offset[l]; ++a, ++row)
            for (std::size_t m = 0; m < n_lists; ++m) {
                const std::size_t segment = row * n_lists + m;
                for (Offset k = all.row_offsets[segment]; k < all.row_offsets[segment + 1]; ++k) {
                    const Slot j = all.row_slots[static_cast<std::size_t>(k)];
                    if (keep(static_cast<Slot>(all.list_offset[l] + a), j))
                        out.row_slots.push_back(j);
                }
                out.row_offsets.push_back(static_cast<Offset>(out.row_slots.size()));
            }
    if (all.pair_offsets.empty()) return out;
    out.pair_offsets = {0};
    for (std::size_t i = 0; i + 1 < all.pair_offsets.size(); ++i) {
        for (Offset k = all.pair_offsets[i]; k < all.pair_offsets[i + 1]; ++k)
            if (const Slot j = all.pair_j[static_cast<std::size_t>(k)];
                keep(static_cast<Slot>(i), j))
                out.pair_j.push_back(j);
        out.pair_offsets.push_back(static_cast<Offset>(out.pair_j.size()));
    }
    return out;
}

ConstView<std::uint8_t> wrap(const std::vector<std::uint8_t>& values) {
    return ConstView<std::uint8_t>(values.data(), values.size());
}

int list_of(const Expected& e, Slot slot) {
    int list = 0;
    while (slot >= e.list_offset[static_cast<std::size_t>(list) + 1]) ++list;
    return list;
}

/// A predicate that knows nothing of order: the library asks for (low, high).
bool odd_sum(Slot i, Slot j) { return (i + 3 * j) % 3 == 1; }

struct Tired {};

std::shared_ptr<const PairPredicate> odd_sums() {
    return std::make_shared<const PairPredicate>(odd_sum);
}

TEST(LeftOut, a_predicate_takes_pairs_out_of_rows_and_pairs_alike) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 100});
        MapOptions options = map_options(c);
        options.exclude = odd_sums();
        map.rebuild(node_lists(c), options);
        ASSERT_TRUE(equals(
            map, filtered(brute_force(c),
                          [](Slot i, Slot j) { return !odd_sum(std::min(i, j), std::max(i, j)); })))
            << c.text;
    }
}

TEST(LeftOut, traversals_leave_out_the_same) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 100});
        MapOptions options = map_options(c);
        options.exclude = odd_sums();
        const Expected want = filtered(brute_force(c), [](Slot i, Slot j) {
            return !odd_sum(std::min(i, j), std::max(i, j));
        });
        std::vector<std::vector<Slot>> rows(static_cast<std::size_t>(c.n_slots()));
        map.for_each_row(node_lists(c), options, [&](int, Slot slot, std::span<const Slot> row) {
            rows[static_cast<std::size_t>(slot)].assign(row.begin(), row.end());
        });
        std::vector<Slot> all;
        for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
        ASSERT_EQ(all, want.row_slots) << c.text;
    }
}

TEST(LeftOut, lists_that_do_not_see_each_other_have_no_pairs) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 100});
        const std::size_t n_lists = c.lists.size();
        Random random(seed);
        MapOptions options = map_options(c);
        options.interactions.assign(n_lists * n_lists, 0);
        for (std::size_t a = 0; a < n_lists; ++a)
            for (std::size_t b = a; b < n_lists; ++b)
                options.interactions[a * n_lists + b] = options.interactions[b * n_lists + a] =
                    random.uniform() < 0.5;
        if (seed % 3 == 0 && c.mode == SearchMode::gather_scatter) options.order = ListOrder::key;
        Case stored = c;
        stored.ghost_rows = stored.ghost_rows || options.order == ListOrder::key;
        const Expected all = brute_force(stored);
        Expected want = filtered(all, [&](Slot i, Slot j) {
            return options.interactions[static_cast<std::size_t>(list_of(all, i)) * n_lists +
                                        static_cast<std::size_t>(list_of(all, j))] != 0;
        });
        if (options.order == ListOrder::key) want = in_key_order(want, key_order_of(c));
        map.rebuild(node_lists(c), options);
        ASSERT_TRUE(equals(map, want)) << c.text;
    }
}

TEST(LeftOut, removing_pairs_later_gives_the_same) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 100});
        c.mode = SearchMode::gather_scatter;
        rebuild(map, c);
        PairwiseField<double> field(map.pairs());
        const auto before = map.pairs().view();
        for (Offset k = 0; k < before.size(); ++k) field(k) = before[k].i + 1e6 * before[k].j;
        PairFieldBase* const fields[] = {&field};
        map.remove_pairs(odd_sum, fields);
        ASSERT_TRUE(equals(
            map, filtered(brute_force(c),
                          [](Slot i, Slot j) { return !odd_sum(std::min(i, j), std::max(i, j)); })))
            << c.text;
        const auto after = map.pairs().view();
        for (Offset k = 0; k < after.size(); ++k)
            ASSERT_EQ(field(k), after[k].i + 1e6 * after[k].j);
    }
}

TEST(LeftOut, only_active_nodes_have_neighbours_and_every_pair_has_one) {
    ConnectivityMap map;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        const Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, 120});
        Random random(seed);
        std::vector<std::uint8_t> active;
        const double share = random.uniform();
        for (Offset k = 0; k < c.n_slots(); ++k) active.push_back(random.uniform() < share);
        const Expected all = brute_force(c);
        const auto stored = [&](Slot s) {
            const int list = list_of(all, s);
            return active[static_cast<std::size_t>(s)] != 0 &&
                   (c.ghost_rows || s - all.list_offset[static_cast<std::size_t>(list)] <
                                        c.lists[static_cast<std::size_t>(list)].n_internal);
        };
        Expected want = filtered(all, [&](Slot i, Slot) { return stored(i); });
        if (!all.pair_offsets.empty()) {
            const Expected pairs =
                filtered(all, [&](Slot i, Slot j) { return stored(i) || stored(j); });
            want.pair_offsets = pairs.pair_offsets, want.pair_j = pairs.pair_j;
        }
        for (const SearchMethod method : all_methods) {
            MapOptions options = map_options(c, method);
            options.active = wrap(active);
            map.rebuild(node_lists(c), options);
            ASSERT_TRUE(equals(map, want)) << name_of(method) << ", " << c.text;
            if (want.pair_offsets.empty()) continue;
            options.rows = false;
            map.rebuild(node_lists(c), options);
            ASSERT_TRUE(pairs_equal(map.pairs().view(), want)) << name_of(method) << c.text;
        }
    }
}

TEST(LeftOut, bad_requests_are_refused_and_change_nothing) {
    const Case c = cloud(30, 3, 0.3);
    ConnectivityMap map;
    rebuild(map, c);
    const auto refused = [&](const std::vector<std::string>& words, auto change) {
        MapOptions options = map_options(c);
        change(options);
        EXPECT_TRUE(
            fails_with(Status::argument, words, [&] { map.rebuild(node_lists(c), options); }));
        EXPECT_TRUE(equals(map, brute_force(c)));
    };
    refused({"interactions has 4"}, [](MapOptions& o) { o.interactions = {1, 1, 1, 1}; });
    refused({"interactions[0][0] = 2"}, [](MapOptions& o) { o.interactions = {2}; });
    const std::vector<std::uint8_t> few(29, 1), bad(30, 3);
    refused({"active has 29", "30"}, [&](MapOptions& o) { o.active = wrap(few); });
    refused({"active[0] = 3"}, [&](MapOptions& o) { o.active = wrap(bad); });
    const std::vector<std::uint8_t> all(30, 1);
    refused({"all nodes active"}, [&](MapOptions& o) {
        o.active = wrap(all);
        o.overlap = true;
    });
    refused({"gather_scatter"}, [](MapOptions& o) {
        o.pairs = false, o.overlap = true;
        o.mode = SearchMode::gather;
    });
    refused({"exclude", "empty"},
            [](MapOptions& o) { o.exclude = std::make_shared<const PairPredicate>(); });
    EXPECT_TRUE(fails_with(Status::argument, {"empty"}, [&] { map.remove_pairs({}); }));
    MapOptions options = map_options(c);
    options.overlap = true;
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::argument, {"overlap"}, [&] { map.remove_pairs(odd_sum); }));
}

TEST(LeftOut, what_a_predicate_throws_comes_out_and_the_lists_stay) {
    const Case c = cloud(400, 3);
    const std::vector<NodeList> lists = node_lists(c);
    for (const ListOrder order : {ListOrder::slot, ListOrder::key}) {
        MapOptions options;
        options.order = order;
        ConnectivityMap map;
        map.rebuild(lists, options);
        const auto rows = map.rows();
        const Offset n_pairs = map.pairs().size();
        options.exclude = std::make_shared<const PairPredicate>([](Slot i, Slot j) -> bool {
            if ((i + j) % 2 == 0) throw Tired();
            return true;
        });
        EXPECT_THROW(map.rebuild(lists, options), Tired);
        EXPECT_THROW(map.for_each_row(lists, options, [](int, Slot, std::span<const Slot>) {}),
                     Tired);
        options.exclude = std::make_shared<const PairPredicate>(
            [](Slot, Slot) -> bool { throw std::bad_alloc(); });
        EXPECT_TRUE(fails_with(Status::memory, {}, [&] { map.rebuild(lists, options); }));
        EXPECT_EQ(map.generation(), 1u);
        EXPECT_EQ(map.rows().slots.data(), rows.slots.data());
        EXPECT_EQ(map.rows().size(), rows.size());
        EXPECT_EQ(map.pairs().size(), n_pairs);
    }
}

}  // namespace
}  // namespace connectivity::test
