// SPDX-License-Identifier: BSD-3-Clause
// Walls and mixed boxes in any orientation against all images, made one by one.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>

namespace connectivity::test {
namespace {

/// One of the 3^dim copies of the box around it: per axis none, lower or upper side.
struct Copy {
    std::array<int, 3> side{0, 0, 0};
    std::array<bool, 3> periodic{false, false, false};

    /// Where it puts a point of the world, and (positions aside) a vector.
    std::array<double, 3> map(const Box& box, std::array<double, 3> x, bool position) const {
        std::array<double, 3> y{0, 0, 0};
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t d = 0; d < 3; ++d) y[a] += box.frame[a][d] * x[d];
        for (std::size_t a = 0; a < 3; ++a) {
            if (side[a] == 0) continue;
            if (periodic[a])
                y[a] += position ? side[a] * (box.hi[a] - box.lo[a]) : 0;
            else
                y[a] = (position ? 2 * (side[a] < 0 ? box.lo[a] : box.hi[a]) : 0) - y[a];
        }
        return to_world(box.frame, y);
    }
};

std::vector<Copy> all_copies(int dim, const std::array<bool, 3>& periodic) {
    std::vector<Copy> copies;
    const int n = dim == 1 ? 3 : dim == 2 ? 9 : 27;
    for (int k = 1; k < n; ++k) {
        Copy copy;
        copy.periodic = periodic;
        for (int d = 0, rest = k; d < dim; ++d, rest /= 3)
            copy.side[static_cast<std::size_t>(d)] = rest % 3 == 2 ? -1 : rest % 3;
        copies.push_back(copy);
    }
    return copies;
}

/// Nodes with all their images behind them, supports too.
struct AllImages {
    Case nodes;
    std::vector<std::vector<Slot>> owner;  ///< of each list's nodes
};

AllImages make_images(const Case& c, const Box& box, const std::array<bool, 3>& periodic) {
    AllImages all{c, {}};
    const auto dim = static_cast<std::size_t>(c.dim);
    for (std::size_t k = 0; k < c.lists.size(); ++k) {
        ListData& list = all.nodes.lists[k];
        std::vector<Slot>& owner = all.owner.emplace_back();
        for (Slot i = 0; i < c.n(k); ++i) owner.push_back(i);
        for (const Copy& copy : all_copies(c.dim, periodic))
            for (Slot i = 0; i < c.n(k); ++i) {
                std::array<double, 3> x{0, 0, 0};
                std::copy_n(c.lists[k].x.begin() + i * c.dim, dim, x.begin());
                x = copy.map(box, x, true);
                list.x.insert(list.x.end(), x.begin(), x.begin() + c.dim);
                owner.push_back(i);
                if (!list.tensor) {
                    list.h.push_back(c.lists[k].h[static_cast<std::size_t>(i)]);
                    continue;
                }
                // H' e_a·e_b = H (Q^-1 e_a)·(Q^-1 e_b), and Q is its own inverse.
                const double* packed = c.lists[k].H.data() + i * n_symmetric(c.dim);
                double H[3][3] = {};
                for (int a = 0, m = 0; a < c.dim; ++a)
                    for (int b = a; b < c.dim; ++b, ++m) H[a][b] = H[b][a] = packed[m];
                for (std::size_t a = 0; a < dim; ++a)
                    for (std::size_t b = a; b < dim; ++b) {
                        std::array<double, 3> u{0, 0, 0}, v{0, 0, 0};
                        u[a] = v[b] = 1;
                        u = copy.map(box, u, false), v = copy.map(box, v, false);
                        double sum = 0;
                        for (std::size_t p = 0; p < dim; ++p)
                            for (std::size_t q = 0; q < dim; ++q) sum += u[p] * H[p][q] * v[q];
                        list.H.push_back(sum);
                    }
            }
    }
    return all;
}

/// Positions and supports as the images have them, to rounding.
bool is_same_node(const ListData& a, Offset i, const ListData& b, Offset j, int dim) {
    for (int d = 0; d < dim; ++d)
        if (!(std::abs(a.x[static_cast<std::size_t>(i * dim + d)] -
                       b.x[static_cast<std::size_t>(j * dim + d)]) < 1e-13))
            return false;
    return true;
}

double support_difference(const ListData& a, Offset i, const ListData& b, Offset j, int dim) {
    if (!a.tensor)
        return std::abs(a.h[static_cast<std::size_t>(i)] - b.h[static_cast<std::size_t>(j)]);
    double largest = 0, scale = 0;
    for (int m = 0; m < n_symmetric(dim); ++m) {
        const double p = a.H[static_cast<std::size_t>(i * n_symmetric(dim) + m)],
                     q = b.H[static_cast<std::size_t>(j * n_symmetric(dim) + m)];
        largest = std::max(largest, std::abs(p - q)), scale = std::max(scale, std::abs(q));
    }
    return largest / scale;
}

struct Scene {
    Box box;
    std::array<bool, 3> periodic{false, false, false};
    Case nodes;
    Boundaries boundaries{3};

    explicit Scene(std::uint64_t seed) {
        Random random(seed);
        box.dim = 1 + static_cast<int>(seed % 3);
        for (std::size_t d = 0; d < 3; ++d) {
            box.lo[d] = random.uniform(-1, 1), box.hi[d] = box.lo[d] + random.uniform(0.7, 1.5);
            periodic[d] = random.chance(0.3);
        }
        if (random.chance(0.7)) box.frame = rotated_frame(box.dim, random);
        boundaries = Boundaries(box.dim);
        for (int d = 0; d < box.dim; ++d)
            periodic[static_cast<std::size_t>(d)] ? add_periodic(boundaries, box, d)
                                                  : add_walls(boundaries, box, d);
        nodes = cloud_in_box(box, 1 + random.below(25), 0.65, random);
    }
};

/// Node of the images that each node of the library is; every one at most once. Empty and a failure
/// where one is no image.
std::vector<std::vector<Offset>> match(const Case& made, const std::vector<NodeList>& lists,
                                       const AllImages& all) {
    std::vector<std::vector<Offset>> image(made.lists.size());
    for (std::size_t k = 0; k < made.lists.size(); ++k) {
        std::vector<bool> taken(all.owner[k].size(), false);
        for (Offset g = 0; g < made.n(k); ++g) {
            const Slot owner = g < made.lists[k].n_internal
                                   ? static_cast<Slot>(g)
                                   : lists[k].owners()(g - made.lists[k].n_internal);
            Offset found = -1;
            for (Offset m = 0; m < all.nodes.n(k) && found < 0; ++m)
                if (!taken[static_cast<std::size_t>(m)] &&
                    all.owner[k][static_cast<std::size_t>(m)] == owner &&
                    is_same_node(made.lists[k], g, all.nodes.lists[k], m, made.dim))
                    found = m;
            if (found < 0) {
                ADD_FAILURE() << "list " << k << ", node " << g << " is no image of " << owner;
                return {};
            }
            EXPECT_LT(support_difference(made.lists[k], g, all.nodes.lists[k], found, made.dim),
                      1e-10);
            taken[static_cast<std::size_t>(found)] = true;
            image[k].push_back(found);
        }
    }
    return image;
}

/// Largest (support of one that reaches the other) - 1: < 0 inside, > 0 outside.
long double nearness(const Case& all, std::size_t li, Offset i, std::size_t lj, Offset j) {
    std::array<double, 3> r{0, 0, 0};
    for (int d = 0; d < all.dim; ++d)
        r[static_cast<std::size_t>(d)] =
            all.lists[li].x[static_cast<std::size_t>(i * all.dim + d)] -
            all.lists[lj].x[static_cast<std::size_t>(j * all.dim + d)];
    return std::min(eta_over_K(all, li, i, r), eta_over_K(all, lj, j, r)) - 1;
}

/// Which images are in row `r`, by node of `all`.
std::vector<std::vector<bool>> named(const ConnectivityMap& map, Offset r,
                                     const std::vector<std::vector<Offset>>& image,
                                     const AllImages& all) {
    std::vector<std::vector<bool>> is_named;
    for (const auto& owner : all.owner) is_named.emplace_back(owner.size(), false);
    for (std::size_t l = 0; l < image.size(); ++l)
        for (const Slot j : map.rows()(r, static_cast<int>(l))) {
            const auto node = static_cast<std::size_t>(j - map.layout().list_offset()[l]);
            is_named[l][static_cast<std::size_t>(image[l][node])] = true;
        }
    return is_named;
}

TEST(Images, internal_nodes_have_the_neighbours_that_all_images_together_give) {
    Offset entries = 0, at_rim = 0;
    for (std::uint64_t seed = 0; seed < 240; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Scene scene(seed);
        ConnectivityMap map;
        scene.boundaries.update(map, node_lists(scene.nodes), MapOptions{});
        const AllImages all = make_images(scene.nodes, scene.box, scene.periodic);
        const Case made = copy_of(scene.boundaries.lists());
        const auto image = match(made, scene.boundaries.lists(), all);
        ASSERT_FALSE(image.empty());
        for (Offset r = 0; r < map.rows().n_rows(); ++r) {
            const auto is_named = named(map, r, image, all);
            const auto k = static_cast<std::size_t>(map.layout().list_of_row(r));
            const Offset i = r - map.layout().row_offset()[k];
            for (std::size_t l = 0; l < all.owner.size(); ++l)
                for (Offset j = 0; j < all.nodes.n(l); ++j) {
                    if (k == l && i == j) continue;
                    const long double near = nearness(all.nodes, k, i, l, j);
                    entries += near <= 0 ? 1 : 0;
                    if (std::abs(near) <= 1e-12L)
                        ++at_rim;
                    else
                        EXPECT_EQ(near < 0, is_named[l][static_cast<std::size_t>(j)])
                            << "list " << k << " node " << i << ", list " << l << " image " << j
                            << " of " << all.owner[l][static_cast<std::size_t>(j)];
                }
        }
    }
    EXPECT_GT(entries, 50000);
    RecordProperty("entries", std::to_string(entries));
    RecordProperty("at_rim", std::to_string(at_rim));
}

/// Two supports deep: whoever shares a witness with an internal node.
TEST(Images, with_overlap_ghosts_reach_two_supports_deep) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Scene scene(seed);
        for (ListData& list : scene.nodes.lists) {
            for (double& h : list.h) h *= 0.5;
            for (double& H : list.H) H *= 2;
        }
        MapOptions options;
        options.overlap = true;
        scene.boundaries.make(node_lists(scene.nodes), options);
        const AllImages all = make_images(scene.nodes, scene.box, scene.periodic);
        const Case made = copy_of(scene.boundaries.lists());
        const auto image = match(made, scene.boundaries.lists(), all);
        ASSERT_FALSE(image.empty());
        std::vector<std::vector<bool>> exists;
        for (std::size_t k = 0; k < image.size(); ++k) {
            exists.emplace_back(all.owner[k].size(), false);
            for (const Offset m : image[k]) exists[k][static_cast<std::size_t>(m)] = true;
        }
        const auto sees = [&](std::size_t k, Offset i, std::size_t l, Offset j) {
            std::array<double, 3> r{0, 0, 0};
            for (int d = 0; d < made.dim; ++d)
                r[static_cast<std::size_t>(d)] =
                    all.nodes.lists[k].x[static_cast<std::size_t>(i * made.dim + d)] -
                    all.nodes.lists[l].x[static_cast<std::size_t>(j * made.dim + d)];
            return eta_over_K(all.nodes, k, i, r) <= 1 - 1e-12L;
        };
        for (std::size_t k = 0; k < image.size(); ++k)
            for (Offset i = 0; i < std::min<Offset>(scene.nodes.n(k), 4); ++i)
                for (std::size_t w = 0; w < image.size(); ++w)
                    for (Offset m = 0; m < all.nodes.n(w); ++m) {
                        if (!sees(k, i, w, m)) continue;
                        EXPECT_TRUE(exists[w][static_cast<std::size_t>(m)]) << "a witness";
                        for (std::size_t l = 0; l < image.size(); ++l)
                            for (Offset j = 0; j < all.nodes.n(l); ++j)
                                if (sees(l, j, w, m) && !exists[l][static_cast<std::size_t>(j)])
                                    ADD_FAILURE() << "image " << j << " in list " << l;
                    }
    }
}

}  // namespace
}  // namespace connectivity::test
