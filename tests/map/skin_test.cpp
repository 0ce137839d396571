// SPDX-License-Identifier: BSD-3-Clause
// Lists built with a skin stay complete while needs_rebuild says false: no pair that brute force
// finds in the moved state is missing from them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void build(ConnectivityMap& map, const Case& c, double skin,
           SearchMethod method = SearchMethod::automatic) {
    MapOptions options = map_options(c, method);
    options.skin = skin;
    map.rebuild(node_lists(c), options);
}

template <class Offsets, class Values>
int missing(const std::vector<Offset>& offsets, const std::vector<Slot>& slots,
            const Offsets& kept_offsets, const Values& kept) {
    int n = 0;
    for (std::size_t r = 0; r + 1 < offsets.size(); ++r)
        for (Offset k = offsets[r]; k < offsets[r + 1]; ++k)
            n += !std::binary_search(kept.data() + kept_offsets(r),
                                     kept.data() + kept_offsets(r + 1),
                                     slots[static_cast<std::size_t>(k)]);
    return n;
}

/// Neighbours and pairs of a state that the map does not list.
int missing(const ConnectivityMap& map, const Case& now) {
    const Expected e = brute_force(now);
    int n = missing(e.row_offsets, e.row_slots, map.rows().offsets, map.rows().slots);
    if (e.pair_offsets.empty()) return n;
    const auto pairs = map.pairs().view();
    return n + missing(e.pair_offsets, e.pair_j, pairs.offsets, pairs.j);
}

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

/// The farthest point of a path at which the map still says that its lists are good, or -1.
template <class Path>
double last_good(ConnectivityMap& map, const Path& path) {
    const auto good = [&](double t) {
        const Case c = path.at(t);
        return !map.needs_rebuild(node_lists(c));
    };
    if (good(1)) return 1;
    double lo = 0, hi = 1;
    for (int k = 0; k < 56; ++k) (good(0.5 * (lo + hi)) ? lo : hi) = 0.5 * (lo + hi);
    return lo > 0 ? lo : -1;
}

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

/// Two nodes just out of reach of each other at the start, and what becomes of them.
class TwoNodes : public testing::Test {
protected:
    static constexpr double skin = 0.25, h = 0.125, K = 2;

    static Case at_distance(double r, bool periodic) {
        Case c = uniform_case(3, {0.01, 0.5, 0.5, 0.01 + r, 0.5, 0.5}, h, K);
        if (periodic) {  // the short way is across the boundary
            c.lists[0].x[3] = 0.01 - r + 2;
            c.domain.periodic = {true, false, true};
            c.domain.hi = {2, 1, 2};
        }
        return c;
    }

    /// Whether the drift from one to the other is within the skin; the lists have to be complete
    /// then.
    static bool is_reused(const Case& before, const Case& after) {
        ConnectivityMap map;
        build(map, before, skin);
        const bool reused = !map.needs_rebuild(node_lists(after));
        EXPECT_EQ(reused ? missing(map, after) : 0, 0);
        return reused;
    }
};

TEST_F(TwoNodes, that_approach_each_other_may_each_use_half_the_skin) {
    for (const bool periodic : {false, true})
        for (const double part : {1 - 1e-6, 1 + 1e-6}) {
            const Case before = at_distance(K * h + skin * (1 - 1e-9), periodic);
            Case after = before;
            const double step = 0.5 * skin * part * (periodic ? -1 : 1);
            after.lists[0].x[0] += step;
            after.lists[0].x[3] -= step;
            EXPECT_EQ(is_reused(before, after), part < 1) << periodic;
        }
}

TEST_F(TwoNodes, whose_supports_grow_may_use_the_skin) {
    for (const double part : {1 - 1e-6, 1 + 1e-6})
        for (const double start : {h, 0.0}) {
            Case before = at_distance(K * start + skin * (1 - 1e-6), false), after = before;
            for (double& value : before.lists[0].h) value = start;
            after.lists[0].h = {start, start + skin * part / K};
            EXPECT_EQ(is_reused(before, after), part < 1);
        }
}

TEST_F(TwoNodes, that_move_and_grow_share_the_skin) {
    for (const double part : {1 - 1e-6, 1 + 1e-6}) {
        const Case before = at_distance(K * h + skin * (1 - 1e-9), false);
        Case after = before;
        after.lists[0].x[0] += 0.25 * skin * part;
        after.lists[0].x[3] -= 0.25 * skin * part;
        after.lists[0].h[0] += 0.5 * skin * part / K;
        EXPECT_EQ(is_reused(before, after), part < 1);
        after.lists[0].h[0] = 0;  // a support that shrinks gives nothing back
        after.lists[0].h[1] = h;
        EXPECT_TRUE(is_reused(before, after));
    }
}

TEST_F(TwoNodes, that_cross_the_boundary_have_hardly_moved) {
    Case before = at_distance(0.4, true), after = before;
    after.lists[0].x[0] += 2 - 0.02;  // the image across the lower face
    EXPECT_TRUE(is_reused(before, after));
    after.lists[0].x[0] += 2e9;  // the same node, a billion boxes away
    EXPECT_TRUE(is_reused(before, after));
    after.lists[0].x[1] += 2;  // the open axis
    EXPECT_FALSE(is_reused(before, after));
}

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

TEST(Skin, is_not_lost_by_rounding) {
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

TEST(Skin, the_lists_hold_nothing_beyond_support_and_skin) {
    const Case c = cloud(1500, 3, 0.05);
    Case wide = c;
    for (double& h : wide.lists[0].h) h += 0.02 / 2;
    ConnectivityMap map;
    for (const SearchMethod method : all_methods) {
        build(map, c, 0.02, method);
        EXPECT_TRUE(equals(map, brute_force(wide)));
    }
}

TEST(Skin, of_zero_keeps_nothing_and_leaves_the_exact_lists) {
    const Case c = cloud(500, 3);
    ConnectivityMap map;
    EXPECT_TRUE(map.needs_rebuild(node_lists(c))) << "never built";
    build(map, c, 0.1);
    EXPECT_FALSE(map.needs_rebuild(node_lists(c)));
    EXPECT_EQ(map.drift(node_lists(c)), 0);
    const auto& entry = *map.report().find("skin");
    EXPECT_EQ(entry.bytes, static_cast<std::int64_t>(4 * 500 * sizeof(double)));
    EXPECT_EQ(entry.asked_by, "caller");
    build(map, c, 0);
    EXPECT_TRUE(equals(map, brute_force(c)));
    EXPECT_TRUE(map.needs_rebuild(node_lists(c)));
    EXPECT_EQ(map.drift(node_lists(c)), infinity);
    EXPECT_EQ(map.report().find("skin")->bytes, 0);
    EXPECT_EQ(map.report().find("skin")->ms, 0);
    EXPECT_FALSE(map.report().find("skin")->built);
}

TEST(Skin, other_shapes_need_a_rebuild) {
    const Case c = cloud(50, 3);
    ConnectivityMap map;
    build(map, c, 10);
    const auto needs = [&](const std::function<void(Case&)>& change) {
        Case other = c;
        change(other);
        return map.needs_rebuild(node_lists(other));
    };
    EXPECT_FALSE(needs([](Case&) {}));
    EXPECT_TRUE(needs([](Case& o) { o.lists[0].n_internal = 49; }));
    EXPECT_TRUE(needs([](Case& o) { o.lists.push_back(o.lists[0]); }));
    EXPECT_TRUE(needs([](Case& o) { o.lists[0].extent = 1.5; }));
    EXPECT_TRUE(needs([](Case& o) { o = cloud(51, 3); }));
    EXPECT_TRUE(needs([](Case& o) { o = cloud(49, 3); }));
    EXPECT_TRUE(needs([](Case& o) { o = uniform_case(2, std::vector<double>(100, 0.5), 0.1); }));
    EXPECT_TRUE(needs([](Case& o) {
        o.lists[0].tensor = true;
        for (int k = 0; k < 50; ++k) o.lists[0].H.insert(o.lists[0].H.end(), {10, 0, 0, 10, 0, 10});
    }));
    EXPECT_TRUE(map.needs_rebuild({}));
}

TEST(Skin, bad_values_need_a_rebuild_which_names_them) {
    const Case c = cloud(50, 3);
    Case tensors = c;
    tensors.lists[0].tensor = true;
    for (int k = 0; k < 50; ++k)
        tensors.lists[0].H.insert(tensors.lists[0].H.end(), {10, 1, 0, 10, 0, 10});
    for (const double bad : {nan, infinity, -infinity}) {
        ConnectivityMap map;
        build(map, c, 1e6);
        Case other = c;
        other.lists[0].x[77] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        EXPECT_TRUE(fails_with(Status::nonfinite, {"node 25"}, [&] { build(map, other, 1e6); }));
        EXPECT_EQ(map.drift(node_lists(c)), 0) << "the failed rebuild left its mark";
        other = c;
        other.lists[0].h[7] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        other.lists[0].h[7] = -1e-3;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
        build(map, tensors, 1e6);
        other = tensors;
        other.lists[0].H[6 * 7] = bad;
        EXPECT_TRUE(map.needs_rebuild(node_lists(other)));
    }
}

TEST(Skin, outside_its_range_is_refused) {
    ConnectivityMap map;
    for (const double bad : {-1.0, -1e-300, 1e-101, 1e101, nan, infinity, -infinity})
        EXPECT_TRUE(
            fails_with(Status::argument, {"skin = "}, [&] { build(map, cloud(20, 1), bad); }));
}

TEST(Skin, counts_towards_half_a_periodic_box) {
    Case c = cloud(50, 3, 0.2);
    c.domain.periodic = {true, true, true};
    c.domain.hi = {1, 1, 1};
    ConnectivityMap map;
    build(map, c, 0.09);
    EXPECT_TRUE(fails_with(Status::half_box, {"node 0", "0.51"}, [&] { build(map, c, 0.11); }));
}

TEST(Skin, needs_tensors_that_can_be_widened) {
    const Case good = tensor_case(2, {0, 0, 1, 1}, {1e6, 0, 1e-6, 1, 0, 1});
    ConnectivityMap map;
    build(map, good, 0.1);
    const Case bad = tensor_case(2, {0, 0, 1, 1}, {1, 0, 1, 1e10, 0, 1e-10});
    build(map, bad, 0);
    EXPECT_TRUE(fails_with(Status::not_spd, {"node 1", "condition number", "skin"},
                           [&] { build(map, bad, 0.1); }));
}

TEST(Skin, what_it_saved_is_counted) {
    const Case c = cloud(50, 3);
    Case moved = c;
    moved.lists[0].x[0] += 0.25;
    ConnectivityMap map;
    build(map, c, 1);
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(map.needs_rebuild(node_lists(moved)));
    moved.lists[0].x[0] += 10;
    EXPECT_TRUE(map.needs_rebuild(node_lists(moved)));
    build(map, c, 1);
    EXPECT_EQ(map.reuse().rebuilds, 2);
    EXPECT_EQ(map.reuse().reuses, 3);
    EXPECT_DOUBLE_EQ(map.reuse().max_drift, 0.5);
    EXPECT_EQ(map.report().count("rebuilds"), 2);
    EXPECT_EQ(map.report().count("reuses"), 3);
    EXPECT_EQ(map.report().count("max_drift_ppm"), 500000);
}

}  // namespace
}  // namespace connectivity::test
