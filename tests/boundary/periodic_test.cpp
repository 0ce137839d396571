// SPDX-License-Identifier: BSD-3-Clause
// Periodic boundaries by ghosts against the periodic domain of the map: the same neighbours.

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>

namespace connectivity::test {
namespace {

/// Internal slot -> internal slots of whom its neighbours are images, ascending.
using Owners = std::map<Slot, std::vector<Slot>>;

Owners owners_of_neighbours(const ConnectivityMap& map, const std::vector<NodeList>& lists) {
    std::vector<Slot> internal;  // by slot with ghosts: slot of its owner without
    Slot first = 0;
    for (const NodeList& list : lists) {
        for (Offset i = 0; i < list.n(); ++i)
            internal.push_back(first + (list.is_ghost(i) ? list.owners()(i - list.n_internal())
                                                         : static_cast<Slot>(i)));
        first += static_cast<Slot>(list.n_internal());
    }
    Owners owners;
    const RowsView<> rows = map.rows();
    for (Offset r = 0; r < rows.n_rows(); ++r) {
        std::vector<Slot>& row =
            owners[internal[static_cast<std::size_t>(map.layout().slot_of_row(r))]];
        for (const Slot j : rows[r]) row.push_back(internal[static_cast<std::size_t>(j)]);
        std::sort(row.begin(), row.end());
    }
    return owners;
}

/// Whether rounding of the ghost's position may decide about the two nodes: the rim of a support
/// passes within `slack` (relative to the support) of the other node.
bool at_the_rim(const Case& c, Slot i, Slot j, double ulps) {
    const auto node_of = [&](Slot slot) {
        std::size_t list = 0;
        while (slot >= c.n(list)) slot -= static_cast<Slot>(c.n(list++));
        return std::pair<std::size_t, Offset>(list, slot);
    };
    const auto [li, a] = node_of(i);
    const auto [lj, b] = node_of(j);
    std::array<double, 3> r{0, 0, 0};
    double scale = 0;
    for (int d = 0; d < c.dim; ++d) {
        const double x = c.lists[li].x[static_cast<std::size_t>(a * c.dim + d)],
                     y = c.lists[lj].x[static_cast<std::size_t>(b * c.dim + d)];
        const auto axis = static_cast<std::size_t>(d);
        const double L = c.domain.length(d);
        r[axis] = L > 0 ? (x - y) - L * std::rint((x - y) / L) : x - y;
        scale = std::max({scale, std::abs(x), std::abs(y), L});
    }
    double length = 0;
    for (const double component : r) length += component * component;
    // ulps of eta for positions of the size of the distance, more where they are larger
    const long double slack = ulps * 0x1p-52 * std::max(1.0, scale / std::sqrt(length));
    return std::abs(eta_over_K(c, li, a, r) - 1) <= slack ||
           std::abs(eta_over_K(c, lj, b, r) - 1) <= slack;
}

struct Compared {
    Offset entries = 0, at_rim = 0, different = 0;
};

/// Entries that only one of two sorted rows has.
std::vector<Slot> difference(const std::vector<Slot>& a, const std::vector<Slot>& b) {
    std::vector<Slot> only;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
    return only;
}

/// c: all nodes internal and inside the domain.
Compared compare(const Case& c, const Boundaries& boundaries, const ConnectivityMap& map,
                 double ulps) {
    ConnectivityMap native;
    native.rebuild(node_lists(c), map_options(c));
    const Owners want = owners_of_neighbours(native, node_lists(c));
    const Owners got = owners_of_neighbours(map, boundaries.lists());
    Compared result;
    EXPECT_EQ(want.size(), got.size());
    for (const auto& [i, row] : want) {
        result.entries += static_cast<Offset>(row.size());
        for (const Slot j : difference(row, got.at(i)))
            ++(at_the_rim(c, i, j, ulps) ? result.at_rim : result.different);
    }
    return result;
}

Box domain_box(const Case& c) {
    Box box;
    box.dim = c.dim;
    for (std::size_t d = 0; d < static_cast<std::size_t>(c.dim); ++d)
        box.lo[d] = c.domain.lo[d], box.hi[d] = c.domain.hi[d];
    return box;
}

TEST(Periodic, ghosts_give_the_neighbours_of_the_periodic_domain) {
    Compared sum;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed + 1000);
        Box box;
        box.dim = 1 + static_cast<int>(seed % 3);
        for (double& hi : box.hi) hi = random.uniform(0.5, 2);
        double shortest = 2;
        for (int d = 0; d < box.dim; ++d)
            shortest = std::min(shortest, box.hi[static_cast<std::size_t>(d)]);
        Case c = cloud_in_box(box, 1 + random.below(40), 0.499 * shortest, random);
        Boundaries boundaries(c.dim);
        for (int d = 0; d < c.dim; ++d) {
            const auto axis = static_cast<std::size_t>(d);
            if (d > 0 && random.chance(0.2)) continue;
            c.domain.periodic[axis] = true;
            c.domain.lo[axis] = box.lo[axis], c.domain.hi[axis] = box.hi[axis];
            add_periodic(boundaries, box, d);
        }
        ConnectivityMap map;
        MapOptions options;
        options.pairs = false;
        boundaries.update(map, node_lists(c), options);
        const Compared one = compare(c, boundaries, map, 4);
        EXPECT_EQ(one.different, 0) << "seed " << seed;
        sum.entries += one.entries, sum.at_rim += one.at_rim;
    }
    EXPECT_GT(sum.entries, 100000);
    RecordProperty("entries", std::to_string(sum.entries));
    RecordProperty("at_rim", std::to_string(sum.at_rim));
}

/// Positions outside, far images, offsets, nodes at the rim, units of any size.
TEST(Periodic, the_same_for_every_kind_of_cloud) {
    Offset entries = 0, at_rim = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Case c = random_case(seed, {1 + static_cast<int>(seed % 3), true, 120});
        c.ghost_rows = false, c.mode = SearchMode::gather_scatter;
        Boundaries boundaries(c.dim);
        for (int d = 0; d < c.dim; ++d)
            if (c.domain.periodic[static_cast<std::size_t>(d)])
                add_periodic(boundaries, domain_box(c), d);
        for (ListData& list : c.lists) {
            list.n_internal = static_cast<Offset>(list.x.size()) / c.dim;
            node_lists(c);  // starts the runtime
            const auto x = allocate<double>("x", static_cast<Offset>(list.x.size()));
            std::copy(list.x.begin(), list.x.end(), x.data());
            boundaries.move_inside(x);
            std::copy_n(x.data(), x.size(), list.x.begin());
        }
        ConnectivityMap map;
        boundaries.update(map, node_lists(c), MapOptions{});
        const Compared one = compare(c, boundaries, map, 8);
        EXPECT_EQ(one.different, 0) << c.text;
        entries += one.entries, at_rim += one.at_rim;
    }
    EXPECT_GT(entries, 50000);
    RecordProperty("entries", std::to_string(entries));
    RecordProperty("at_rim", std::to_string(at_rim));
}

TEST(Periodic, keys_ids_and_shifts_of_ghosts_are_those_of_their_owners) {
    Random random(5);
    Box box;
    Case c = cloud_in_box(box, 60, 0.4, random);
    Boundaries boundaries(3);
    for (int d = 0; d < 3; ++d) add_periodic(boundaries, box, d);
    std::vector<NodeList> lists = node_lists(c);
    std::vector<std::vector<std::int64_t>> ids(lists.size());
    for (std::size_t k = 0; k < lists.size(); ++k) {
        for (Offset i = 0; i < 60; ++i) ids[k].push_back(1000 * static_cast<Offset>(k) + 7 * i);
        lists[k].set_global_ids(ConstView<std::int64_t>(ids[k].data(), ids[k].size()));
    }
    boundaries.make(lists, MapOptions{});
    for (std::size_t k = 0; k < lists.size(); ++k) {
        const NodeList& made = boundaries.lists()[k];
        ASSERT_GT(made.n_ghosts(), 0);
        for (Offset g = 60; g < made.n(); ++g) {
            const Slot owner = made.owners()(g - 60);
            EXPECT_EQ(made.global_ids()(g), ids[k][static_cast<std::size_t>(owner)]);
            const RigidMap image = boundaries.image(static_cast<int>(k), g);
            EXPECT_TRUE(image.is_shift());
            for (Offset d = 0; d < 3; ++d)
                EXPECT_NEAR(made.positions()(3 * g + d),
                            made.positions()(3 * owner + d) + image.t[static_cast<std::size_t>(d)],
                            1e-15);
        }
    }
}

}  // namespace
}  // namespace connectivity::test
