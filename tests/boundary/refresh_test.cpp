// SPDX-License-Identifier: BSD-3-Clause
// Between updates: ghosts follow their nodes, fields of the host follow too.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>
#include <support/expect_error.hpp>

namespace connectivity::test {
namespace {

struct Scene {
    Box box;
    Case nodes;
    Boundaries boundaries{3}, others{3};

    explicit Scene(std::uint64_t seed) {
        Random random(seed);
        box.dim = 1 + static_cast<int>(seed % 3);
        if (random.chance(0.5)) box.frame = rotated_frame(box.dim, random);
        for (Boundaries* b : {&boundaries, &others}) {
            *b = Boundaries(box.dim);
            for (int d = 0; d < box.dim; ++d)
                d == 1 ? add_periodic(*b, box, d) : add_walls(*b, box, d);
        }
        nodes = cloud_in_box(box, 30, 0.5, random);
    }

    /// Towards the middle of the box, supports a little smaller.
    Case moved() const {
        const auto middle = to_world(box.frame, {0.5, 0.5, box.dim == 3 ? 0.5 : 0});
        Case c = nodes;
        for (ListData& list : c.lists) {
            for (std::size_t k = 0; k < list.x.size(); ++k) {
                const double to = middle[k % static_cast<std::size_t>(c.dim)];
                list.x[k] += 0.01 * (to - list.x[k]);
            }
            for (double& h : list.h) h *= 0.99;
            for (double& H : list.H) H *= 1.01;
        }
        return c;
    }
};

/// The ghost of `lists` that is the same image of the same node, or -1.
Offset find_image(const Boundaries& b, int list, Slot owner, const RigidMap& image) {
    const NodeList& nodes = b.lists()[static_cast<std::size_t>(list)];
    for (Offset g = nodes.n_internal(); g < nodes.n(); ++g) {
        const RigidMap other = b.image(list, g);
        if (nodes.owners()(g - nodes.n_internal()) == owner && other.Q == image.Q &&
            other.t == image.t)
            return g;
    }
    return -1;
}

TEST(Refresh, moved_ghosts_are_the_ghosts_of_moved_nodes) {
    Offset compared = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Scene scene(seed);
        scene.boundaries.make(node_lists(scene.nodes), MapOptions{});
        const Case later = scene.moved();
        scene.boundaries.refresh(node_lists(later));
        scene.others.make(node_lists(later), MapOptions{});
        const Case got = copy_of(scene.boundaries.lists()), want = copy_of(scene.others.lists());
        for (std::size_t k = 0; k < got.lists.size(); ++k) {
            const NodeList& list = scene.boundaries.lists()[k];
            for (Offset g = 0; g < list.n(); ++g) {
                Offset same = g;
                if (g >= list.n_internal())
                    same = find_image(scene.others, static_cast<int>(k),
                                      list.owners()(g - list.n_internal()),
                                      scene.boundaries.image(static_cast<int>(k), g));
                if (same < 0) continue;  // too far away by now
                ++compared;
                const auto values = [&](const std::vector<double>& all, Offset node, int n) {
                    return std::vector<double>(all.begin() + node * n,
                                               all.begin() + (node + 1) * n);
                };
                const int dim = got.dim, m = list.has_tensor() ? n_symmetric(dim) : 1;
                EXPECT_EQ(values(got.lists[k].x, g, dim), values(want.lists[k].x, same, dim));
                EXPECT_EQ(values(list.has_tensor() ? got.lists[k].H : got.lists[k].h, g, m),
                          values(list.has_tensor() ? want.lists[k].H : want.lists[k].h, same, m));
            }
        }
    }
    EXPECT_GT(compared, 10000);
}

TEST(Refresh, other_nodes_are_refused) {
    Scene scene(2);
    scene.boundaries.make(node_lists(scene.nodes), MapOptions{});
    const Case before = copy_of(scene.boundaries.lists());
    Case fewer = scene.nodes;
    fewer.lists[0].n_internal = 29;
    EXPECT_TRUE(fails_with(Status::argument, {"refresh", "internal nodes"},
                           [&] { scene.boundaries.refresh(node_lists(fewer)); }));
    EXPECT_TRUE(fails_with(Status::argument, {"refresh", "0 node lists"},
                           [&] { scene.boundaries.refresh({}); }));
    EXPECT_EQ(copy_of(scene.boundaries.lists()).lists[0].x, before.lists[0].x);
}

/// A field that is linear in position is so at images too: of a vector v(x) = x - p with p on all
/// planes of the corner the image is v of the image; its outer product is a tensor.
TEST(Fields, vectors_and_tensors_are_mirrored_as_positions_are) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Box box;
        box.dim = 1 + static_cast<int>(seed % 3);
        box.frame = rotated_frame(box.dim, random);
        Boundaries boundaries(box.dim);
        for (int d = 0; d < box.dim; ++d)
            boundaries.add(Boundary::reflecting("wall", box.face(d, false)));
        const Case c = cloud_in_box(box, 30, 0.5, random);
        boundaries.make(node_lists(c), MapOptions{});
        const Case made = copy_of(boundaries.lists());  // the corner is the origin
        const int dim = c.dim, m = n_symmetric(dim);
        const Offset n = made.n(0);
        HostField v{FieldKind::vector, allocate_zeroed<double>("v", n * dim)},
            T{FieldKind::tensor, allocate_zeroed<double>("T", n * m)},
            s{FieldKind::scalar, allocate_zeroed<double>("s", n * 2), 2};
        const auto outer = [&](const double* x, int k) {
            int a = 0, b = k;
            while (b >= dim - a) b -= dim - a, ++a;
            return x[a] * x[a + b];
        };
        const double* const x = made.lists[0].x.data();
        for (Offset i = 0; i < 30; ++i) {
            for (int d = 0; d < dim; ++d) v.values(i * dim + d) = x[i * dim + d];
            for (int k = 0; k < m; ++k) T.values(i * m + k) = outer(x + i * dim, k);
            s.values(2 * i) = static_cast<double>(i), s.values(2 * i + 1) = -7;
        }
        for (const HostField& field : {v, T, s}) boundaries.fill_ghosts(0, field);
        std::vector<int> ids(static_cast<std::size_t>(n), -1);
        for (int i = 0; i < 30; ++i) ids[static_cast<std::size_t>(i)] = i;
        boundaries.copy_to_ghosts(0, ids.data());
        ASSERT_GT(n, 30);
        for (Offset g = 30; g < n; ++g) {
            const Slot owner = boundaries.lists()[0].owners()(g - 30);
            for (int d = 0; d < dim; ++d) EXPECT_NEAR(v.values(g * dim + d), x[g * dim + d], 1e-14);
            for (int k = 0; k < m; ++k)
                EXPECT_NEAR(T.values(g * m + k), outer(x + g * dim, k), 1e-14);
            EXPECT_EQ(s.values(2 * g), owner);
            EXPECT_EQ(s.values(2 * g + 1), -7);
            EXPECT_EQ(ids[static_cast<std::size_t>(g)], owner);
        }
        HostField wrong = v;
        wrong.kind = FieldKind::scalar, wrong.n_components = dim + 1;
        EXPECT_TRUE(fails_with(Status::argument, {"fill_ghosts", "nodes"},
                               [&] { boundaries.fill_ghosts(0, wrong); }));
    }
}

TEST(MoveInside, nodes_return_by_whole_boxes_and_mirrors_and_velocities_turn_round) {
    Box box;
    box.dim = 2;
    Boundaries boundaries(2);
    add_periodic(boundaries, box, 0);
    add_walls(boundaries, box, 1);
    node_lists(Case{2, {}, {}, false, SearchMode::gather_scatter, ""});  // starts the runtime
    const auto x = allocate<double>("x", 8);
    const HostField v{FieldKind::vector, allocate<double>("v", 8)};
    const double from[8] = {0.25, 0.5, 1.25, 0.5, -3.75, -0.25, 1e6 + 0.5, 1.125};
    const double to[8] = {0.25, 0.5, 0.25, 0.5, 0.25, 0.25, 0.5, 0.875};
    std::copy_n(from, 8, x.data());
    for (std::size_t k = 0; k < 8; ++k) v.values(k) = 1;
    EXPECT_EQ(boundaries.move_inside(x, {&v, 1}), 3);
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_EQ(x(k), to[k]) << k;
        EXPECT_EQ(v.values(k), k == 5 || k == 7 ? -1 : 1) << k;
    }
    x(3) = NAN;
    EXPECT_TRUE(fails_with(Status::nonfinite, {"move_inside", "node 1", "position[1]"},
                           [&] { boundaries.move_inside(x); }));
}

}  // namespace
}  // namespace connectivity::test
