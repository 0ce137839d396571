// SPDX-License-Identifier: BSD-3-Clause
// A18, the cost of overlap and intersections: nothing unless asked for, known to the byte before
// memory is taken.

#include <algorithm>
#include <array>
#include <set>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>

namespace connectivity::test {
namespace {

using Step = std::array<int, 3>;

constexpr int side = 16;
constexpr Offset n_nodes = Offset{side} * side * side;

/// Steps from a node to all that its support holds, itself included: |step|^2 <= 8.
std::vector<Step> ball() {
    std::vector<Step> steps;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (x * x + y * y + z * z <= 8) steps.push_back({x, y, z});
    return steps;
}

Step difference(const Step& a, const Step& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// A periodic lattice of nodes that all have the same 92 neighbours; 4 supports fit into it.
Case lattice() {
    std::vector<double> x;
    for (int k = 0; k < n_nodes; ++k)
        for (const int at : {k % side, k / side % side, k / (side * side)}) x.push_back(at);
    Case c = uniform_case(3, std::move(x), 1.45);  // radius 2.9
    c.domain = {{true, true, true}, {0, 0, 0}, {side, side, side}};
    return c;
}

/// Entries a node, by counting steps.
struct Counts {
    Offset neighbours = 0, overlap = 0, common = 0;  ///< common: over the neighbours of a node
};

Counts counted() {
    const std::vector<Step> steps = ball();
    const std::set<Step> inside(steps.begin(), steps.end());
    std::set<Step> reached;
    Counts n;
    for (const Step& a : steps)
        for (const Step& b : steps) {
            reached.insert(difference(a, b));
            n.common += a != Step{} && inside.contains(difference(b, a));
        }
    n.neighbours = static_cast<Offset>(steps.size()) - 1;
    n.overlap = static_cast<Offset>(reached.size()) - 1;
    return n;
}

/// Bytes of lists of n_rows rows: what a budget has to hold.
Offset list_bytes(Offset n_entries, Offset n_rows) { return 4 * n_entries + 8 * (n_rows + 1); }

struct Needed {
    Offset rows_and_pairs, overlap, intersection;
    Offset sum(const MapOptions& options) const {
        return rows_and_pairs + (options.overlap ? overlap : 0) +
               (options.intersection != IntersectionKind::none ? intersection : 0);
    }
};

Needed needed() {
    const Counts n = counted();
    const Offset n_pairs = n_nodes * n.neighbours / 2;
    return {list_bytes(n_nodes * n.neighbours, n_nodes) + list_bytes(n_pairs, n_nodes),
            list_bytes(n_nodes * n.overlap, n_nodes), list_bytes(n_nodes * n.common / 2, n_pairs)};
}

MapOptions options_of(const Case& c, bool overlap, bool intersection) {
    MapOptions options = map_options(c);
    options.overlap = overlap;
    options.intersection = intersection ? IntersectionKind::all : IntersectionKind::none;
    return options;
}

constexpr std::array<bool, 2> flag_sets[] = {{true, false}, {false, true}, {true, true}};

const ReportEntry& entry(const ConnectivityMap& map, const char* product) {
    const ReportEntry* const found = map.report().find(product);
    EXPECT_NE(found, nullptr) << product;
    return *found;
}

/// (2 H)^3 / H^3 = 8 is the limit of many neighbours. With 92 it is less, because witnesses are
/// nodes: not all of the 798 inside twice the support share one.
TEST(DerivedCost, overlap_has_about_eight_times_the_neighbours) {
    const Case c = lattice();
    const Counts n = counted();
    EXPECT_EQ(n.neighbours, 92);
    EXPECT_GT(n.overlap, 6 * n.neighbours);
    EXPECT_LT(n.overlap, 8 * n.neighbours);
    ConnectivityMap map;
    map.rebuild(node_lists(c), options_of(c, true, true));
    EXPECT_EQ(map.rows().size(), n_nodes * n.neighbours);
    EXPECT_EQ(map.overlap().size(), n_nodes * n.overlap);
    EXPECT_EQ(map.intersection().size(), n_nodes * n.common / 2);
    for (Offset r = 0; r < n_nodes; ++r) ASSERT_EQ(map.overlap()[r].size(), n.overlap);
}

TEST(DerivedCost, nothing_is_held_unless_asked_for) {
    const Case c = lattice();
    ConnectivityMap map;
    for (const auto& [before_overlap, before_intersection] : flag_sets) {
        map.rebuild(node_lists(c), options_of(c, before_overlap, before_intersection));
        EXPECT_EQ(entry(map, "overlap").bytes > 0, before_overlap);
        EXPECT_EQ(entry(map, "intersection").bytes > 0, before_intersection);
        for (int k = 0; k < 2; ++k) {
            rebuild(map, c);
            for (const char* product : {"overlap", "intersection", "key_order", "derived"}) {
                const ReportEntry& unasked = entry(map, product);
                EXPECT_EQ(unasked.bytes, 0) << product;
                EXPECT_EQ(unasked.ms, 0) << product;
                EXPECT_FALSE(unasked.built) << product;
                EXPECT_EQ(unasked.asked_by, "") << product;
            }
        }
    }
}

TEST(DerivedCost, a_budget_of_one_byte_less_is_refused_by_the_exact_number_and_nothing_changes) {
    const Case c = lattice();
    const Needed bytes = needed();
    const Expected expected = brute_force(c);
    for (const auto& [overlap, intersection] : flag_sets) {
        ConnectivityMap map;
        rebuild(map, c);
        const Generation generation = map.generation();
        const Slot* const data = map.rows().data();
        const Stamp stamp = map.pairs().stamp();
        const std::string report = map.report().text();
        MapOptions options = options_of(c, overlap, intersection);
        const Offset sum = bytes.sum(options);
        options.budget.bytes = sum - 1;
        const auto part = [](const char* name, Offset n) {
            return std::string(name) + " " + std::to_string(n) + " bytes";
        };
        EXPECT_TRUE(fails_with(Status::budget,
                               {"needs " + std::to_string(sum) + " bytes",
                                part("rows and pairs", bytes.rows_and_pairs),
                                part("overlap", overlap ? bytes.overlap : 0),
                                part("intersections", intersection ? bytes.intersection : 0),
                                "allowed are " + std::to_string(sum - 1) + " bytes"},
                               [&] { map.rebuild(node_lists(c), options); }));
        EXPECT_TRUE(equals(map, expected));
        EXPECT_EQ(map.generation(), generation);
        EXPECT_EQ(map.rows().data(), data);
        EXPECT_EQ(map.pairs().stamp(), stamp);
        EXPECT_EQ(map.report().text(), report);
        EXPECT_TRUE(fails_with(Status::not_built, {}, [&] { map.overlap(); }));
        EXPECT_TRUE(fails_with(Status::not_built, {}, [&] { map.intersection(); }));
        options.budget.bytes = sum;
        map.rebuild(node_lists(c), options);
        EXPECT_TRUE(equals(map, expected));
    }
}

TEST(DerivedCost, what_the_error_names_is_what_the_build_then_holds) {
    const Case c = lattice();
    const Needed bytes = needed();
    for (const auto& [overlap, intersection] : flag_sets) {
        ConnectivityMap map;
        const MapOptions options = options_of(c, overlap, intersection);
        map.rebuild(node_lists(c), options);
        const auto expect_near = [](Offset held, Offset named, const char* what) {
            EXPECT_GE(held, named) << what;
            EXPECT_LE(5 * held, 6 * named) << what;
        };
        Offset held = 0;
        for (const char* product : {"rows", "pairs", "overlap", "intersection"})
            held += entry(map, product).bytes;
        expect_near(held, bytes.sum(options), "all");
        if (overlap) expect_near(entry(map, "overlap").bytes, bytes.overlap, "overlap");
        if (intersection)
            expect_near(entry(map, "intersection").bytes, bytes.intersection, "intersection");
    }
}

}  // namespace
}  // namespace connectivity::test
