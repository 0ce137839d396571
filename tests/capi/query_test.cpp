// SPDX-License-Identifier: BSD-3-Clause
// Questions about single nodes and places, and checks of a map, through the interface: against
// every node tried.

#include <algorithm>
#include <cmath>
#include <limits>

#include <connectivity_query.h>
#include <support/random.hpp>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using Slots = std::vector<std::int32_t>;

constexpr int modes[] = {CONN_GATHER, CONN_SCATTER, CONN_GATHER_SCATTER};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A query over the sets, and its answers by the two-call pattern.
struct Asked {
    conn_query* handle = nullptr;
    std::vector<std::unique_ptr<Nodes>> nodes;
    std::vector<conn_nodes*> lists;

    Asked(const Context& context, int dim, const std::vector<NodeSet>& sets,
          const conn_map_options* domain = nullptr) {
        for (const NodeSet& set : sets) {
            nodes.push_back(std::make_unique<Nodes>(context, dim, set));
            lists.push_back(nodes.back()->handle);
        }
        EXPECT_TRUE(ok(conn_query_create(context.handle, &handle)));
        EXPECT_TRUE(ok(update(domain)));
    }
    ~Asked() { conn_query_destroy(&handle); }
    Asked(const Asked&) = delete;
    Asked& operator=(const Asked&) = delete;

    conn_status update(const conn_map_options* domain) const {
        return conn_query_update(handle, lists.data(), static_cast<std::int32_t>(lists.size()),
                                 domain);
    }
    Slots neighbours(std::int32_t node, int mode) const {
        return two_calls<std::int32_t>(
            [&](auto... out) { return conn_query_neighbours(handle, node, mode, out...); });
    }
    Slots neighbours_at(const double* x, double h, const double* tensor, int mode) const {
        return two_calls<std::int32_t>([&](auto... out) {
            return conn_query_neighbours_at(handle, x, h, tensor, mode, out...);
        });
    }
    Slots candidates(std::int32_t node, int mode, int which) const {
        return two_calls<std::int32_t>(
            [&](auto... out) { return conn_query_candidates(handle, node, mode, which, out...); });
    }
    Slots near_box(const double* lo, const double* hi, int mode) const {
        return two_calls<std::int32_t>(
            [&](auto... out) { return conn_query_near_box(handle, lo, hi, mode, out...); });
    }
    Slots near_plane(const double* point, const double* normal, double distance, int mode) const {
        return two_calls<std::int32_t>([&](auto... out) {
            return conn_query_near_plane(handle, point, normal, distance, mode, out...);
        });
    }
};

/// Two lists of one kind of support, the extent of one the larger; all nodes internal, so that
/// brute force has a row for each.
std::vector<NodeSet> two_sets(int dim, std::uint64_t seed, bool is_tensor) {
    std::vector<NodeSet> sets{random_nodes(dim, 60, seed, is_tensor),
                              random_nodes(dim, 30, seed + 1000, is_tensor)};
    sets[1].extent = 2.25;
    return sets;
}

bool holds(const Slots& all, const Slots& part) { return std::ranges::includes(all, part); }

TEST(CapiQuery, neighbours_and_candidates_are_those_of_brute_force) {
    const Context context;
    for (int dim = 1; dim <= 3; ++dim)
        for (const bool is_tensor : {false, true}) {
            const auto sets = two_sets(dim, static_cast<std::uint64_t>(dim), is_tensor);
            const Asked query(context, dim, sets);
            for (const int mode : modes) {
                const auto rows = brute_force(dim, sets, mode).rows;
                for (std::int32_t i = 0; i < 90; i += 4) {
                    const Slots& want = rows[static_cast<std::size_t>(i)];
                    ASSERT_EQ(query.neighbours(i, mode), want) << dim << " " << mode << " " << i;
                    const Slots master = query.candidates(i, mode, CONN_CANDIDATES_MASTER),
                                coarse = query.candidates(i, mode, CONN_CANDIDATES_COARSE),
                                refine = query.candidates(i, mode, CONN_CANDIDATES_REFINE);
                    ASSERT_TRUE(holds(refine, want) && holds(refine, {i}) && holds(coarse, refine));
                    ASSERT_TRUE(holds(master, {i}) && master.size() < 90);
                    for (const std::int32_t m : master)
                        ASSERT_TRUE(holds(coarse, rows[static_cast<std::size_t>(m)]));
                }
            }
        }
}

TEST(CapiQuery, a_place_has_the_neighbours_that_a_node_there_would_have) {
    const Context context;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const int dim = static_cast<int>(seed % 3) + 1;
        const bool is_tensor = seed % 2 != 0;
        auto sets = two_sets(dim, seed, is_tensor);
        const Asked query(context, dim, sets);
        NodeSet place = random_nodes(dim, 1, seed + 2000, is_tensor);
        for (double& h : place.h) h *= 0.3;
        for (double& H : place.H) H *= 3;
        sets.push_back(place);
        sets.back().extent = 2.25;
        for (const int mode : modes)
            ASSERT_EQ(query.neighbours_at(place.x.data(), is_tensor ? nan : place.h[0],
                                          is_tensor ? place.H.data() : nullptr, mode),
                      brute_force(dim, sets, mode).rows.back())
                << seed << " " << mode;
    }
}

/// Nodes in the unit square, periodic in x alone; extent 1, so that a support reaches h.
class CapiQueryPeriodic : public ::testing::Test {
protected:
    CapiQueryPeriodic() {
        domain.periodic[0] = 1;
        domain.box_hi[0] = 1;
        domain.mode = -7;  // nothing but periodic and the box is read
        EXPECT_TRUE(ok(query.update(&domain)));
    }
    static NodeSet small_nodes() {
        NodeSet made = random_nodes(2, 80, 7);
        for (std::size_t a = 0; a < 80; ++a) made.h[a] = a % 9 == 0 ? 0 : 0.2 * made.h[a];
        made.extent = 1;
        made.x[8] += 3;  // positions outside of the box are legal
        return made;
    }
    /// Smallest f(shifted x) over images of node a.
    template <class F>
    double nearest(std::size_t a, const F& f) const {
        double least = HUGE_VAL;
        for (int image = -4; image <= 4; ++image) least = std::min(least, f(set.x[2 * a] + image));
        return least;
    }
    template <class Is>
    Slots all_that(const Is& is) const {
        Slots slots;
        for (std::size_t a = 0; a < set.h.size(); ++a)
            if (is(a)) slots.push_back(static_cast<std::int32_t>(a));
        return slots;
    }

    NodeSet set = small_nodes();
    conn_map_options domain = CONN_MAP_OPTIONS_INIT;
    Context context;
    Asked query{context, 2, {set}};
};

TEST_F(CapiQueryPeriodic, neighbours_are_those_of_the_nearest_images) {
    for (double& h : set.h) h *= 8;
    ASSERT_TRUE(ok(query.nodes[0]->set(2, set)));
    ASSERT_TRUE(ok(query.update(&domain)));
    std::size_t n_found = 0;
    for (std::size_t i = 0; i < set.h.size(); ++i) {
        const Slots seen = all_that([&](std::size_t j) {
            const double dy = set.x[2 * i + 1] - set.x[2 * j + 1];
            return i != j && set.h[i] > 0 && nearest(j, [&](double x) {
                                                 return std::hypot(set.x[2 * i] - x, dy);
                                             }) <= set.h[i];
        });
        EXPECT_EQ(query.neighbours(static_cast<std::int32_t>(i), CONN_GATHER), seen) << i;
        n_found += seen.size();
    }
    EXPECT_GT(n_found, 80u);
}

TEST_F(CapiQueryPeriodic, boxes_hold_what_lies_or_reaches_inside) {
    Random random(3);
    for (int k = 0; k < 40; ++k) {
        const double lo[] = {random.uniform(-0.1, 1), random.uniform(-0.1, 1)},
                     hi[] = {lo[0] + random.uniform(0, 0.4), lo[1] + random.uniform(0, 0.4)};
        const auto gap = [&](std::size_t a) {
            const double y = set.x[2 * a + 1];
            return std::max({0.0, lo[1] - y, y - hi[1], nearest(a, [&](double x) {
                                 return std::max({0.0, lo[0] - x, x - hi[0]});
                             })});
        };
        const auto is_in = [&](std::size_t a) { return gap(a) <= 0; };
        const auto reaches = [&](std::size_t a) { return set.h[a] > 0 && gap(a) <= set.h[a]; };
        EXPECT_EQ(query.near_box(lo, hi, CONN_GATHER), all_that(is_in)) << k;
        EXPECT_EQ(query.near_box(lo, hi, CONN_SCATTER), all_that(reaches)) << k;
        EXPECT_EQ(query.near_box(lo, hi, CONN_GATHER_SCATTER),
                  all_that([&](std::size_t a) { return is_in(a) || reaches(a); }))
            << k;
    }
}

TEST_F(CapiQueryPeriodic, planes_have_the_nodes_that_are_or_reach_near) {
    const double point[] = {0.4, 0.6}, normal[] = {3, 4};
    const auto distance = [&](std::size_t a) {
        return std::abs(0.6 * (set.x[2 * a] - point[0]) + 0.8 * (set.x[2 * a + 1] - point[1]));
    };
    const auto is_near = [&](std::size_t a) { return distance(a) <= 0.05; };
    const auto reaches = [&](std::size_t a) { return set.h[a] > 0 && distance(a) <= set.h[a]; };
    EXPECT_GT(all_that(is_near).size(), 2u);
    EXPECT_EQ(query.near_plane(point, normal, 0.05, CONN_GATHER), all_that(is_near));
    const Slots touching = query.near_plane(point, normal, 0, CONN_SCATTER);
    EXPECT_EQ(touching, all_that(reaches));
}

TEST_F(CapiQueryPeriodic, shifts_lead_to_the_nearest_image) {
    for (std::int32_t i = 0; i < 80; i += 3)
        for (std::int32_t j = 0; j < 80; j += 4) {
            double shift[3] = {nan, nan, nan};
            ASSERT_TRUE(ok(conn_query_periodic_shift(query.handle, i, j, shift)));
            const double at = set.x[static_cast<std::size_t>(2 * j)] + shift[0];
            EXPECT_LE(std::abs(set.x[static_cast<std::size_t>(2 * i)] - at), 0.5 + 1e-12);
            EXPECT_EQ(shift[0], std::rint(shift[0]));
            EXPECT_EQ(shift[1], 0);
            EXPECT_EQ(shift[2], 0);
        }
}

TEST(CapiQuery, bad_questions_are_refused) {
    const Context context;
    const Asked query(context, 2, {random_nodes(2, 20, 1)});
    const conn_query* q = query.handle;
    const double x[] = {0.1, 0.2}, no[] = {nan, 0}, zero[] = {0, 0}, bad[] = {1, 2, 1};
    std::int32_t slots[20];
    std::int64_t count = -1;
    const auto at = [&](const double* place, double h, const double* tensor, std::int64_t* n) {
        return conn_query_neighbours_at(q, place, h, tensor, CONN_GATHER, slots, 20, n);
    };
    EXPECT_TRUE(fails(conn_query_neighbours(q, 20, 3, slots, 20, &count), CONN_E_ARGUMENT,
                      {"slot 20", "[0, 20)"}));
    EXPECT_TRUE(fails(conn_query_neighbours(q, -1, 3, nullptr, 0, &count), CONN_E_ARGUMENT));
    EXPECT_TRUE(
        fails(conn_query_neighbours(q, 0, 0, slots, 20, &count), CONN_E_ARGUMENT, {"mode = 0"}));
    EXPECT_TRUE(fails(conn_query_neighbours(q, 0, 3, slots, 20, nullptr), CONN_E_NULL, {"count"}));
    EXPECT_TRUE(fails(at(nullptr, 1, nullptr, &count), CONN_E_NULL, {"x is NULL"}));
    EXPECT_TRUE(fails(at(x, -1, nullptr, &count), CONN_E_SUPPORT, {"h = -1"}));
    EXPECT_TRUE(fails(at(no, 1, nullptr, &count), CONN_E_NONFINITE, {"coordinate 0"}));
    EXPECT_TRUE(fails(at(x, 0, bad, &count), CONN_E_NOT_SPD));
    EXPECT_TRUE(fails(at(x, 1, nullptr, nullptr), CONN_E_NULL, {"count"}));
    for (const int which : {0, 4})
        EXPECT_TRUE(fails(conn_query_candidates(q, 0, 3, which, slots, 20, &count), CONN_E_ARGUMENT,
                          {"which = " + std::to_string(which)}));
    EXPECT_TRUE(fails(conn_query_candidates(q, 99, 3, 1, slots, 20, &count), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(conn_query_near_box(q, x, zero, 1, slots, 20, &count), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(conn_query_near_box(q, x, nullptr, 1, slots, 20, &count), CONN_E_NULL,
                      {"hi is NULL"}));
    EXPECT_TRUE(fails(conn_query_near_plane(q, x, zero, 1, 1, slots, 20, &count), CONN_E_ARGUMENT,
                      {"normal"}));
    EXPECT_TRUE(fails(conn_query_near_plane(q, x, x, -1, 1, slots, 20, &count), CONN_E_ARGUMENT,
                      {"distance = -1"}));
    EXPECT_TRUE(fails(conn_query_near_plane(q, nullptr, x, 1, 1, slots, 20, &count), CONN_E_NULL,
                      {"point is NULL"}));
    double shift[3];
    EXPECT_TRUE(fails(conn_query_periodic_shift(q, 0, 20, shift), CONN_E_ARGUMENT, {"slot 20"}));
    EXPECT_TRUE(fails(conn_query_periodic_shift(q, 0, 1, nullptr), CONN_E_NULL, {"shift"}));
    EXPECT_EQ(count, -1);
}

TEST(CapiQuery, a_failed_update_leaves_the_nodes_of_the_last) {
    const Context context;
    NodeSet set = random_nodes(2, 20, 1);
    const Asked query(context, 2, {set});
    const auto before = query.neighbours(3, CONN_GATHER_SCATTER);
    conn_map_options domain = CONN_MAP_OPTIONS_INIT;
    domain.periodic[1] = 1;
    EXPECT_TRUE(fails(query.update(&domain), CONN_E_BOX, {"axis 1"}));
    domain.periodic[1] = 2;
    EXPECT_TRUE(fails(query.update(&domain), CONN_E_ARGUMENT, {"domain->periodic[1] = 2"}));
    domain.struct_size = 1;
    EXPECT_TRUE(fails(query.update(&domain), CONN_E_STRUCT_SIZE, {"domain->struct_size"}));
    set.x[5] = nan;
    ASSERT_TRUE(ok(query.nodes[0]->set(2, set)));
    EXPECT_TRUE(fails(query.update(nullptr), CONN_E_NONFINITE, {"node 2"}));
    EXPECT_TRUE(fails(conn_query_update(query.handle, nullptr, 0, nullptr), CONN_E_ARGUMENT));
    EXPECT_EQ(query.neighbours(3, CONN_GATHER_SCATTER), before);
}

/// Every function that asks, on this handle.
std::vector<conn_status> ask_all(const conn_query* query) {
    const double x[] = {0.1, 0.2, 0.3};
    double shift[3];
    std::int64_t count = 0;
    return {conn_query_neighbours(query, 0, 3, nullptr, 0, &count),
            conn_query_neighbours_at(query, x, 1, nullptr, 3, nullptr, 0, &count),
            conn_query_candidates(query, 0, 3, 1, nullptr, 0, &count),
            conn_query_near_box(query, x, x, 3, nullptr, 0, &count),
            conn_query_near_plane(query, x, x, 1, 3, nullptr, 0, &count),
            conn_query_periodic_shift(query, 0, 0, shift)};
}

TEST(CapiQuery, dead_foreign_and_empty_queries_are_errors_in_every_function) {
    const Context context;
    const Nodes nodes(context, 2, random_nodes(2, 5, 1));
    conn_query* query = nullptr;
    EXPECT_TRUE(fails(conn_query_create(context.handle, nullptr), CONN_E_NULL, {"query"}));
    EXPECT_TRUE(fails(conn_query_create(nullptr, &query), CONN_E_NULL, {"context"}));
    ASSERT_TRUE(ok(conn_query_create(context.handle, &query)));
    for (const conn_status status : ask_all(query)) EXPECT_EQ(status, CONN_E_NOT_BUILT);
    for (const conn_status status : ask_all(nullptr)) EXPECT_EQ(status, CONN_E_NULL);
    conn_query* dead = query;
    ASSERT_TRUE(ok(conn_query_destroy(&query)));
    EXPECT_EQ(query, nullptr);
    EXPECT_TRUE(ok(conn_query_destroy(&query)));
    EXPECT_TRUE(ok(conn_query_destroy(nullptr)));
    for (const conn_status status : ask_all(dead)) EXPECT_EQ(status, CONN_E_HANDLE);
    EXPECT_TRUE(fails(conn_query_update(dead, &nodes.handle, 1, nullptr), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_query_destroy(&dead), CONN_E_HANDLE, {"query"}));
    auto* foreign = reinterpret_cast<conn_query*>(nodes.handle);
    EXPECT_TRUE(fails(conn_query_destroy(&foreign), CONN_E_HANDLE, {"a node list"}));
}

class CapiValidate : public ::testing::Test {
protected:
    conn_status validate(std::int32_t* failures, char* text = nullptr, std::int64_t capacity = 0,
                         std::int64_t* length = nullptr) const {
        return conn_map_validate(built.map.handle, built.lists.data(), 1, failures, text, capacity,
                                 length);
    }
    /// The text by the two-call pattern.
    std::string lines() {
        std::int64_t length = -1, again = -1;
        EXPECT_TRUE(ok(validate(&n_failed, nullptr, 0, &length)));
        std::string text(static_cast<std::size_t>(length) + 1, 'x');
        EXPECT_TRUE(fails(validate(&n_failed, text.data(), length, &again), CONN_E_BUFFER,
                          {std::to_string(length + 1)}));
        EXPECT_EQ(again, length);
        EXPECT_TRUE(ok(validate(&n_failed, text.data(), length + 1, &again)));
        EXPECT_EQ(text.back(), '\0');
        text.pop_back();
        return text;
    }

    NodeSet set = random_nodes(2, 100, 9);
    Context context;
    Built built{context, 2, {set}};
    std::int32_t n_failed = -1;
};

TEST_F(CapiValidate, a_map_passes_for_the_nodes_it_was_built_from) {
    const std::string text = lines();
    EXPECT_EQ(n_failed, 0);
    EXPECT_EQ(text.rfind("ok ", 0), 0u);
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(text.find("FAILED"), std::string::npos);
    EXPECT_NE(text.find("ok rows_are_symmetric\n"), std::string::npos) << text;
    EXPECT_GT(std::ranges::count(text, '\n'), 4);
}

TEST_F(CapiValidate, a_map_fails_for_nodes_that_moved_and_says_where) {
    set.x[2 * 41] += 5;
    ASSERT_TRUE(ok(built.nodes[0]->set(2, set)));
    const std::string text = lines();
    EXPECT_GT(n_failed, 0);
    std::int32_t n_lines = 0;
    for (std::size_t at = 0; (at = text.find("FAILED ", at)) != std::string::npos; ++at) {
        ++n_lines;
        const std::size_t colon = text.find(": ", at), end = text.find('\n', at);
        EXPECT_TRUE(colon + 2 < end) << text;
    }
    EXPECT_EQ(n_lines, n_failed);
    EXPECT_NE(text.find("ok rows_are_symmetric\n"), std::string::npos) << text;
    set.x[2 * 41] -= 5;
    ASSERT_TRUE(ok(built.nodes[0]->set(2, set)));
    ASSERT_TRUE(ok(built.rebuild()));
    EXPECT_TRUE(ok(validate(&n_failed)));
    EXPECT_EQ(n_failed, 0);
}

TEST_F(CapiValidate, bad_arguments_are_refused) {
    const Map empty(context);
    const Nodes other(context, 2, random_nodes(2, 99, 1));
    conn_map* map = built.map.handle;
    const auto with = [&](const conn_map* of, conn_nodes* const* lists, int n) {
        return conn_map_validate(of, lists, n, &n_failed, nullptr, 0, nullptr);
    };
    EXPECT_TRUE(fails(validate(nullptr), CONN_E_NULL, {"n_failed"}));
    EXPECT_TRUE(fails(with(nullptr, built.lists.data(), 1), CONN_E_NULL, {"map"}));
    EXPECT_TRUE(fails(with(empty.handle, built.lists.data(), 1), CONN_E_NOT_BUILT));
    EXPECT_TRUE(fails(with(map, &other.handle, 1), CONN_E_ARGUMENT));
    EXPECT_TRUE(fails(with(map, nullptr, 1), CONN_E_NULL, {"lists"}));
    EXPECT_TRUE(fails(with(map, built.lists.data(), 0), CONN_E_ARGUMENT, {"n_lists = 0"}));
    EXPECT_EQ(n_failed, -1);
    set.x[7] = nan;
    ASSERT_TRUE(ok(built.nodes[0]->set(2, set)));
    EXPECT_TRUE(fails(validate(&n_failed), CONN_E_NONFINITE, {"node 3"}));
}

}  // namespace
}  // namespace connectivity::test
