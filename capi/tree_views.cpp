// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include "guard.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

void show_header(const TreeView& tree, conn_tree_view& out) {
    out.n_sources = tree.sources.n;
    out.n_targets = tree.targets.n;
    out.n_boxes = tree.n_boxes;
    out.aligned_n_boxes = tree.aligned_n_boxes;
    out.dim = tree.dim;
    out.n_levels = tree.n_levels;
    out.coordinates = tree.coordinates == CoordinateType::float32 ? CONN_FLOAT32 : CONN_FLOAT64;
    out.sources_are_targets = tree.sources_are_targets ? 1 : 0;
    out.extent_norm = !tree.extent_norm                     ? CONN_EXTENT_NONE
                      : *tree.extent_norm == ExtentNorm::l2 ? CONN_EXTENT_L2
                                                            : CONN_EXTENT_LINF;
    std::copy_n(tree.periodic.begin(), 3, out.periodic);
    out.stick_out_factor = tree.stick_out_factor;
    out.root_extent = tree.root_extent;
    std::copy_n(tree.bounding_box_min.begin(), 3, out.bounding_box_min);
    std::copy_n(tree.bounding_box_max.begin(), 3, out.bounding_box_max);
}

void show_boxes(const TreeView& tree, conn_tree_view& out) {
    out.level_start_box_nrs = tree.level_start_box_nrs.data();
    out.box_parent_ids = tree.box_parent_ids.data();
    out.box_child_ids = tree.box_child_ids.data();
    out.box_centers = tree.box_centers.data();
    out.box_levels = tree.box_levels.data();
    out.box_flags = tree.box_flags.data();
}

void show_particles(const TreeView& tree, conn_tree_view& out) {
    const TreeParticles &sources = tree.sources, &targets = tree.targets;
    out.sources = sources.positions.data();
    out.source_radii = sources.radii.data();
    out.user_source_ids = tree.user_source_ids.data();
    out.box_source_starts = sources.box_starts.data();
    out.box_source_counts_nonchild = sources.box_counts_nonchild.data();
    out.box_source_counts_cumul = sources.box_counts_cumul.data();
    out.box_source_bounding_box_min = sources.bounding_box_min.data();
    out.box_source_bounding_box_max = sources.bounding_box_max.data();
    out.targets = targets.positions.data();
    out.target_radii = targets.radii.data();
    out.sorted_target_ids = tree.sorted_target_ids.data();
    out.box_target_starts = targets.box_starts.data();
    out.box_target_counts_nonchild = targets.box_counts_nonchild.data();
    out.box_target_counts_cumul = targets.box_counts_cumul.data();
    out.box_target_bounding_box_min = targets.bounding_box_min.data();
    out.box_target_bounding_box_max = targets.bounding_box_max.data();
}

void check_range(const char* name, std::int64_t value, std::int64_t least, std::int64_t most) {
    if (value < least || value > most)
        throw Error(Status::argument, "boxes->" + std::string(name) + " = " +
                                          std::to_string(value) + ", must be in [" +
                                          std::to_string(least) + ", " + std::to_string(most) +
                                          "]");
}

/// Copies of the host's arrays, and the bytes of all of them.
class Copier {
public:
    template <class T>
    ConstView<T> needed(const T* from, Offset n, const char* name) {
        if (from == nullptr) throw Error(Status::null, "boxes->" + std::string(name) + " is NULL");
        const auto copy = allocate<T>("capi/boxes", n);
        std::copy_n(from, n, copy.data());
        bytes_ += n * static_cast<Offset>(sizeof(T));
        return copy;
    }
    template <class T>
    ConstView<T> wanted(const T* from, Offset n) {
        return from == nullptr ? ConstView<T>() : needed(from, n, "");
    }
    Offset bytes() const { return bytes_; }

private:
    Offset bytes_ = 0;
};

TreeView read_header(const conn_tree_view& in) {
    check_range("dim", in.dim, 1, 3);
    check_range("n_boxes", in.n_boxes, 1, max_slots);
    check_range("aligned_n_boxes", in.aligned_n_boxes, in.n_boxes, max_slots);
    check_range("n_levels", in.n_levels, 1, 255);
    check_range("n_sources", in.n_sources, 0, max_slots);
    check_range("n_targets", in.n_targets, 0, max_slots);
    check_range("coordinates", in.coordinates, CONN_FLOAT64, CONN_FLOAT32);
    check_range("extent_norm", in.extent_norm, CONN_EXTENT_NONE, CONN_EXTENT_L2);
    if (!(in.root_extent >= 0 && in.root_extent < 1e300))
        throw Error(Status::argument,
                    "boxes->root_extent = " + number(in.root_extent) + ", must be >= 0 and finite");
    TreeView tree;
    tree.dim = in.dim;
    tree.n_boxes = in.n_boxes;
    tree.aligned_n_boxes = in.aligned_n_boxes;
    tree.n_levels = in.n_levels;
    tree.sources.n = in.n_sources;
    tree.targets.n = in.n_targets;
    tree.coordinates =
        in.coordinates == CONN_FLOAT32 ? CoordinateType::float32 : CoordinateType::float64;
    tree.sources_are_targets = read_flag(in.sources_are_targets, "boxes->sources_are_targets");
    if (in.extent_norm != CONN_EXTENT_NONE)
        tree.extent_norm = in.extent_norm == CONN_EXTENT_L2 ? ExtentNorm::l2 : ExtentNorm::linf;
    tree.stick_out_factor = in.stick_out_factor;
    tree.root_extent = in.root_extent;
    for (std::size_t d = 0; d < 3; ++d) {
        tree.periodic[d] = read_flag(in.periodic[d], "boxes->periodic[" + std::to_string(d) + "]");
        tree.bounding_box_min[d] = in.bounding_box_min[d];
        tree.bounding_box_max[d] = in.bounding_box_min[d] + in.root_extent;
    }
    return tree;
}

void copy_boxes(const conn_tree_view& in, Copier& copier, TreeView& tree) {
    const Offset n = tree.n_boxes, table = tree.aligned_n_boxes;
    tree.level_start_box_nrs =
        copier.needed(in.level_start_box_nrs, tree.n_levels + 1, "level_start_box_nrs");
    tree.box_parent_ids = copier.needed(in.box_parent_ids, n, "box_parent_ids");
    tree.box_child_ids =
        copier.needed(in.box_child_ids, (Offset{1} << tree.dim) * table, "box_child_ids");
    tree.box_centers = copier.needed(in.box_centers, tree.dim * table, "box_centers");
    tree.box_levels = copier.needed(in.box_levels, n, "box_levels");
    tree.box_flags = copier.needed(in.box_flags, n, "box_flags");
}

void copy_particles(const conn_tree_view& in, Copier& copier, TreeView& tree) {
    const Offset n = tree.n_boxes, hull = tree.dim * tree.aligned_n_boxes;
    TreeParticles &sources = tree.sources, &targets = tree.targets;
    sources.radii = copier.wanted(in.source_radii, in.n_sources);
    sources.box_counts_nonchild = copier.wanted(in.box_source_counts_nonchild, n);
    sources.box_counts_cumul = copier.wanted(in.box_source_counts_cumul, n);
    sources.bounding_box_min = copier.wanted(in.box_source_bounding_box_min, hull);
    sources.bounding_box_max = copier.wanted(in.box_source_bounding_box_max, hull);
    targets.radii = copier.wanted(in.target_radii, in.n_targets);
    targets.box_counts_nonchild = copier.wanted(in.box_target_counts_nonchild, n);
    targets.box_counts_cumul = copier.wanted(in.box_target_counts_cumul, n);
    targets.bounding_box_min = copier.wanted(in.box_target_bounding_box_min, hull);
    targets.bounding_box_max = copier.wanted(in.box_target_bounding_box_max, hull);
}

/// Throws Error{argument} where arrays contradict each other: lists that want nothing but the boxes
/// look at all of them.
void check_boxes(const TreeView& tree) {
    TraversalOptions options;
    options.same_level_non_well_sep_boxes = options.neighbor_source_boxes =
        options.from_sep_siblings = options.from_sep_smaller = options.from_sep_bigger = false;
    options.from_sep_smaller_crit = FromSepSmallerCrit::static_l2;  // needs no hulls
    const FMMTraversalInfo lists(tree, options);
}

}  // namespace

conn_status conn_tree_acquire(const conn_tree* tree, int32_t space, conn_tree_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = built_tree(tree);
        check_space(space);
        conn_tree_view out = read_view(view, conn_tree_view CONN_TREE_VIEW_INIT);
        auto pin = std::make_unique<TreePin>();
        pin->tree = ours.view();
        show_header(pin->tree, out);
        show_boxes(pin->tree, out);
        show_particles(pin->tree, out);
        out.generation = ours.generation;
        out.space = space;
        write_view(view, out, std::move(pin));
    });
}

conn_status conn_tree_release(conn_tree_view* view) {
    return guarded(__func__,
                   [&] { release_view<TreePin>(view, conn_tree_view CONN_TREE_VIEW_INIT); });
}

conn_status conn_tree_set_boxes(conn_tree* tree, const conn_tree_view* boxes) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_tree>(tree, "tree");
        const conn_tree_view in = read_struct(boxes, conn_tree_view CONN_TREE_VIEW_INIT, "boxes");
        TreeView given = read_header(in);
        Copier copier;
        copy_boxes(in, copier, given);
        copy_particles(in, copier, given);
        check_boxes(given);
        BoxTree none;
        ours.builder = std::move(none);
        ours.given = given;
        ours.given_bytes = copier.bytes();
        ours.generation = next_tree_generation();
    });
}
