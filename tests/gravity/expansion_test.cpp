// SPDX-License-Identifier: BSD-3-Clause
// Each operator of expansions, and chains of them, against series of Legendre polynomials.
#include <gtest/gtest.h>

#include "expansion_chains.hpp"

namespace connectivity::test {
namespace {

struct Expansions : testing::TestWithParam<const ExpansionKernels*> {
    const ExpansionKernels& k = *GetParam();
};

TEST_P(Expansions, moments_at_points_are_the_series_cut_at_the_order) {
    for (int order = 1; order <= 20; ++order)
        for (const Vec& d : directions()) {
            Chain c(order, d, 0.4, 0.3);
            EXPECT_LE(moments_to_points(k, c), round_off) << order;
        }
}

TEST_P(Expansions, a_local_expansion_of_moments_is_the_series_cut_at_the_order) {
    for (int order = 1; order <= 20; ++order)
        for (const Vec& d : directions()) {
            Chain c(order, d, 0.4, 0.3);
            EXPECT_LE(moments_to_local(k, c), round_off)
                << order << ": " << d[0] << ' ' << d[1] << ' ' << d[2];
        }
}

TEST_P(Expansions, a_local_expansion_of_particles_is_the_series_cut_at_the_order) {
    for (int order = 1; order <= 20; ++order)
        for (const Vec& d : directions()) {
            Chain c(order, d, 0.3, 0.4);
            EXPECT_LE(particles_to_local(k, c), round_off) << order;
        }
}

TEST_P(Expansions, moments_moved_to_the_parent_are_those_of_its_particles) {
    for (int order = 1; order <= 20; ++order) {
        Cells cells(order);
        const Vec parent{0.1L, -0.2L, 0.3L};
        const std::int32_t moved = cells.add(parent, 2), whole = cells.add(parent, 2);
        std::vector<std::int32_t> children;
        for (const Vec& d : directions()) {
            const Cloud cloud = ball(5, parent + d, 0.25, 3);
            children.push_back(cells.add(parent + d, 0.25));
            k.p2m(order, cloud.bodies(), cells.cell(children.back()));
            k.p2m(order, cloud.bodies(), cells.cell(whole));
        }
        const Cloud cloud = ball(5, parent, 0.25, 3);
        children.push_back(cells.add(parent, 0.25));  // a child may be where its parent is
        k.p2m(order, cloud.bodies(), cells.cell(children.back()));
        k.p2m(order, cloud.bodies(), cells.cell(whole));
        k.m2m(order, cells.arrays(), list_of(children), cells.cell(moved));
        EXPECT_LE(moments_difference(order, cells.cell(moved), cells.cell(whole)), 4 * round_off)
            << order;
    }
}

TEST_P(Expansions, a_local_expansion_moved_to_a_child_is_the_same_field) {
    for (int order = 1; order <= 20; ++order) {
        Cells cells(order);
        const Vec centre{0.1L, -0.2L, 0.3L};
        const std::int32_t parent = cells.add(centre, 1);
        std::vector<std::int32_t> children;
        for (const Vec& d : directions()) children.push_back(cells.add(centre + 0.5L * d, 0.25));
        children.push_back(cells.add(centre, 0.25));
        k.p2l(order, ball(9, {3, 1, -2}, 1, 4).bodies(), cells.cell(parent));
        k.l2l(order, cells.cell(parent), cells.arrays(), list_of(children),
              cells.coefficients.data());
        for (const std::int32_t child : children) {
            const Cloud targets = ball(11, cells.centre(child), 0.5, 5);
            Field far(targets.size()), near(targets.size());
            k.l2p(order, cells.cell(parent), targets.points(), far.out());
            k.l2p(order, cells.cell(child), targets.points(), near.out());
            for (std::size_t i = 0; i < far.p.size(); ++i) {
                EXPECT_NEAR(far.p[i], near.p[i], 10 * round_off) << order;
                EXPECT_NEAR(far.ax[i], near.ax[i], 10 * round_off) << order;
                EXPECT_NEAR(far.ay[i], near.ay[i], 10 * round_off) << order;
                EXPECT_NEAR(far.az[i], near.az[i], 10 * round_off) << order;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(all, Expansions, testing::ValuesIn(all_expansion_kernels()),
                         [](const auto& tested) { return tested.param->name; });

}  // namespace
}  // namespace connectivity::test
