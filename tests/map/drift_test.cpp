// SPDX-License-Identifier: BSD-3-Clause
// While needs_rebuild says false, no pair that brute force finds in the moved state is missing from
// the lists: random problems along random paths, and pairs at the very limit.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>
#include <support/skin.hpp>

namespace connectivity::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// R H R^T of a packed tensor, R a rotation by an angle in the plane of axes a and b.
void rotate(double* packed, int dim, int a, int b, double angle) {
    double H[3][3], R[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0, k = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j, ++k) H[i][j] = H[j][i] = packed[k];
    R[a][a] = R[b][b] = std::cos(angle);
    R[b][a] = std::sin(angle);
    R[a][b] = -R[b][a];
    for (int i = 0, k = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j, ++k) {
            packed[k] = 0;
            for (int p = 0; p < dim; ++p)
                for (int q = 0; q < dim; ++q) packed[k] += R[i][p] * H[p][q] * R[j][q];
        }
}

/// A random case with room for a skin, and a path along which its nodes move and its supports
/// change: away from it at 0, far away at 1.
class Path {
public:
    Path(std::uint64_t seed, const CaseKind& kind) : start_(random_case(seed, kind)), seed_(seed) {
        Random random(mix(seed) + 7);
        double room = infinity;
        for (int d = 0; d < start_.dim; ++d)
            if (start_.domain.periodic[static_cast<std::size_t>(d)])
                room = std::min(room, 0.05 * start_.domain.length(d));
        if (room < infinity)
            for (ListData& list : start_.lists) {
                for (double& h : list.h) h *= 0.4;
                for (double& H : list.H) H *= 2.5;
            }
        skin_ = std::min(room, typical_support() * random.log_uniform(1e-3, 1));
        moves_ = random.pick({0.0, 1.0, 1.0, 1.0});
        grows_ = moves_ == 0 ? 1.0 : random.pick({0.0, 0.1, 1.0});
        leaps_ = random.chance(0.3);
    }

    const Case& start() const { return start_; }
    double skin() const { return skin_; }

    Case at(double t) const {
        Case c = start_;
        Random random(mix(seed_) + 8);
        for (ListData& list : c.lists) {
            move(random, t, list);
            for (double& h : list.h)
                h = std::max(0.0, h + t * grows_ * skin_ / c.kernel_extent() *
                                          random.pick({2.0, 2.0, 0.5, -1.0}));
            const int size = n_symmetric(c.dim);
            for (std::size_t k = 0; k < list.H.size(); k += static_cast<std::size_t>(size))
                change(random, t, c.dim, list.H.data() + k);
        }
        return c;
    }

private:
    double typical_support() const {
        std::vector<double> all{1e-6};
        for (const ListData& list : start_.lists) {
            for (const double h : list.h)
                if (h > 0) all.push_back(h);
            for (std::size_t k = 0; k < list.H.size();
                 k += static_cast<std::size_t>(n_symmetric(start_.dim)))
                all.push_back(1 / list.H[k]);
        }
        std::nth_element(all.begin(), all.begin() + static_cast<int>(all.size() / 2), all.end());
        return start_.kernel_extent() * all[all.size() / 2];
    }

    /// Towards another node of the list, each by the same length; on periodic axes any image.
    void move(Random& random, double t, ListData& list) const {
        const std::vector<double>& x = list.x;
        std::vector<double> moved = x;
        const int n = static_cast<int>(x.size()) / start_.dim;
        for (int a = 0; a < n; ++a) {
            const int b = random.chance(0.5) && (a ^ 1) < n ? a ^ 1 : random.below(n);
            double step[3], length = 0;
            for (int d = 0; d < start_.dim; ++d) {
                const auto axis = static_cast<std::size_t>(d);
                step[d] = x[static_cast<std::size_t>(b * start_.dim + d)] -
                          x[static_cast<std::size_t>(a * start_.dim + d)];
                if (start_.domain.periodic[axis])
                    step[d] = std::remainder(step[d], start_.domain.length(d));
                if (a == b) step[d] = random.uniform(-1, 1);
                length = std::hypot(length, step[d]);
            }
            for (int d = 0; d < start_.dim; ++d) {
                double& value = moved[static_cast<std::size_t>(a * start_.dim + d)];
                if (length > 0) value += t * moves_ * skin_ * step[d] / length;
                if (leaps_ && start_.domain.periodic[static_cast<std::size_t>(d)])
                    value += start_.domain.length(d) * random.below(3);
            }
        }
        list.x = moved;
    }

    void change(Random& random, double t, int dim, double* packed) const {
        const double t_grow = t * grows_ * random.pick({1.0, 1.0, 0.3, -0.3});
        if (dim > 1)
            rotate(packed, dim, 0, 1 + random.below(dim - 1), t * grows_ * random.uniform(0, 0.5));
        for (int k = 0; k < n_symmetric(dim); ++k) packed[k] /= 1 + t_grow;
    }

    Case start_;
    std::uint64_t seed_;
    double skin_ = 0, moves_ = 1, grows_ = 1;
    bool leaps_ = false;
};

class RandomPaths : public testing::TestWithParam<CaseKind> {};

TEST_P(RandomPaths, no_pair_is_missed_until_a_rebuild_is_asked_for) {
    ConnectivityMap map;
    int n_judged = 0;
    for (std::uint64_t seed = 0; seed < 700; ++seed) {
        const Path path(seed, GetParam());
        build(map, path.start(), path.skin(), all_methods[seed % 4]);
        ASSERT_EQ(missing(map, path.start()), 0) << path.start().text;
        const double t = last_good(map, path);
        if (t < 0) continue;
        ++n_judged;
        for (const double part : {1.0, 0.37}) {
            const Case now = path.at(part * t);
            if (map.needs_rebuild(node_lists(now))) continue;  // leaps between images may differ
            ASSERT_EQ(missing(map, now), 0)
                << path.start().text << ", skin " << path.skin() << ", t " << part * t;
        }
    }
    EXPECT_GT(n_judged, 600) << "too few paths had a state that was judged good";
}

INSTANTIATE_TEST_SUITE_P(Cases, RandomPaths,
                         testing::Values(CaseKind{1, false, 60}, CaseKind{1, true, 60},
                                         CaseKind{2, false, 80}, CaseKind{2, true, 80},
                                         CaseKind{3, false, 90}, CaseKind{3, true, 90}),
                         [](const auto& kind) {
                             return std::to_string(kind.param.dim) + "D" +
                                    (kind.param.periodic ? "periodic" : "open");
                         });

/// Two nodes a hair off support and skin, which then approach and grow by all they may, a few
/// boxes or millions of boxes away where an axis is periodic.
class Hair {
public:
    explicit Hair(std::uint64_t seed) : random_(seed) {
        const int dim = 1 + random_.below(3);
        const double K = 2.7, h = random_.log_uniform(0.01, 0.1);
        double length = 0;
        for (int d = 0; d < dim; ++d) length = std::hypot(length, way_[d] = random_.uniform(-1, 1));
        skin_ = random_.log_uniform(1e-4, 0.05);
        // Around the limit, by a few roundings of the numbers that matter.
        const double r = (K * h + skin_) * (1 + random_.pick({-1.0, -1.0, 0.0, 1.0}) *
                                                    random_.log_uniform(1e-17, 1e-11));
        start_ = uniform_case(dim, std::vector<double>(static_cast<std::size_t>(2 * dim)), h, K);
        start_.domain.periodic.fill(random_.chance(0.6));
        start_.domain.hi = {1.1, 1.3, 1.7};
        for (int d = 0; d < dim; ++d) {
            way_[d] /= length;
            x(start_, 0, d) = random_.uniform();
            x(start_, 1, d) = x(start_, 0, d) + r * way_[d];
            if (start_.domain.periodic[0] && random_.chance(0.5))
                for (const int node : {0, 1})
                    leap_[node][d] =
                        start_.domain.length(d) * random_.below(random_.pick({2, 1000, 1000000}));
        }
        moves_ = random_.pick({0.0, 0.5, random_.uniform(0, 0.5)});
    }

    const Case& start() const { return start_; }
    double skin() const { return skin_; }

    Case at(double t) const {
        Case c = start_;
        for (int d = 0; d < c.dim; ++d)
            for (const int node : {0, 1})
                x(c, node, d) +=
                    leap_[node][d] + (node == 0 ? 1 : -1) * t * moves_ * skin_ * 1.001 * way_[d];
        c.lists[0].h[0] += t * (1 - 2 * moves_) * skin_ * 1.001 / c.kernel_extent();
        return c;
    }

private:
    static double& x(Case& c, int node, int d) {
        return c.lists[0].x[static_cast<std::size_t>(node * c.dim + d)];
    }

    Random random_;
    Case start_;
    double way_[3] = {}, leap_[2][3] = {}, skin_ = 0, moves_ = 0;
};

TEST(Drift, no_pair_is_lost_by_rounding) {
    ConnectivityMap map;
    int n_outside = 0, n_inside = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const Hair hair(seed);
        build(map, hair.start(), hair.skin(), SearchMethod::brute);
        const double t = last_good(map, hair);
        if (t < 0) continue;
        const Case now = hair.at(t);
        n_outside += map.pairs().size() == 0;
        n_inside += !brute_force(now).pair_j.empty();
        ASSERT_EQ(missing(map, now), 0) << seed << ", skin " << hair.skin() << ", t " << t;
    }
    EXPECT_GT(n_outside, 300);
    EXPECT_GT(n_inside, 100);
}

}  // namespace
}  // namespace connectivity::test
