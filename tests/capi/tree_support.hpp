// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the tests of trees and interaction lists share: handles and views that end themselves, and
/// clouds of particles as a host has them.

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <connectivity_lists.h>
#include <support/random.hpp>

#include "capi_support.hpp"

namespace connectivity::test {

/// A view that is released at the end.
template <class View, conn_status (*Release)(View*)>
struct Pinned {
    View view;
    explicit Pinned(const View& empty) : view(empty) {}
    ~Pinned() { EXPECT_TRUE(ok(Release(&view))); }
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;
    View* operator->() { return &view; }
    const View* operator->() const { return &view; }
};

struct TreeArrays : Pinned<conn_tree_view, conn_tree_release> {
    TreeArrays() : Pinned(CONN_TREE_VIEW_INIT) {}
    explicit TreeArrays(const conn_tree* tree) : TreeArrays() {
        EXPECT_TRUE(ok(conn_tree_acquire(tree, CONN_SPACE_HOST, &view)));
    }
    double half_width(std::int32_t box) const {
        return std::ldexp(view.root_extent, -(view.box_levels[box] + 1));
    }
    double center(int axis, std::int32_t box) const {
        return view.box_centers[axis * view.aligned_n_boxes + box];
    }
    bool is_leaf(std::int32_t box) const {
        for (int m = 0; m < 1 << view.dim; ++m)
            if (view.box_child_ids[m * view.aligned_n_boxes + box] != 0) return false;
        return true;
    }
    /// The largest distance of the closed cubes along an axis, negative where they overlap.
    double gap(std::int32_t a, std::int32_t b) const {
        double most = -1e300;
        for (int d = 0; d < view.dim; ++d)
            most = std::max(most,
                            std::abs(center(d, a) - center(d, b)) - half_width(a) - half_width(b));
        return most;
    }
};

struct BoxRows : Pinned<conn_box_list_view, conn_box_list_release> {
    BoxRows() : Pinned(CONN_BOX_LIST_VIEW_INIT) {}
    BoxRows(const conn_lists* lists, int which, int level = 0) : BoxRows() {
        EXPECT_TRUE(ok(conn_lists_acquire(lists, which, level, CONN_SPACE_HOST, &view)));
    }
    std::span<const std::int32_t> operator[](std::int64_t row) const {
        return {view.lists + view.starts[row], view.lists + view.starts[row + 1]};
    }
    std::vector<std::int32_t> row(std::int64_t r) const {
        return {(*this)[r].begin(), (*this)[r].end()};
    }
    std::vector<std::int32_t> entries() const { return {view.lists, view.lists + view.n_entries}; }
    std::vector<std::int64_t> starts() const {
        return {view.starts, view.starts + view.n_rows + 1};
    }
};

struct Classes : Pinned<conn_classes_view, conn_lists_classes_release> {
    Classes() : Pinned(CONN_CLASSES_VIEW_INIT) {}
    Classes(const conn_lists* lists, int which) : Classes() {
        EXPECT_TRUE(ok(conn_lists_classes_acquire(lists, which, CONN_SPACE_HOST, &view)));
    }
};

struct ParticleSets : Pinned<conn_particles_view, conn_particles_release> {
    ParticleSets() : Pinned(CONN_PARTICLES_VIEW_INIT) {}
};

/// Sources and targets of a host, with or without radii.
struct Cloud {
    int dim = 2;
    std::vector<double> sources, targets;  ///< [n][dim]; no targets: the sources are
    std::vector<double> source_radii, target_radii;
    bool has_targets = false;

    std::int64_t n_sources() const { return static_cast<std::int64_t>(sources.size()) / dim; }
    std::int64_t n_targets() const {
        return has_targets ? static_cast<std::int64_t>(targets.size()) / dim : n_sources();
    }
};

inline std::vector<double> random_points(Random& random, int dim, int n, double steepness = 1) {
    std::vector<double> x;
    for (int k = 0; k < n * dim; ++k) x.push_back(std::pow(random.uniform(), steepness));
    return x;
}

inline std::vector<double> random_radii(Random& random, int n) {
    std::vector<double> radii;
    for (int k = 0; k < n; ++k) radii.push_back(std::exp2(random.uniform(-10, -2)));
    return radii;
}

struct Tree {
    conn_tree* handle = nullptr;
    explicit Tree(const Context& context) {
        EXPECT_TRUE(ok(conn_tree_create(context.handle, &handle)));
    }
    Tree(const Context& context, const Cloud& cloud, const conn_tree_options& options)
        : Tree(context) {
        EXPECT_TRUE(ok(build(cloud, options)));
    }
    ~Tree() { EXPECT_TRUE(ok(conn_tree_destroy(&handle))); }
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    conn_status build(const Cloud& cloud, const conn_tree_options& options) const {
        const auto points = [&](const std::vector<double>& x) {
            return conn_array_matrix(x.data(), static_cast<std::int64_t>(x.size()) / cloud.dim,
                                     cloud.dim);
        };
        const auto values = [](const std::vector<double>& v) {
            return conn_array_vector(v.data(), static_cast<std::int64_t>(v.size()));
        };
        const conn_array sources = points(cloud.sources), targets = points(cloud.targets),
                         source_radii = values(cloud.source_radii),
                         target_radii = values(cloud.target_radii);
        conn_tree_input input = CONN_TREE_INPUT_INIT;
        input.dim = cloud.dim;
        input.sources = &sources;
        if (cloud.has_targets) input.targets = &targets;
        if (!cloud.source_radii.empty()) input.source_radii = &source_radii;
        if (!cloud.target_radii.empty()) input.target_radii = &target_radii;
        return conn_tree_build(handle, &input, &options);
    }
};

struct InteractionLists {
    conn_lists* handle = nullptr;
    explicit InteractionLists(const Context& context) {
        EXPECT_TRUE(ok(conn_lists_create(context.handle, &handle)));
    }
    InteractionLists(const Context& context, const Tree& tree,
                     const conn_lists_options& options = CONN_LISTS_OPTIONS_INIT)
        : InteractionLists(context) {
        EXPECT_TRUE(ok(conn_lists_rebuild(handle, tree.handle, &options)));
    }
    ~InteractionLists() { EXPECT_TRUE(ok(conn_lists_destroy(&handle))); }
    InteractionLists(const InteractionLists&) = delete;
    InteractionLists& operator=(const InteractionLists&) = delete;
};

inline conn_tree_options leaf_of(int n) {
    conn_tree_options options = CONN_TREE_OPTIONS_INIT;
    options.max_particles_in_box = n;
    return options;
}

/// 150 sources and 110 targets, denser at one corner, both with radii.
inline Cloud cloud_with_radii(int dim, std::uint64_t seed) {
    Random random(seed);
    Cloud cloud;
    cloud.dim = dim;
    cloud.sources = random_points(random, dim, 150, 2);
    cloud.targets = random_points(random, dim, 110, 3);
    cloud.source_radii = random_radii(random, 150);
    cloud.target_radii = random_radii(random, 110);
    cloud.has_targets = true;
    return cloud;
}

inline conn_tree_options with_radii(int n) {
    conn_tree_options options = leaf_of(n);
    options.stick_out_factor = 0.25;
    return options;
}

}  // namespace connectivity::test
