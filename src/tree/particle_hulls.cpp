// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/particle_hulls.hpp>

#include <algorithm>

#include <connectivity/base/parallel.hpp>

namespace connectivity {

namespace {

struct Hulls {
    const TreeView& tree;
    const TreeParticles& particles;
    double *min, *max;

    void own(BoxId box) const {
        const Offset n = particles.n, first = particles.box_starts(box),
                     last = first + particles.box_counts_nonchild(box);
        const bool points = !particles.have_extent();
        for (int d = 0; d < tree.dim; ++d) {
            double lo = tree.center(d, box), hi = lo;
            const double* const x = particles.positions.data() + d * n;
            for (Offset i = first; i < last; ++i) {
                const double radius = points ? 0 : particles.radii(i);
                lo = std::min(lo, x[i] - radius);
                hi = std::max(hi, x[i] + radius);
            }
            min[d * tree.aligned_n_boxes + box] = lo;
            max[d * tree.aligned_n_boxes + box] = hi;
        }
    }

    void join_children(BoxId box) const {
        for (int k = 0; k < 1 << tree.dim; ++k) {
            const BoxId child = tree.child(k, box);
            if (child == 0) continue;
            for (int d = 0; d < tree.dim; ++d) {
                const Offset at = d * tree.aligned_n_boxes;
                min[at + box] = std::min(min[at + box], min[at + child]);
                max[at + box] = std::max(max[at + box], max[at + child]);
            }
        }
    }
};

}  // namespace

void particle_hulls(const TreeView& tree, const TreeParticles& particles, View<double> min,
                    View<double> max) {
    const Hulls hulls{tree, particles, min.data(), max.data()};
    for (int d = 0; d < tree.dim; ++d)
        for (Offset b = tree.n_boxes; b < tree.aligned_n_boxes; ++b)
            min(d * tree.aligned_n_boxes + b) = max(d * tree.aligned_n_boxes + b) = 0;
    constexpr Offset chunk = 512;
    for (int level = tree.n_levels - 1; level >= 0; --level) {
        const Offset first = tree.level_start_box_nrs(level),
                     last = tree.level_start_box_nrs(level + 1);
        for_each_dynamic("tree/hulls", (last - first + chunk - 1) / chunk, [&](int, Offset c) {
            const Offset end = std::min(last, first + (c + 1) * chunk);
            for (Offset b = first + c * chunk; b < end; ++b) {
                hulls.own(static_cast<BoxId>(b));
                hulls.join_children(static_cast<BoxId>(b));
            }
        });
    }
}

}  // namespace connectivity
