// SPDX-License-Identifier: BSD-3-Clause
// Lists in arrays of the host: those of brute force, by the two-call pattern.

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using Slots = std::vector<std::int32_t>;

std::vector<NodeSet> two_lists() {
    std::vector<NodeSet> sets{random_nodes(3, 150, 1), random_nodes(3, 70, 2)};
    sets[1].n_internal = 30;
    return sets;
}

class CapiCopies : public ::testing::Test {
protected:
    Context context;
    Built built{context, 3, two_lists()};
    conn_map* const map = built.map.handle;
    Lists expected = brute_force(3, two_lists());
};

TEST_F(CapiCopies, rows_are_those_of_brute_force_cut_by_list) {
    std::int64_t n_offsets = -1, n_slots = -1;
    ASSERT_TRUE(ok(conn_map_rows_copy(map, nullptr, 0, &n_offsets, nullptr, 0, &n_slots)));
    ASSERT_EQ(n_offsets, 180 * 2 + 1);
    std::vector<std::int64_t> offsets(static_cast<std::size_t>(n_offsets));
    Slots slots(static_cast<std::size_t>(n_slots));
    ASSERT_TRUE(ok(conn_map_rows_copy(map, offsets.data(), n_offsets, &n_offsets, slots.data(),
                                      n_slots, &n_slots)));
    ASSERT_EQ(expected.rows.size(), 180u);
    for (std::size_t r = 0; r < 180; ++r) {
        EXPECT_EQ(Slots(slots.begin() + offsets[2 * r], slots.begin() + offsets[2 * r + 2]),
                  expected.rows[r]);
        for (std::int64_t k = offsets[2 * r]; k < offsets[2 * r + 2]; ++k)
            EXPECT_EQ(slots[static_cast<std::size_t>(k)] < 150, k < offsets[2 * r + 1]);
    }
}

TEST_F(CapiCopies, rows_too_long_for_an_array_write_nothing_and_tell_both_sizes) {
    std::int64_t n_offsets = 0, n_slots = 0;
    ASSERT_TRUE(ok(conn_map_rows_copy(map, nullptr, 0, &n_offsets, nullptr, 0, &n_slots)));
    std::vector<std::int64_t> offsets(static_cast<std::size_t>(n_offsets), -7);
    Slots slots(static_cast<std::size_t>(n_slots), -7);
    for (const bool short_slots : {false, true}) {
        std::int64_t sizes[2] = {};
        EXPECT_TRUE(
            fails(conn_map_rows_copy(map, offsets.data(), n_offsets - !short_slots, &sizes[0],
                                     slots.data(), n_slots - short_slots, &sizes[1]),
                  CONN_E_BUFFER, {short_slots ? "slots_capacity" : "offsets_capacity"}));
        EXPECT_EQ(sizes[0], n_offsets);
        EXPECT_EQ(sizes[1], n_slots);
        EXPECT_EQ(offsets[0], -7);
        EXPECT_EQ(slots[0], -7);
    }
    EXPECT_TRUE(
        ok(conn_map_rows_copy(map, nullptr, 0, &n_offsets, slots.data(), n_slots, &n_slots)));
    EXPECT_TRUE(fails(conn_map_rows_copy(map, nullptr, 0, nullptr, slots.data(), n_slots, &n_slots),
                      CONN_E_NULL, {"n_offsets"}));
    EXPECT_TRUE(fails(conn_map_rows_copy(map, nullptr, 0, &n_offsets, nullptr, 0, nullptr),
                      CONN_E_NULL, {"n_slots"}));
}

TEST_F(CapiCopies, pairs_are_those_of_brute_force_with_coupling_one_unless_set) {
    const auto copy = [&](int which) {
        return two_calls<std::int32_t>([&](std::int32_t* out, std::int64_t room, std::int64_t* n) {
            return conn_map_pairs_copy(map, which == 0 ? out : nullptr, which == 1 ? out : nullptr,
                                       nullptr, room, n);
        });
    };
    const Slots i = copy(0), j = copy(1);
    ASSERT_EQ(i.size(), expected.pairs.size());
    for (std::size_t k = 0; k < i.size(); ++k) EXPECT_EQ(std::pair(i[k], j[k]), expected.pairs[k]);
    const auto coupling = [&] {
        return two_calls<double>([&](double* out, std::int64_t room, std::int64_t* n) {
            return conn_map_pairs_copy(map, nullptr, nullptr, out, room, n);
        });
    };
    EXPECT_EQ(coupling(), std::vector<double>(i.size(), 1.0));
    std::vector<double> values(i.size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1.0 / static_cast<double>(k + 1);
    ASSERT_TRUE(ok(conn_map_set_coupling(map, values.data(), std::ssize(values))));
    EXPECT_EQ(coupling(), values);
    EXPECT_TRUE(fails(conn_map_pairs_copy(map, nullptr, nullptr, nullptr, 0, nullptr), CONN_E_NULL,
                      {"n_pairs"}));
}

TEST_F(CapiCopies, pairs_in_key_order_name_both_nodes) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    ASSERT_TRUE(ok(built.rebuild(options)));
    conn_pairs_view view = CONN_PAIRS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &view)));
    const auto pairs = pairs_of(view);
    ASSERT_TRUE(ok(conn_map_pairs_release(&view)));
    Slots i(pairs.size()), j(pairs.size());
    std::int64_t n = 0;
    ASSERT_TRUE(ok(conn_map_pairs_copy(map, i.data(), j.data(), nullptr, std::ssize(i), &n)));
    for (std::size_t k = 0; k < i.size(); ++k) EXPECT_EQ(std::pair(i[k], j[k]), pairs[k]);
}

TEST_F(CapiCopies, what_was_not_built_cannot_be_copied) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.rows = 0;
    ASSERT_TRUE(ok(built.rebuild(options)));
    std::int64_t n = -3, m = -3;
    EXPECT_TRUE(fails(conn_map_rows_copy(map, nullptr, 0, &n, nullptr, 0, &m), CONN_E_NOT_BUILT));
    EXPECT_TRUE(ok(conn_map_pairs_copy(map, nullptr, nullptr, nullptr, 0, &n)));
    options.rows = 1, options.pairs = 0;
    ASSERT_TRUE(ok(built.rebuild(options)));
    EXPECT_TRUE(
        fails(conn_map_pairs_copy(map, nullptr, nullptr, nullptr, 0, &n), CONN_E_NOT_BUILT));
    EXPECT_EQ(m, -3);
}

}  // namespace
}  // namespace connectivity::test
