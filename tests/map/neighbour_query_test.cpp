// SPDX-License-Identifier: BSD-3-Clause
// Questions about single nodes and places, against every node tried.

#include <cmath>

#include <gtest/gtest.h>

#include <connectivity/map/neighbour_query.hpp>
#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

using Slots = std::vector<Slot>;

constexpr SearchMode modes[] = {SearchMode::gather, SearchMode::scatter,
                                SearchMode::gather_scatter};

Case any_case(std::uint64_t seed, int max_nodes = 90) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 != 0, max_nodes, 1});
    c.ghost_rows = true;
    return c;
}

/// Whole rows of brute force, by slot.
std::vector<Slots> rows_of(const Case& c) {
    const Expected e = brute_force(c);
    std::vector<Slots> rows;
    const std::size_t n_lists = c.lists.size();
    for (std::size_t r = 0; r + 1 < e.row_offsets.size(); r += n_lists)
        rows.emplace_back(e.row_slots.begin() + e.row_offsets[r],
                          e.row_slots.begin() + e.row_offsets[r + n_lists]);
    return rows;
}

bool holds(const Slots& all, const Slots& part) {
    return std::includes(all.begin(), all.end(), part.begin(), part.end());
}

TEST(NeighbourQuery, neighbours_of_a_node_are_those_of_the_definition) {
    NeighbourQuery query;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Case c = any_case(seed);
        query.update(node_lists(c), c.domain);
        for (const SearchMode mode : modes) {
            c.mode = mode;
            const auto rows = rows_of(c);
            for (Slot i = 0; i < static_cast<Slot>(rows.size()); i += 7) {
                const Slots& want = rows[static_cast<std::size_t>(i)];
                ASSERT_EQ(query.neighbours(i, mode), want) << c.text << " slot " << i;
                ASSERT_EQ(query.count(i, mode), static_cast<Offset>(want.size()));
                const QueryCandidates steps = query.candidates(i, mode);
                ASSERT_TRUE(holds(steps.refine, want) && holds(steps.refine, {i})) << c.text;
                ASSERT_TRUE(holds(steps.coarse, steps.refine));
                ASSERT_TRUE(holds(steps.master, {i}));
                for (const Slot m : steps.master)
                    ASSERT_TRUE(holds(steps.coarse, rows[static_cast<std::size_t>(m)])) << c.text;
            }
        }
    }
}

/// A place asked for gives what a node there would have in a list of its own.
TEST(NeighbourQuery, a_place_has_the_neighbours_that_a_node_there_would_have) {
    NeighbourQuery query;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Case c = any_case(seed);
        query.update(node_lists(c), c.domain);
        Random random(seed);
        // The place of some node with its support, and one a little off.
        const std::size_t source = seed % c.lists.size();
        if (c.n(source) == 0) continue;
        ListData place = c.lists[source];
        const auto dim = static_cast<std::size_t>(c.dim);
        place.x.resize(dim);
        for (double& x : place.x) x += (seed % 4 == 0 ? 0 : 1e-3) * random.uniform();
        if (place.tensor)
            place.H.resize(static_cast<std::size_t>(n_symmetric(c.dim)));
        else
            place.h.resize(1);
        place.n_internal = 1;
        place.name = "place";
        place.extent = c.kernel_extent();
        Case with_node = c;
        with_node.lists.push_back(place);
        QueryPoint point;
        std::copy(place.x.begin(), place.x.end(), point.x.begin());
        if (place.tensor)
            point.H = place.H;
        else
            point.h = place.h[0];
        for (const SearchMode mode : modes) {
            with_node.mode = mode;
            const Slots want = rows_of(with_node).back();
            ASSERT_EQ(query.neighbours(point, mode), want) << c.text;
            ASSERT_EQ(query.count(point, mode), static_cast<Offset>(want.size()));
            const QueryCandidates steps = query.candidates(point, mode);
            ASSERT_TRUE(holds(steps.refine, want) && holds(steps.coarse, steps.refine)) << c.text;
        }
    }
}

TEST(NeighbourQuery, boxes_hold_what_lies_or_reaches_inside) {
    NeighbourQuery query;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const int dim = static_cast<int>(seed % 3) + 1;
        std::vector<double> x, h;
        for (int k = 0; k < 80; ++k) {
            for (int d = 0; d < dim; ++d) x.push_back(random.uniform());
            h.push_back(k % 9 == 0 ? 0 : 0.2 * random.uniform());
        }
        Case c = scalar_case(dim, x, h, 1);
        const bool periodic = seed % 2 == 0;
        c.domain = {{periodic, periodic, periodic}, {0, 0, 0}, {1, 1, 1}};
        query.update(node_lists(c), c.domain);
        std::vector<double> lo, hi;
        for (int d = 0; d < dim; ++d) {
            lo.push_back(1.2 * random.uniform() - 0.1);
            hi.push_back(lo.back() + 0.4 * random.uniform());
        }
        Slots inside, touching, either;
        for (Slot k = 0; k < 80; ++k) {
            double gap = -1;  // the largest over axes, of the nearest image
            for (int d = 0; d < dim; ++d) {
                double nearest = HUGE_VAL;
                const double at = x[static_cast<std::size_t>(k * dim + d)];
                const auto axis = static_cast<std::size_t>(d);
                for (int image = periodic ? -2 : 0; image <= (periodic ? 2 : 0); ++image)
                    nearest = std::min(
                        nearest, std::max({at + image - hi[axis], lo[axis] - at - image, 0.0}));
                gap = std::max(gap, nearest);
            }
            const double reach = h[static_cast<std::size_t>(k)];
            if (gap <= 0) inside.push_back(k);
            if (reach > 0 && gap <= reach) touching.push_back(k);
            if (gap <= 0 || (reach > 0 && gap <= reach)) either.push_back(k);
        }
        ASSERT_EQ(query.near_box(lo, hi), inside) << seed;
        ASSERT_EQ(query.near_box(lo, hi, SearchMode::scatter), touching) << seed;
        ASSERT_EQ(query.near_box(lo, hi, SearchMode::gather_scatter), either) << seed;
    }
}

TEST(NeighbourQuery, planes_have_the_nodes_that_are_or_reach_near) {
    NeighbourQuery query;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const int dim = static_cast<int>(seed % 3) + 1;
        Case c = random_case(seed, {dim, false, 80, 1});
        query.update(node_lists(c));
        Random random(seed);
        std::vector<double> point, normal;
        for (int d = 0; d < dim; ++d) {
            point.push_back(c.lists[0].x.empty() ? 0 : c.lists[0].x[static_cast<std::size_t>(d)]);
            normal.push_back(random.uniform() - 0.5 + (d == 0));
        }
        double length = 0;
        for (const double n : normal) length += n * n;
        length = std::sqrt(length);
        const double distance = 0.1 * random.uniform();
        Slots near;
        Slot slot = 0;
        for (std::size_t l = 0; l < c.lists.size(); ++l)
            for (Offset a = 0; a < c.n(l); ++a, ++slot) {
                double d = 0;
                for (int k = 0; k < dim; ++k)
                    d += normal[static_cast<std::size_t>(k)] / length *
                         (c.lists[l].x[static_cast<std::size_t>(a * dim + k)] -
                          point[static_cast<std::size_t>(k)]);
                if (std::fabs(d) <= distance) near.push_back(slot);
            }
        ASSERT_EQ(query.near_plane(point, normal, distance), near) << c.text;
    }
}

TEST(NeighbourQuery, supports_reach_a_plane_along_its_normal) {
    // Half axes 0.3 along x and 0.1 along y, turned by 45 degrees, K = 1.
    const double a = 1 / 0.3, b = 1 / 0.1, s = std::sqrt(0.5);
    const std::vector<double> H{0.5 * (a + b), 0.5 * (a - b), 0.5 * (a + b)};
    const double along_x = std::sqrt(0.5 * (0.3 * 0.3 + 0.1 * 0.1));
    const Case c = tensor_case(2, {0, 0}, H, 1);
    NeighbourQuery query;
    query.update(node_lists(c));
    const auto reaches = [&](double x, double y, const std::vector<double>& normal) {
        const std::vector<double> point{x, y};
        return !query.near_plane(point, normal, 0, SearchMode::scatter).empty();
    };
    EXPECT_TRUE(reaches(along_x - 1e-12, 0, {1, 0}));
    EXPECT_FALSE(reaches(along_x + 1e-12, 0, {1, 0}));
    EXPECT_TRUE(reaches(0.3 * s - 1e-12, 0.3 * s, {-2, -2}));
    EXPECT_FALSE(reaches(0.3 * s + 1e-12, 0.3 * s, {2, 2}));
    EXPECT_TRUE(reaches(0.1 * s - 1e-12, -0.1 * s, {1, -1}));
    EXPECT_FALSE(reaches(0.1 * s + 1e-12, -0.1 * s, {1, -1}));
}

TEST(NeighbourQuery, shifts_lead_to_the_nearest_image) {
    Case c = uniform_case(1, {0.1, 0.9, 7.95, -3.4}, 0.1);
    c.domain = {{true, false, false}, {0, 0, 0}, {1, 1, 1}};
    NeighbourQuery query;
    query.update(node_lists(c), c.domain);
    EXPECT_EQ(query.periodic_shift(0, 1)[0], -1);
    EXPECT_EQ(query.periodic_shift(1, 0)[0], 1);
    EXPECT_EQ(query.periodic_shift(0, 2)[0], -8);
    for (Slot i = 0; i < 4; ++i)
        for (Slot j = 0; j < 4; ++j) {
            const auto& x = c.lists[0].x;
            const double at = x[static_cast<std::size_t>(j)] + query.periodic_shift(i, j)[0];
            EXPECT_LE(std::fabs(x[static_cast<std::size_t>(i)] - at), 0.5 + 1e-12);
        }
}

TEST(NeighbourQuery, bad_questions_are_refused) {
    const Case c = cloud(20, 1);
    NeighbourQuery query;
    const auto refused = [&](Status status, const std::vector<std::string>& words, auto ask) {
        EXPECT_TRUE(fails_with(status, words, ask));
    };
    refused(Status::not_built, {"update"}, [&] { query.neighbours(0); });
    refused(Status::argument, {"0 node lists"}, [&] { query.update({}); });
    query.update(node_lists(c));
    refused(Status::argument, {"slot 20", "[0, 20)"}, [&] { query.neighbours(20); });
    refused(Status::argument, {"slot -1"}, [&] { query.count(Slot{-1}); });
    QueryPoint point;
    point.h = -1;
    refused(Status::support, {"h = -1"}, [&] { query.neighbours(point); });
    point.h = 0.1, point.x[1] = NAN;
    refused(Status::nonfinite, {"coordinate 1"}, [&] { query.neighbours(point); });
    const std::vector<double> two{0, 0}, lo{0, 0, 1}, hi{1, 1, 0}, zero{0, 0, 0};
    refused(Status::argument, {"2 and 3"}, [&] { query.near_box(two, hi); });
    refused(Status::argument, {"axis 2"}, [&] { query.near_box(lo, hi); });
    refused(Status::argument, {"normal"}, [&] { query.near_plane(lo, zero, 1); });
    refused(Status::argument, {"distance = -1"}, [&] { query.near_plane(lo, hi, -1); });
    EXPECT_EQ(query.n_slots(), 20);  // still there
}

}  // namespace
}  // namespace connectivity::test
