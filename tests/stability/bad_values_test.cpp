// SPDX-License-Identifier: BSD-3-Clause
// A5, A6, A7 and A11: values that are none, supports that are none, tensors that are no ellipsoid,
// and as few nodes as can be.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

using Limits = std::numeric_limits<double>;

/// Refused by every method, naming the node; what the map held stays, and the next build works.
void expect_refused(const Case& bad, Status status, int node) {
    const Case good = cloud(200, 9, 0.15);
    const Expected expected = brute_force(good);
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        rebuild(map, good, method);
        const Generation generation = map.generation();
        EXPECT_TRUE(fails_with(status, {"list 0", "node " + std::to_string(node)}, [&] {
            rebuild(map, bad, method);
        })) << name_of(method);
        EXPECT_EQ(map.generation(), generation);
        EXPECT_TRUE(equals(map, expected)) << name_of(method);
        rebuild(map, good, method);
        EXPECT_TRUE(equals(map, expected)) << name_of(method);
    }
}

TEST(NonFinitePosition, one_in_a_thousand_is_named) {
    for (const double value :
         {Limits::quiet_NaN(), Limits::signaling_NaN(), Limits::infinity(), -Limits::infinity()})
        for (const int node : {0, 431, 999}) {
            Case bad = cloud(1000, 1);
            bad.lists[0].x[static_cast<std::size_t>(3 * node)] = value;  // x only
            expect_refused(bad, Status::nonfinite, node);
        }
}

TEST(BadSupport, one_in_a_thousand_is_named) {
    for (const double value : {-1e-300, -0.1, Limits::quiet_NaN(), Limits::signaling_NaN(),
                               Limits::infinity(), -Limits::infinity()})
        for (const int node : {0, 431, 999}) {
            Case bad = cloud(1000, 2);
            bad.lists[0].h[static_cast<std::size_t>(node)] = value;
            expect_refused(bad, Status::support, node);
        }
}

/// Packed xx, xy, xz, yy, yz, zz. Two of them have a determinant above zero, and none can be told
/// by |H r|, which is even in H. (A tensor that is not symmetric has no packed form.)
TEST(BadTensor, all_that_are_not_positive_definite_are_named) {
    constexpr double nan = Limits::quiet_NaN(), inf = Limits::infinity();
    const double faults[][6] = {{-1, 0, 0, -1, 0, 1},  {1, 0, 0, 1, 0, 0},   {1, 0, 0, 1, 0, -1},
                                {-1, 0, 0, -1, 0, -1}, {1, 2, 0, 1, 0, 1},   {-1, 2, 0, -1, 0, 1},
                                {0, 0, 0, 0, 0, 0},    {nan, 0, 0, 1, 0, 1}, {1, 0, nan, 1, 0, 1},
                                {1, 0, 0, inf, 0, 1}};
    Random random(3);
    std::vector<double> x, H;
    for (int k = 0; k < 300; ++k) {
        for (int d = 0; d < 3; ++d) x.push_back(random.uniform());
        H.insert(H.end(), {10, 0, 0, 10, 0, 10});
    }
    for (const auto& fault : faults)
        for (const int node : {0, 150, 299}) {
            Case bad = tensor_case(3, x, H);
            for (std::size_t k = 0; k < 6; ++k)
                bad.lists[0].H[static_cast<std::size_t>(6 * node) + k] = 10 * fault[k];
            expect_refused(bad, Status::not_spd, node);
        }
}

/// Lists of the given numbers of internal nodes and ghosts, anywhere in the unit box.
Case lists_of(const std::vector<std::pair<int, int>>& sizes, int dim, double h) {
    Random random(4);
    Case c;
    c.dim = dim;
    for (const auto& [n_internal, n_ghosts] : sizes) {
        ListData list;
        list.n_internal = n_internal;
        for (int k = 0; k < dim * (n_internal + n_ghosts); ++k) list.x.push_back(random.uniform());
        list.h.assign(static_cast<std::size_t>(n_internal + n_ghosts), h);
        c.lists.push_back(std::move(list));
    }
    return c;
}

TEST(FewNodes, none_one_two_empty_lists_and_ghosts_alone_are_legal_everywhere) {
    const std::vector<std::pair<int, int>> scenes[] = {{{0, 0}},
                                                       {{1, 0}},
                                                       {{2, 0}},
                                                       {{0, 1}},
                                                       {{0, 70}},
                                                       {{1, 1}},
                                                       {{0, 0}, {0, 0}, {0, 0}},
                                                       {{30, 0}, {0, 0}, {30, 5}},
                                                       {{0, 0}, {1, 0}, {0, 0}},
                                                       {{0, 20}, {20, 0}}};
    for (const auto& sizes : scenes)
        for (int dim = 1; dim <= 3; ++dim)
            for (const double h : {1e-9, 0.2, 5.0})  // two nodes apart, or all in reach
                for (const bool ghost_rows : {false, true}) {
                    Case c = lists_of(sizes, dim, h);
                    c.ghost_rows = ghost_rows;
                    Case all_rows = c;  // what derived lists need
                    all_rows.ghost_rows = true;
                    const Expected plain = brute_force(c), derived = brute_force(all_rows);
                    for (const SearchMethod method : all_methods) {
                        ConnectivityMap map;
                        rebuild(map, c, method);
                        ASSERT_TRUE(equals(map, plain)) << name_of(method);
                        MapOptions options = map_options(c, method);
                        options.overlap = options.spatial_order = true;
                        options.intersection = IntersectionKind::in_segment;
                        map.rebuild(node_lists(c), options);
                        ASSERT_TRUE(equals(map, derived)) << name_of(method);
                        ASSERT_EQ(map.intersection().n_pairs(), map.pairs().size());
                        ASSERT_EQ(map.overlap().n_rows(), c.n_slots());
                    }
                }
}

TEST(FewNodes, no_list_at_all_is_an_error) {
    ConnectivityMap map;
    EXPECT_TRUE(fails_with(Status::argument, {"list"}, [&] { map.rebuild({}, {}); }));
    EXPECT_EQ(map.generation(), 0u);
}

}  // namespace
}  // namespace connectivity::test
