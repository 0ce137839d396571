// SPDX-License-Identifier: BSD-3-Clause
// Boundaries through the interface: one small scene, periodic in x and with walls in y, against
// brute force over all images.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <connectivity_boundary.h>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr std::array<double, 2> lo{-1, 0}, hi{1, 1.5};

struct Image {
    double x, y;
    bool mirrored;
};

/// Node positions shifted across x and mirrored at the walls, the node itself first.
std::vector<Image> images_of(double x, double y) {
    std::vector<Image> images;
    for (const double shift : {0.0, -(hi[0] - lo[0]), hi[0] - lo[0]})
        for (const auto& [at, mirrored] :
             {std::pair{y, false}, std::pair{2 * lo[1] - y, true}, std::pair{2 * hi[1] - y, true}})
            images.push_back({x + shift, at, mirrored});
    return images;
}

class CapiBoundary : public ::testing::Test {
protected:
    CapiBoundary() {
        for (std::size_t k = 0; k < set.x.size(); ++k) {
            const std::size_t d = k % 2;
            set.x[k] = lo[d] + (hi[d] - lo[d]) * set.x[k];
        }
        EXPECT_TRUE(ok(nodes.set(2, set)));
        EXPECT_TRUE(ok(conn_boundaries_create(context.handle, 2, &boundaries)));
        const double sides[] = {lo[0], 0, 3, 0, hi[0], 0.7, -1, 0}, floor[] = {0, lo[1], 0, 1},
                     ceiling[] = {5, hi[1], 0, -2};
        EXPECT_TRUE(ok(add(CONN_BOUNDARY_PERIODIC, sides)));
        EXPECT_TRUE(ok(add(CONN_BOUNDARY_REFLECTING, floor)));
        EXPECT_TRUE(ok(add(CONN_BOUNDARY_REFLECTING, ceiling)));
    }
    ~CapiBoundary() override { conn_boundaries_destroy(&boundaries); }
    CapiBoundary(const CapiBoundary&) = delete;
    CapiBoundary& operator=(const CapiBoundary&) = delete;

    conn_status add(int kind, const double* planes, const char* name = "side") {
        return conn_boundaries_add(boundaries, kind, name, planes, 1);
    }
    conn_status update(int how, conn_map* of) {
        return conn_boundaries_update(boundaries, of, &nodes.handle, 1, how);
    }
    conn_boundary_nodes view() const {
        conn_boundary_nodes out = CONN_BOUNDARY_NODES_INIT;
        EXPECT_TRUE(ok(conn_boundaries_get_nodes(boundaries, 0, &out)));
        return out;
    }

    bool significant(std::size_t i, std::size_t j, const Image& of_j) const {
        const double dx = set.x[2 * i] - of_j.x, dy = set.x[2 * i + 1] - of_j.y;
        const double reach = set.extent * std::max(set.h[i], set.h[j]);
        return dx * dx + dy * dy <= reach * reach;
    }

    /// By node: who it interacts with, once for each image, ascending.
    std::vector<std::vector<std::int32_t>> expected() const {
        std::vector<std::vector<std::int32_t>> rows(set.h.size());
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < rows.size(); ++j) {
                const auto images = images_of(set.x[2 * j], set.x[2 * j + 1]);
                for (std::size_t m = i == j ? 1 : 0; m < images.size(); ++m)
                    if (significant(i, j, images[m]))
                        rows[i].push_back(static_cast<std::int32_t>(j));
            }
        return rows;
    }

    /// The same from the map, ghosts named by their owners.
    std::vector<std::vector<std::int32_t>> found() const {
        const conn_boundary_nodes all = view();
        auto rows = read_lists(map.handle).rows;
        for (auto& row : rows) {
            for (std::int32_t& slot : row)
                if (slot >= all.n_internal) slot = all.owner[slot - all.n_internal];
            std::ranges::sort(row);
        }
        return rows;
    }

    /// Every ghost stands where one of its owner's images does, within rounding.
    void expect_ghosts_at_images() const {
        const conn_boundary_nodes all = view();
        for (std::int64_t g = all.n_internal; g < all.n; ++g) {
            const auto owner = static_cast<std::size_t>(all.owner[g - all.n_internal]);
            const auto images = images_of(set.x[2 * owner], set.x[2 * owner + 1]);
            EXPECT_TRUE(std::ranges::any_of(images, [&](const Image& image) {
                return std::abs(image.x - all.x[2 * g]) < 1e-14 &&
                       std::abs(image.y - all.x[2 * g + 1]) < 1e-14;
            })) << g;
            EXPECT_EQ(all.h[g], set.h[owner]);
        }
    }

    NodeSet set = random_nodes(2, 80, 5);
    Context context;
    Nodes nodes{context, 2};
    Map map{context};
    conn_boundaries* boundaries = nullptr;
};

TEST_F(CapiBoundary, rows_with_ghosts_name_all_images_that_brute_force_finds) {
    std::vector<std::int64_t> n_ghosts;
    for (const int how : {CONN_GHOSTS_KEEP, CONN_GHOSTS_CULL, CONN_GHOSTS_CULL_MOST}) {
        ASSERT_TRUE(ok(update(how, map.handle)));
        EXPECT_EQ(found(), expected()) << how;
        expect_ghosts_at_images();
        n_ghosts.push_back(view().n - view().n_internal);
        EXPECT_EQ(view().n_internal, 80);
    }
    EXPECT_GT(n_ghosts[2], 0);
    EXPECT_LE(n_ghosts[1], n_ghosts[0]);
    EXPECT_LT(n_ghosts[2], n_ghosts[0]);
}

TEST_F(CapiBoundary, a_refresh_moves_the_ghosts_and_leaves_the_lists) {
    ASSERT_TRUE(ok(update(CONN_GHOSTS_CULL, map.handle)));
    const std::uint64_t generation = map.generation();
    const auto rows = read_lists(map.handle).rows;
    for (double& x : set.x) x = 0.999 * x + 1e-4;
    ASSERT_TRUE(ok(nodes.set(2, set)));
    ASSERT_TRUE(ok(update(CONN_GHOSTS_REFRESH, nullptr)));
    expect_ghosts_at_images();
    EXPECT_EQ(map.generation(), generation);
    EXPECT_EQ(read_lists(map.handle).rows, rows);
    EXPECT_TRUE(fails(update(CONN_GHOSTS_REFRESH, map.handle), CONN_E_ARGUMENT, {"map", "NULL"}));
    ASSERT_TRUE(ok(nodes.set(2, random_nodes(2, 81, 1))));
    EXPECT_TRUE(fails(update(CONN_GHOSTS_REFRESH, nullptr), CONN_E_ARGUMENT, {"last update"}));
}

TEST_F(CapiBoundary, ghosts_of_fields_are_those_of_their_owners_turned_by_mirrors) {
    ASSERT_TRUE(ok(update(CONN_GHOSTS_KEEP, map.handle)));
    const conn_boundary_nodes all = view();
    const auto n = static_cast<std::size_t>(all.n);
    std::vector<double> mass(n, -1), velocity(2 * n, -1), stress(3 * n, -1);
    for (std::size_t a = 0; a < 80; ++a) {
        mass[a] = 1.0 + static_cast<double>(a);
        for (const std::size_t c : {0, 1})
            velocity[2 * a + c] = std::sin((3.0 + double(c)) * mass[a]);
        for (const std::size_t c : {0, 1, 2})
            stress[3 * a + c] = std::cos((2.0 + double(c)) * mass[a]);
    }
    const auto fill = [&](int kind, std::vector<double>& values, int components) {
        return conn_boundaries_fill_ghosts(boundaries, 0, kind, values.data(), all.n, components);
    };
    ASSERT_TRUE(ok(fill(CONN_FIELD_SCALAR, mass, 1)));
    ASSERT_TRUE(ok(fill(CONN_FIELD_VECTOR, velocity, 2)));
    ASSERT_TRUE(ok(fill(CONN_FIELD_TENSOR, stress, 3)));
    for (std::size_t g = 80; g < n; ++g) {
        const auto owner = static_cast<std::size_t>(all.owner[g - 80]);
        const bool mirrored = all.x[2 * g + 1] < lo[1] || all.x[2 * g + 1] > hi[1];
        const double sign = mirrored ? -1 : 1;
        EXPECT_EQ(mass[g], mass[owner]);
        EXPECT_NEAR(velocity[2 * g], velocity[2 * owner], 1e-15);
        EXPECT_NEAR(velocity[2 * g + 1], sign * velocity[2 * owner + 1], 1e-15);
        EXPECT_NEAR(stress[3 * g], stress[3 * owner], 1e-15);
        EXPECT_NEAR(stress[3 * g + 1], sign * stress[3 * owner + 1], 1e-15);
        EXPECT_NEAR(stress[3 * g + 2], stress[3 * owner + 2], 1e-15);
    }
}

TEST_F(CapiBoundary, ghosts_inherit_global_ids) {
    std::vector<std::int64_t> ids(80);
    for (std::size_t a = 0; a < 80; ++a) ids[a] = 7000 - static_cast<std::int64_t>(a);
    EXPECT_TRUE(ok(update(CONN_GHOSTS_KEEP, map.handle)));
    EXPECT_EQ(view().global_id, nullptr);
    ASSERT_TRUE(ok(set_ids(nodes.handle, ids)));
    ASSERT_TRUE(ok(update(CONN_GHOSTS_KEEP, map.handle)));
    const conn_boundary_nodes all = view();
    ASSERT_NE(all.global_id, nullptr);
    for (std::int64_t g = all.n_internal; g < all.n; ++g)
        EXPECT_EQ(all.global_id[g], 7000 - all.owner[g - all.n_internal]);
}

TEST_F(CapiBoundary, bad_boundaries_are_refused) {
    const double none[] = {0, 0, 0, 0}, same[] = {0, 0.2, 0, 1},
                 bad[] = {0, std::numeric_limits<double>::quiet_NaN(), 0, 1},
                 apart[] = {0, 0, 1, 0, 1, 0, 1, 0};
    EXPECT_TRUE(fails(add(0, same), CONN_E_ARGUMENT, {"kind = 0"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_REFLECTING, nullptr), CONN_E_NULL, {"planes"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_REFLECTING, same, nullptr), CONN_E_NULL, {"name"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_REFLECTING, none), CONN_E_ARGUMENT, {"normal"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_REFLECTING, bad), CONN_E_ARGUMENT, {"point[1]", "nan"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_REFLECTING, same, "again"), CONN_E_ARGUMENT,
                      {"again", "parallel"}));
    EXPECT_TRUE(fails(add(CONN_BOUNDARY_PERIODIC, apart), CONN_E_ARGUMENT, {"face each other"}));
    EXPECT_TRUE(fails(conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, "x", same, 2),
                      CONN_E_ARGUMENT, {"may_cull = 2"}));
    conn_boundaries* made = nullptr;
    EXPECT_TRUE(fails(conn_boundaries_create(context.handle, 4, &made), CONN_E_ARGUMENT, {"dim"}));
    EXPECT_TRUE(fails(conn_boundaries_create(context.handle, 2, nullptr), CONN_E_NULL));
    EXPECT_EQ(made, nullptr);
    ASSERT_TRUE(ok(update(CONN_GHOSTS_KEEP, map.handle)));
    EXPECT_EQ(found(), expected()) << "a refused boundary was added";
}

TEST_F(CapiBoundary, bad_updates_are_refused_and_ghosts_and_map_stay) {
    ASSERT_TRUE(ok(update(CONN_GHOSTS_CULL, map.handle)));
    const auto before = found();
    const Nodes flat(context, 1, random_nodes(1, 5, 1));
    NodeSet outside = set;
    outside.x[33] = hi[1] + 0.1;
    const Nodes wrong(context, 2, outside);
    const auto with = [&](conn_nodes* list) {
        return conn_boundaries_update(boundaries, map.handle, &list, 1, CONN_GHOSTS_CULL);
    };
    EXPECT_TRUE(fails(with(flat.handle), CONN_E_ARGUMENT, {"dim = 1"}));
    EXPECT_TRUE(fails(with(wrong.handle), CONN_E_ARGUMENT, {"16"}));
    EXPECT_TRUE(fails(update(4, map.handle), CONN_E_ARGUMENT, {"how = 4"}));
    EXPECT_TRUE(fails(update(CONN_GHOSTS_CULL, nullptr), CONN_E_NULL, {"map"}));
    const std::vector<std::uint8_t> active(80, 1);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.active = active.data();
    options.n_active = 80;
    ASSERT_TRUE(ok(conn_map_set_options(map.handle, &options)));
    EXPECT_TRUE(fails(update(CONN_GHOSTS_CULL, map.handle), CONN_E_ARGUMENT, {"active"}));
    conn_boundary_nodes out = CONN_BOUNDARY_NODES_INIT;
    EXPECT_TRUE(
        fails(conn_boundaries_get_nodes(boundaries, 1, &out), CONN_E_ARGUMENT, {"list = 1"}));
    double values[4] = {};
    const auto fill = [&](int list, int kind, double* to, std::int64_t n, int components) {
        return conn_boundaries_fill_ghosts(boundaries, list, kind, to, n, components);
    };
    const std::int64_t n = view().n;
    EXPECT_TRUE(fails(fill(-1, 0, values, n, 1), CONN_E_ARGUMENT, {"list = -1"}));
    EXPECT_TRUE(fails(fill(0, 3, values, n, 1), CONN_E_ARGUMENT, {"kind = 3"}));
    EXPECT_TRUE(fails(fill(0, 0, values, 4, 1), CONN_E_ARGUMENT, {"n = 4", std::to_string(n)}));
    EXPECT_TRUE(fails(fill(0, 0, values, n, 0), CONN_E_ARGUMENT, {"n_components = 0"}));
    EXPECT_TRUE(fails(fill(0, CONN_FIELD_TENSOR, values, n, 2), CONN_E_ARGUMENT, {"3"}));
    EXPECT_TRUE(fails(fill(0, 0, nullptr, n, 1), CONN_E_NULL, {"values"}));
    EXPECT_EQ(found(), before);
}

}  // namespace
}  // namespace connectivity::test
