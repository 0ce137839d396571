// SPDX-License-Identifier: BSD-3-Clause
// Laws on problems small enough to know the answer by heart: empty lists, one node, two nodes,
// ghosts, h = 0.

#include <gtest/gtest.h>

#include <support/brute_force.hpp>

namespace connectivity::test {
namespace {

using Slots = std::vector<Slot>;

Slots row(const ConnectivityMap& map, Offset r) {
    const auto range = map.rows()[r];
    return Slots(range.begin(), range.end());
}

Slots segment(const ConnectivityMap& map, Offset r, int list) {
    const auto range = map.rows()(r, list);
    return Slots(range.begin(), range.end());
}

template <class Check>
void in_every_method(const Case& c, const Check& check) {
    for (const SearchMethod method : all_methods) {
        SCOPED_TRACE(name_of(method));
        ConnectivityMap map;
        rebuild(map, c, method);
        EXPECT_TRUE(equals(map, brute_force(c)));
        check(map);
    }
}

TEST(Small, no_nodes_give_valid_empty_lists) {
    for (int dim = 1; dim <= 3; ++dim)
        for (const bool tensor : {false, true}) {
            Case c = uniform_case(dim, {}, 1);
            c.lists[0].tensor = tensor;
            in_every_method(c, [](ConnectivityMap& map) {
                EXPECT_EQ(map.rows().n_rows(), 0);
                EXPECT_EQ(map.rows().size(), 0);
                ASSERT_EQ(map.rows().offsets.size(), 1u);
                EXPECT_EQ(map.rows().offsets(0), 0);
                EXPECT_EQ(map.pairs().size(), 0);
                EXPECT_EQ(map.pairs().view().n_slots(), 0);
                EXPECT_EQ(map.pairs().expanded_view().size(), 0);
                EXPECT_EQ(map.pairs().view().find(0, 1), -1);
                EXPECT_EQ(map.generation(), 1u);
            });
        }
}

TEST(Small, one_node_has_an_empty_row) {
    in_every_method(uniform_case(3, {1, 2, 3}, 1), [](ConnectivityMap& map) {
        EXPECT_EQ(map.rows().n_rows(), 1);
        EXPECT_EQ(row(map, 0), Slots{});
        EXPECT_EQ(map.pairs().size(), 0);
    });
}

TEST(Small, two_nodes_are_neighbours_on_the_closed_ball_and_not_beyond) {
    in_every_method(uniform_case(1, {0, 2}, 1), [](ConnectivityMap& map) {
        EXPECT_EQ(row(map, 0), Slots{1});
        EXPECT_EQ(row(map, 1), Slots{0});
    });
    in_every_method(uniform_case(1, {0, std::nextafter(2.0, 3.0)}, 1),
                    [](ConnectivityMap& map) { EXPECT_EQ(map.rows().size(), 0); });
}

TEST(Small, a_node_with_h_zero_sees_nobody_but_is_seen) {
    const Case all_zero = uniform_case(2, {1, 1, 1, 1, 1, 1}, 0);
    in_every_method(all_zero, [](ConnectivityMap& map) { EXPECT_EQ(map.rows().size(), 0); });
    Case one_sees = scalar_case(1, {0, 0, 1, 2.5}, {0, 1, 0, 0});
    in_every_method(one_sees, [](ConnectivityMap& map) {
        EXPECT_EQ(row(map, 0), Slots{1});  // coincident with node 1, which sees it
        EXPECT_EQ(row(map, 1), (Slots{0, 2}));
        EXPECT_EQ(row(map, 2), Slots{1});
        EXPECT_EQ(row(map, 3), Slots{});
    });
    one_sees.mode = SearchMode::gather;
    in_every_method(one_sees, [](ConnectivityMap& map) {
        EXPECT_EQ(row(map, 0), Slots{});
        EXPECT_EQ(row(map, 1), (Slots{0, 2}));
    });
    one_sees.mode = SearchMode::scatter;
    in_every_method(one_sees, [](ConnectivityMap& map) {
        EXPECT_EQ(row(map, 0), Slots{1});
        EXPECT_EQ(row(map, 1), Slots{});
        EXPECT_EQ(row(map, 2), Slots{1});
    });
}

TEST(Small, coincident_nodes_are_neighbours_and_a_node_is_never_its_own) {
    for (int dim = 1; dim <= 3; ++dim)
        for (const int n : {2, 16, 17, 64, 65, 513}) {
            const std::vector<double> x(static_cast<std::size_t>(n * dim), 0.3);
            in_every_method(uniform_case(dim, x, 1e-3), [&](ConnectivityMap& map) {
                EXPECT_EQ(map.pairs().size(), Offset{n} * (n - 1) / 2);
                EXPECT_EQ(map.rows().size(), Offset{n} * (n - 1));
            });
        }
}

/// On a line, spacing 1: internal 0, 1 and ghost 2 of the first list; internal 3, ghosts 4, 5 of
/// the second.
Case ghosts() {
    Case c = uniform_case(1, {0, 1, 2}, 0.5);
    c.lists[0].n_internal = 2;
    c.lists.push_back(c.lists[0]);
    c.lists[1].name = "other";
    c.lists[1].x = {3, 4, 5};
    c.lists[1].n_internal = 1;
    return c;
}

TEST(Ghosts, are_neighbours_but_have_no_rows_and_no_pairs_among_themselves) {
    in_every_method(ghosts(), [](ConnectivityMap& map) {
        EXPECT_EQ(map.rows().n_rows(), 3);
        EXPECT_EQ(row(map, 1), (Slots{0, 2}));
        EXPECT_EQ(row(map, 2), (Slots{2, 4}));  // slot 3
        EXPECT_EQ(segment(map, 2, 0), Slots{2});
        EXPECT_EQ(segment(map, 2, 1), Slots{4});
        EXPECT_EQ(map.pairs().view().find(4, 5), -1);
        EXPECT_GE(map.pairs().view().find(2, 3), 0) << "a ghost before its internal partner";
        EXPECT_EQ(map.pairs().size(), 4);
        EXPECT_EQ(map.layout().row_of_slot(2), -1);
        EXPECT_EQ(map.layout().slot_of_row(2), 3);
    });
}

TEST(Ghosts, have_rows_and_pairs_among_themselves_on_request) {
    Case c = ghosts();
    c.ghost_rows = true;
    in_every_method(c, [](ConnectivityMap& map) {
        EXPECT_EQ(map.rows().n_rows(), 6);
        EXPECT_EQ(row(map, 4), (Slots{3, 5}));
        EXPECT_GE(map.pairs().view().find(4, 5), 0);
        EXPECT_EQ(map.pairs().size(), 5);
    });
}

TEST(Ghosts, alone_they_make_no_rows_and_no_pairs) {
    Case c = uniform_case(2, {0, 0, 0, 0, 1, 0, 1, 1}, 1);
    c.lists[0].n_internal = 0;
    in_every_method(c, [](ConnectivityMap& map) {
        EXPECT_EQ(map.rows().n_rows(), 0);
        EXPECT_EQ(map.pairs().size(), 0);
        EXPECT_EQ(map.pairs().view().n_slots(), 4);
    });
    c.ghost_rows = true;
    in_every_method(c, [](ConnectivityMap& map) { EXPECT_EQ(map.pairs().size(), 6); });
}

TEST(Lists, empty_ones_count_for_the_extent_and_repeat_offsets) {
    for (std::size_t empty = 0; empty < 3; ++empty) {
        Case c = uniform_case(1, {0, 1, 2}, 0.5, 1);
        c.lists.insert(c.lists.begin() + (empty == 0 ? 1 : 0), c.lists[0]);
        c.lists[1].x = {3, 4, 5};
        ListData nothing;
        nothing.name = "nothing";
        nothing.extent = 4;  // reaches two spacings
        nothing.tensor = empty == 1;
        c.lists.insert(c.lists.begin() + static_cast<std::ptrdiff_t>(empty), nothing);
        in_every_method(c, [&](ConnectivityMap& map) {
            EXPECT_EQ(row(map, 0), (Slots{1, 2}));
            EXPECT_EQ(row(map, 2), (Slots{0, 1, 3, 4}));
            EXPECT_EQ(segment(map, 2, static_cast<int>(empty)), Slots{});
            EXPECT_EQ(map.layout().list_offset()[empty], map.layout().list_offset()[empty + 1]);
        });
    }
}

TEST(Lists, thirty_three_of_them_work) {
    Case c;
    c.dim = 2;
    for (int l = 0; l < 33; ++l) {
        ListData list = uniform_case(2, {double(l), 0, double(l), 1}, 0.5).lists[0];
        list.name = std::string(1, static_cast<char>('A' + l));
        c.lists.push_back(list);
    }
    in_every_method(c, [](ConnectivityMap& map) {
        EXPECT_EQ(map.layout().n_lists(), 33);
        EXPECT_EQ(map.pairs().size(), 33 + 2 * 32);
    });
}

TEST(LargeSupports, one_that_covers_everything_loses_nobody) {
    std::vector<double> x, h(1000, 1e-9);
    for (int k = 0; k < 1000; ++k) x.push_back(0.001 * k);
    for (const int giant : {0, 1, 511, 512, 999}) {
        h.assign(1000, 1e-9);
        h[static_cast<std::size_t>(giant)] = 1e6;
        in_every_method(scalar_case(1, x, h),
                        [](ConnectivityMap& map) { EXPECT_EQ(map.pairs().size(), 999); });
    }
    in_every_method(uniform_case(1, x, 1e6),
                    [](ConnectivityMap& map) { EXPECT_EQ(map.pairs().size(), 1000 * 999 / 2); });
    in_every_method(uniform_case(1, x, 1e200),  // its square is infinite
                    [](ConnectivityMap& map) { EXPECT_EQ(map.pairs().size(), 1000 * 999 / 2); });
}

TEST(Periodic, nodes_see_each_other_across_the_box_and_from_other_images) {
    Case c = uniform_case(2, {0.01, 0.5, 0.99, 0.5, 7.5, -3.5, 0.5, 0.01}, 0.02);
    c.domain.hi = {1, 1, 1};
    c.domain.periodic = {true, false, false};
    in_every_method(c, [](ConnectivityMap& map) {
        EXPECT_EQ(map.pairs().size(), 1);
        EXPECT_EQ(row(map, 0), Slots{1});
    });
    c.domain.periodic = {true, true, false};
    c.lists[0].x[5] = -3.97;  // 0.03 above: the image of node 2 lies 0.02 over node 3
    in_every_method(c, [](ConnectivityMap& map) { EXPECT_EQ(row(map, 2), Slots{3}); });
}

}  // namespace
}  // namespace connectivity::test
