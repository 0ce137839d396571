// SPDX-License-Identifier: BSD-3-Clause
// The predicate against its definition, and its symmetry bit for bit.

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

#include "map/prepare.hpp"

namespace connectivity::test {
namespace {

template <int Dim>
void check(const Case& c) {
    PreparedStorage storage;
    const std::vector<NodeList> lists = node_lists(c);
    const SearchNodes<Dim> nodes = prepare_nodes<Dim>(lists, c.domain, storage);
    const Significance<Dim> significant = significance(nodes);
    for (Offset i = 0; i < nodes.n; ++i)
        for (Offset j = 0; j < nodes.n; ++j) {
            if (i == j) continue;
            const bool i_sees_j = sees(c, i, j), j_sees_i = sees(c, j, i);
            ASSERT_EQ(significant(i, j, SearchMode::gather), i_sees_j) << c.text;
            ASSERT_EQ(significant(i, j, SearchMode::scatter), j_sees_i) << c.text;
            ASSERT_EQ(significant(i, j, SearchMode::gather_scatter), i_sees_j || j_sees_i)
                << c.text;
            ASSERT_EQ(significant(j, i, SearchMode::gather_scatter), i_sees_j || j_sees_i)
                << c.text;
        }
}

TEST(Predicate, equals_its_definition_and_is_symmetric) {
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        for (const bool periodic : {false, true}) {
            check<1>(random_case(seed, {1, periodic, 30, 4}));
            check<2>(random_case(seed, {2, periodic, 30, 4}));
            check<3>(random_case(seed, {3, periodic, 30, 4}));
        }
}

TEST(Predicate, differences_are_odd_bit_for_bit) {
    Random random(8);
    std::vector<double> x;
    for (int k = 0; k < 300; ++k) x.push_back(random.uniform(-1e3, 1e3));
    Case c = uniform_case(3, x, 0.1);
    c.domain.periodic = {true, false, true};
    c.domain.lo = {-1, 0, 7};
    c.domain.hi = {1.3, 0, 9.9};
    PreparedStorage storage;
    const std::vector<NodeList> lists = node_lists(c);
    const auto significant = significance(prepare_nodes<3>(lists, c.domain, storage));
    for (Offset i = 0; i < 100; ++i)
        for (Offset j = 0; j < 100; ++j) {
            double there[3], back[3];
            significant.difference(i, j, there);
            significant.difference(j, i, back);
            for (int d = 0; d < 3; ++d) ASSERT_EQ(there[d], -back[d]);
        }
}

TEST(Predicate, an_isotropic_tensor_agrees_with_the_scalar_where_the_conversion_is_exact) {
    for (const double h : {0.25, 0.5, 1.0, 4.0}) {
        std::vector<double> x, H;
        for (int k = 0; k < 27; ++k) {
            for (const int at : {k % 3, k / 3 % 3, k / 9}) x.push_back(h * at);
            for (const double component : {1 / h, 0.0, 0.0, 1 / h, 0.0, 1 / h})
                H.push_back(component);
        }
        ConnectivityMap scalar, tensor;
        rebuild(scalar, uniform_case(3, x, h, 1));
        rebuild(tensor, tensor_case(3, x, H, 1));
        EXPECT_EQ(scalar.pairs().size(), 54)
            << "neighbours one spacing apart, exactly on the boundary";
        EXPECT_TRUE(equals(tensor, brute_force(uniform_case(3, x, h, 1))));
        EXPECT_TRUE(equals(scalar, brute_force(tensor_case(3, x, H, 1))));
    }
}

}  // namespace
}  // namespace connectivity::test
