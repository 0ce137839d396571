// SPDX-License-Identifier: BSD-3-Clause
// Ellipsoids whose neighbours lie on the rim, closer to it than floats can tell: what a vector
// search decides must be what the definition says, and few of them may need the slow way.

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/ellipsoid.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

constexpr double K = 2;

/// Nodes of axis ratio up to `ratio`, each with others around it that are on its rim but for a
/// relative difference of up to `blur`.
Case rims(Random& random, int dim, double ratio, double blur) {
    constexpr int n_centres = 30, n_around = 12;
    const double unit = random.pick({1.0, 1.0, 0x1p-250, 0x1p250}),
                 offset = random.pick({0.0, 0.3, 100.0});
    std::vector<double> x, H;
    const auto add = [&](const double* at, const Ellipsoid& e) {
        double packed[6];
        e.pack(dim, K, packed);
        for (int d = 0; d < dim; ++d) x.push_back(at[d] * unit);
        for (int k = 0; k < n_symmetric(dim); ++k) H.push_back(packed[k] / unit);
    };
    for (int k = 0; k < n_centres; ++k) {
        const Ellipsoid e(random, dim, ratio, random.pick({1.0, 0.3}));
        double centre[3], at[3];
        for (double& c : centre) c = offset + random.uniform(0, 3);
        add(centre, e);
        for (int j = 0; j < n_around; ++j) {
            double r[3], u[3] = {0, 0, 0};
            u[random.below(dim)] = random.pick({-1.0, 1.0});
            if (random.chance(0.5))
                e.surface(random, dim, r);
            else
                e.farthest(dim, u, r);  // where its box touches it
            const double stretch =
                1 + random.pick({-1.0, 0.0, 1.0}) * random.log_uniform(1e-17, blur);
            for (int d = 0; d < dim; ++d) at[d] = centre[d] + stretch * r[d];
            add(at, Ellipsoid(random, dim, random.pick({1.0, ratio}), random.pick({0.1, 0.5})));
        }
    }
    return tensor_case(dim, x, H, K);
}

Offset counter(const ConnectivityMap& map, const std::string& name) {
    for (const auto& counter : map.report().counters())
        if (counter.name == name) return counter.value;
    return -1;
}

class Rims : public ::testing::TestWithParam<int> {};

TEST_P(Rims, nodes_on_the_rim_of_an_ellipsoid_are_decided_in_double) {
    Random random(17);
    ConnectivityMap map;
    for (const double ratio : {1.0, 2.0, 10.0, 100.0, 300.0, 1e3, 1e6})
        for (const SearchMode mode :
             {SearchMode::gather_scatter, SearchMode::gather, SearchMode::scatter})
            for (const bool periodic : {false, true}) {
                Case c = rims(random, GetParam(), ratio, 1e-4);
                c.mode = mode;
                c.domain.periodic = {periodic, false, periodic};
                // The largest support is 1 in the unit of the case.
                const double unit = std::fabs(c.lists[0].x[0]) > 1e30    ? 0x1p250
                                    : std::fabs(c.lists[0].x[0]) < 1e-30 ? 0x1p-250
                                                                         : 1.0;
                c.domain.hi = {2.5 * unit, 0, 3 * unit};
                rebuild(map, c, SearchMethod::groups);
                ASSERT_TRUE(equals(map, brute_force(c)))
                    << "ratio " << ratio << ", mode " << static_cast<int>(mode) << ", periodic "
                    << periodic << ", unit " << unit;
            }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Rims, ::testing::Values(1, 2, 3));

TEST(Rims, ordinary_ellipsoids_leave_few_doubts) {
    Random random(3);
    std::vector<double> x, H;
    for (int k = 0; k < 20000; ++k) {
        double packed[6];
        Ellipsoid(random, 3, 10, 0.1).pack(3, K, packed);
        for (int d = 0; d < 3; ++d) x.push_back(random.uniform());
        H.insert(H.end(), packed, packed + 6);
    }
    ConnectivityMap map;
    rebuild(map, tensor_case(3, x, H, K), SearchMethod::groups);
    EXPECT_EQ(counter(map, "nodes_tested_in_double"), 0);
    EXPECT_GT(counter(map, "doubtful_words"), 0);
    EXPECT_LT(counter(map, "doubtful_words"), static_cast<Offset>(map.pairs().size()) / 50);
}

}  // namespace
}  // namespace connectivity::test
