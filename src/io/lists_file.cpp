// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/lists_file.hpp>

#include <algorithm>
#include <array>
#include <limits>

#include <connectivity/io/pending_file.hpp>

#include "io/hdf5.hpp"

namespace connectivity {

struct ListsFile::State {
    explicit State(const std::string& path)
        : file(path), root(hdf5::Group::create_file(file.temporary())) {}

    template <class T>
    void scalar(const std::string& name, const T& value) {
        root->write(name, &value, {});
    }
    template <class T>
    void array(const std::string& name, const ConstView<T>& values) {
        root->write(name, values.data(), {static_cast<Offset>(values.size())});
    }
    /// Real numbers in the precision of the coordinates, [size] or [rows, size / rows].
    void reals(const std::string& name, const ConstView<double>& values, Offset rows = 0);
    /// As int32 if all fit. They ascend.
    void starts(const std::string& name, const ConstView<Offset>& values);
    void list(const std::string& name, const BoxList& list);
    void particles(const std::string& kind, const TreeParticles& particles);
    void hulls(const std::string& kind, const TreeParticles& particles);
    void translations(const std::string& prefix, const TranslationClassesInfo& classes);

    PendingFile file;  // before root: HDF5 closes the file before it is removed
    std::optional<hdf5::Group> root;
    int dim = 0;
    bool single = false;  ///< precision of the coordinates
};

void ListsFile::State::reals(const std::string& name, const ConstView<double>& values,
                             Offset rows) {
    const auto n = static_cast<Offset>(values.size());
    const hdf5::Shape shape = rows > 0 ? hdf5::Shape{rows, n / rows} : hdf5::Shape{n};
    if (!single) return root->write(name, values.data(), shape);
    auto rounded = allocate<float>("io/" + name, n);
    for (Offset i = 0; i < n; ++i) rounded(i) = static_cast<float>(values(i));
    root->write(name, rounded.data(), shape);
}

void ListsFile::State::starts(const std::string& name, const ConstView<Offset>& values) {
    const auto n = static_cast<Offset>(values.size());
    if (n > 0 && values(n - 1) > std::numeric_limits<BoxId>::max()) return array(name, values);
    array<BoxId>(name, starts_as_box_ids(values));
}

void ListsFile::State::list(const std::string& name, const BoxList& list) {
    starts(name + "_starts", list.starts);
    array(name + "_lists", list.lists);
    if (list.images.size() > 0) array(name + "_images", list.images);
}

void ListsFile::State::particles(const std::string& kind, const TreeParticles& p) {
    reals("tree_" + kind + "s", p.positions, dim);
    if (p.have_extent()) reals("tree_" + kind + "_radii", p.radii);
    const std::string boxes = "tree_box_" + kind + "_";
    array(boxes + "starts", p.box_starts);
    array(boxes + "counts_nonchild", p.box_counts_nonchild);
    array(boxes + "counts_cumul", p.box_counts_cumul);
}

void ListsFile::State::hulls(const std::string& kind, const TreeParticles& p) {
    if (p.bounding_box_min.size() == 0) return;
    reals("trav_box_" + kind + "_bounding_box_min", p.bounding_box_min, dim);
    reals("trav_box_" + kind + "_bounding_box_max", p.bounding_box_max, dim);
}

void ListsFile::State::translations(const std::string& prefix,
                                    const TranslationClassesInfo& classes) {
    array(prefix + "_classes", classes.from_sep_siblings_translation_classes());
    reals(prefix + "_distance_vectors",
          classes.from_sep_siblings_translation_class_to_distance_vector(), dim);
}

ListsFile::ListsFile(const std::string& path) : state_(std::make_unique<State>(path)) {}
ListsFile::~ListsFile() = default;

void ListsFile::write(const TreeView& tree) {
    State& file = *state_;
    file.dim = tree.dim;
    file.single = tree.coordinates == CoordinateType::float32;
    const auto corner = [&](const std::string& name, const std::array<double, 3>& values) {
        auto view = allocate<double>("io/" + name, tree.dim);
        std::copy_n(values.begin(), tree.dim, view.data());
        file.reals(name, view);
    };
    corner("tree_bbox_min", tree.bounding_box_min);
    corner("tree_bbox_max", tree.bounding_box_max);
    file.scalar("tree_root_extent", tree.root_extent);
    if (tree.extent_norm)
        file.scalar("tree_stick_out_factor", tree.stick_out_factor);
    else  // boxtree has the whole number 0 there
        file.scalar<std::int64_t>("tree_stick_out_factor", 0);
    file.scalar<std::int64_t>("tree_nlevels", tree.n_levels);
    file.scalar<std::int64_t>("tree_nboxes", tree.n_boxes);
    file.scalar<std::int64_t>("tree_aligned_nboxes", tree.aligned_n_boxes);
    file.array("tree_level_start_box_nrs", tree.level_start_box_nrs);
    file.array("tree_box_parent_ids", tree.box_parent_ids);
    file.root->write("tree_box_child_ids", tree.box_child_ids.data(),
                     {Offset{1} << tree.dim, tree.aligned_n_boxes});
    file.reals("tree_box_centers", tree.box_centers, tree.dim);
    file.array("tree_box_levels", tree.box_levels);
    file.array("tree_box_flags", tree.box_flags);
    file.particles("source", tree.sources);
    file.particles("target", tree.targets);
    file.array("tree_user_source_ids", tree.user_source_ids);
    file.array("tree_sorted_target_ids", tree.sorted_target_ids);
}

void ListsFile::write(const FMMTraversalInfo& lists) {
    State& file = *state_;
    file.array("trav_source_boxes", lists.source_boxes());
    file.array("trav_target_boxes", lists.target_boxes());
    file.array("trav_source_parent_boxes", lists.source_parent_boxes());
    file.array("trav_target_or_target_parent_boxes", lists.target_or_target_parent_boxes());
    const std::string level_start = "trav_level_start_";
    file.starts(level_start + "source_box_nrs", lists.level_start_source_box_nrs());
    file.starts(level_start + "target_box_nrs", lists.level_start_target_box_nrs());
    file.starts(level_start + "source_parent_box_nrs", lists.level_start_source_parent_box_nrs());
    file.starts(level_start + "target_or_target_parent_box_nrs",
                lists.level_start_target_or_target_parent_box_nrs());
    file.hulls("source", lists.tree().sources);
    file.hulls("target", lists.tree().targets);
    file.list("trav_same_level_non_well_sep_boxes", lists.same_level_non_well_sep_boxes());
    file.list("trav_neighbor_source_boxes", lists.neighbor_source_boxes());
    file.list("trav_from_sep_siblings", lists.from_sep_siblings());
    file.list("trav_from_sep_bigger", lists.from_sep_bigger());
    if (const auto close = lists.from_sep_close_smaller())
        file.list("trav_from_sep_close_smaller", *close);
    if (const auto close = lists.from_sep_close_bigger())
        file.list("trav_from_sep_close_bigger", *close);
    for (int level = 0; level < lists.nlevels(); ++level) {
        const std::string name = "trav_fss" + std::to_string(level);
        const LevelBoxList list = lists.from_sep_smaller(level);
        const std::array<std::int64_t, 2> scalars{list.count(), list.num_nonempty_lists()};
        file.list(name, list);
        file.array(name + "_nonempty_indices", list.nonempty_indices);
        file.array(name + "_targets", list.target_boxes_sep_smaller);
        file.root->write(name + "_scalars", scalars.data(), {2});
    }
}

void ListsFile::write_merged(const FMMTraversalInfo& merged) {
    state_->list("merged_neighbor_source_boxes", merged.neighbor_source_boxes());
}

void ListsFile::write(const TranslationClassesInfo& by_level,
                      const TranslationClassesInfo& level_free) {
    state_->translations("tc", by_level);
    state_->array("tc_level_starts", by_level.from_sep_siblings_translation_classes_level_starts());
    state_->translations("tcall", level_free);
    const std::array<std::int32_t, 2> ends{0, level_free.nfrom_sep_siblings_translation_classes()};
    state_->root->write("tcall_level_starts", ends.data(), {2});
}

void ListsFile::write(const RotationClassesInfo& classes) {
    const auto angles = classes.from_sep_siblings_rotation_class_to_angle();
    state_->array("rot_classes", classes.from_sep_siblings_rotation_classes());
    state_->array("rot_class_to_angle", angles);  // float64 in every precision
}

void ListsFile::commit(const std::string& command) {
    state_->root->set("command", command);
    state_->root->set("library_version", std::string(CONNECTIVITY_VERSION));
    state_->root->flush();
    state_->root.reset();
    state_->file.commit();
}

}  // namespace connectivity
