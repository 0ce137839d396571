// SPDX-License-Identifier: BSD-3-Clause
#include "tree_arrays.hpp"

#include <utility>

namespace connectivity::tree_detail {

namespace {

template <class T>
ConstView<T> cut(const View<T>& storage, Offset n) {
    return Kokkos::subview(storage,
                           std::pair<std::size_t, std::size_t>(0, static_cast<std::size_t>(n)));
}

template <class... Views>
Offset bytes_of(const Views&... views) {
    return (static_cast<Offset>(views.size() * sizeof(*views.data())) + ...);
}

void take_particles(ParticleArrays& next, const ParticleArrays& old, const TreeView& tree, Offset n,
                    bool radii, bool hulls) {
    const Offset n_hull = hulls ? tree.dim * tree.aligned_n_boxes : 0;
    next.positions = spare(old.positions, "tree/positions", tree.dim * n);
    next.radii = spare(old.radii, "tree/radii", radii ? n : 0);
    next.box_starts = spare(old.box_starts, "tree/box_starts", tree.n_boxes);
    next.box_counts_nonchild =
        spare(old.box_counts_nonchild, "tree/box_counts_nonchild", tree.n_boxes);
    next.box_counts_cumul = spare(old.box_counts_cumul, "tree/box_counts_cumul", tree.n_boxes);
    next.hull_min = spare(old.hull_min, "tree/bounding_box_min", n_hull);
    next.hull_max = spare(old.hull_max, "tree/bounding_box_max", n_hull);
}

}  // namespace

TreeParticles ParticleArrays::view(const TreeView& tree, Offset n, bool radii_there,
                                   bool hulls_there) const {
    TreeParticles out;
    const Offset n_hull = hulls_there ? tree.dim * tree.aligned_n_boxes : 0;
    out.n = n;
    out.positions = cut(positions, tree.dim * n);
    out.radii = cut(radii, radii_there ? n : 0);
    out.box_starts = cut(box_starts, tree.n_boxes);
    out.box_counts_nonchild = cut(box_counts_nonchild, tree.n_boxes);
    out.box_counts_cumul = cut(box_counts_cumul, tree.n_boxes);
    out.bounding_box_min = cut(hull_min, n_hull);
    out.bounding_box_max = cut(hull_max, n_hull);
    return out;
}

Offset ParticleArrays::bytes() const {
    return bytes_of(positions, radii, box_starts, box_counts_nonchild, box_counts_cumul, hull_min,
                    hull_max);
}

TreeView TreeArrays::view() const {
    TreeView tree = header;
    if (tree.n_boxes == 0) return tree;
    const Offset aligned = tree.aligned_n_boxes;
    tree.level_start_box_nrs = cut(level_starts, tree.n_levels + 1);
    tree.box_parent_ids = cut(parents, tree.n_boxes);
    tree.box_child_ids = cut(children, (Offset{1} << tree.dim) * aligned);
    tree.box_centers = cut(centers, tree.dim * aligned);
    tree.box_levels = cut(levels, tree.n_boxes);
    tree.box_flags = cut(flags, tree.n_boxes);
    tree.user_source_ids = cut(user_source_ids, tree.sources.n);
    tree.sorted_target_ids = cut(sorted_target_ids, tree.targets.n);
    tree.sources = sources.view(tree, header.sources.n, source_radii, hulls);
    tree.targets = tree.sources_are_targets
                       ? tree.sources
                       : targets.view(tree, header.targets.n, target_radii, hulls);
    return tree;
}

Offset TreeArrays::bytes() const {
    return bytes_of(level_starts, parents, children, centers, levels, flags, user_source_ids,
                    sorted_target_ids) +
           sources.bytes() + targets.bytes();
}

void TreeArrays::take(const TreeArrays& old) {
    const Offset n_boxes = header.n_boxes, aligned = header.aligned_n_boxes;
    level_starts = spare(old.level_starts, "tree/level_start_box_nrs", header.n_levels + 1);
    parents = spare(old.parents, "tree/box_parent_ids", n_boxes);
    children = spare(old.children, "tree/box_child_ids", (Offset{1} << header.dim) * aligned);
    centers = spare(old.centers, "tree/box_centers", header.dim * aligned);
    levels = spare(old.levels, "tree/box_levels", n_boxes);
    flags = spare(old.flags, "tree/box_flags", n_boxes);
    user_source_ids = spare(old.user_source_ids, "tree/user_source_ids", header.sources.n);
    sorted_target_ids = spare(old.sorted_target_ids, "tree/sorted_target_ids", header.targets.n);
    take_particles(sources, old.sources, header, header.sources.n, source_radii, hulls);
    if (!header.sources_are_targets)
        take_particles(targets, old.targets, header, header.targets.n, target_radii, hulls);
}

}  // namespace connectivity::tree_detail
