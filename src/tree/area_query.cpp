// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/area_query.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "check_array.hpp"

namespace connectivity {

namespace {

using namespace tree_detail;

/// The balls in double precision, and which boxes they touch.
struct Balls {
    const TreeView& tree;
    const ParticleArray& array;
    CoordinateType type;

    double distance(Offset ball, BoxId box) const {
        double most = 0;
        for (int d = 0; d < tree.dim; ++d)
            most = std::max(most, std::abs(coordinate(array, type, ball, d) - tree.center(d, box)));
        return most;
    }

    /// f(leaf) for each leaf that a ball touches, depth-first.
    template <class F>
    void for_each_leaf(Offset ball, const F& f) const {
        const double reach = radius(array, type, ball);
        std::array<BoxId, 256 * 7 + 2> stack;  // 7 of 8 children wait on each of 256 levels
        stack[0] = 0;
        for (int n_waiting = 1; n_waiting > 0;) {
            const BoxId box = stack[--n_waiting];
            const bool leaf = (tree.box_flags(box) &
                               (box_flag::has_child_sources | box_flag::has_child_targets)) == 0;
            // A child's half width and distance are rounded: its parent must not stand in the way.
            const double room = (tree.half_width(box) + reach) * (leaf ? 1 : 1 + 1e-12) +
                                (leaf ? 0 : 1e-12 * tree.root_extent);
            if (distance(ball, box) > room) continue;
            if (leaf) f(box);
            for (int k = (1 << tree.dim) - 1; k >= 0; --k)
                if (const BoxId child = tree.child(k, box); child > 0) stack[n_waiting++] = child;
        }
    }
};

}  // namespace

Csr area_query(const TreeView& tree, const ParticleArray& balls, CoordinateType coordinates) {
    check_array("ball", balls, tree.dim, coordinates);
    check_values("ball", balls, tree.dim, coordinates);
    const Balls query{tree, balls, coordinates};
    Csr out("tree/area_query");
    out.prepare(balls.n, [&](Offset ball) {
        Offset n = 0;
        query.for_each_leaf(ball, [&](BoxId) { ++n; });
        return n;
    });
    out.reserve();
    out.commit([&](Offset first, Offset last, const Offset* offsets, Slot* values) {
        for (Offset ball = first; ball < last; ++ball) {
            Slot* next = values + offsets[ball];
            query.for_each_leaf(ball, [&](BoxId leaf) { *next++ = leaf; });
        }
    });
    return out;
}

Csr leaves_to_balls(const TreeView& tree, const ParticleArray& balls, CoordinateType coordinates) {
    const Csr leaves = area_query(tree, balls, coordinates);
    const Slot* const values = leaves.value_data();
    std::vector<Offset> counts(tree.n_boxes, 0);
    for (Offset k = 0; k < leaves.n_values(); ++k) ++counts[values[k]];
    Csr out("tree/leaves_to_balls");
    out.prepare(tree.n_boxes, [&](Offset b) { return counts[b]; });
    out.reserve();
    std::copy(out.prepared_offsets(), out.prepared_offsets() + tree.n_boxes, counts.begin());
    const Offset* const starts = leaves.offset_data();
    for (Offset ball = 0; ball < balls.n; ++ball)
        for (Offset k = starts[ball]; k < starts[ball + 1]; ++k)
            out.prepared_values()[counts[values[k]]++] = static_cast<Slot>(ball);
    out.publish();
    return out;
}

View<double> space_invader_distances(const TreeView& tree, const ParticleArray& balls,
                                     CoordinateType coordinates) {
    const Csr lists = leaves_to_balls(tree, balls, coordinates);
    const Balls query{tree, balls, coordinates};
    auto distances = allocate<double>("tree/space_invader", tree.n_boxes);
    for (BoxId b = 0; b < tree.n_boxes; ++b) {
        double most = 0;
        for (Offset k = lists.offset_data()[b]; k < lists.offset_data()[b + 1]; ++k)
            most = std::max(most, query.distance(lists.value_data()[k], b));
        distances(b) = most;
    }
    return distances;
}

}  // namespace connectivity
