// SPDX-License-Identifier: BSD-3-Clause
// boxtree's own trees and interaction lists through the C interface: integers exactly, order
// included.

#include <algorithm>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include <io/plain_hdf5.hpp>
#include <support/shared_data.hpp>

#include "tree_support.hpp"

namespace connectivity::test {
namespace {

/// The small files in the repository, or all of them beside it.
std::vector<std::filesystem::path> boxtree_files() {
    std::vector<std::filesystem::path> files;
    for (const std::string& folder :
         {shared_data("oracle/boxtree"),
          std::string(CONNECTIVITY_SOURCE_DIR "/tests/support/data/boxtree")}) {
        std::error_code absent;
        for (const auto& entry : std::filesystem::directory_iterator(folder, absent))
            if (entry.path().extension() == ".h5") files.push_back(entry.path());
        if (!files.empty()) break;
    }
    std::ranges::sort(files);
    return files;
}

class CapiBoxtree : public ::testing::TestWithParam<std::filesystem::path> {
protected:
    CapiBoxtree() {
        if (GetParam().stem() == "a3_linked")  // that file has no parameters
            params_ = {{"d", 2}, {"leaf", 20}, {"sof", 0.25}};
        else
            params_ = nlohmann::json::parse(file_.strings("/", "params").at(0));
        build();
    }

    /// Particles as the file has them, or as float32.
    class Array {
    public:
        Array(const PlainFile& file, const std::string& key, int dim, bool is_float) {
            if (!file.has(key)) return;
            values_ = file.read<double>(key);
            floats_.assign(values_.begin(), values_.end());
            const void* const data = is_float ? static_cast<const void*>(floats_.data())
                                              : static_cast<const void*>(values_.data());
            array_ = conn_array_matrix_of(is_float ? CONN_FLOAT32 : CONN_FLOAT64, data,
                                          static_cast<std::int64_t>(values_.size()) / dim, dim);
        }
        const conn_array* get() const { return values_.empty() ? nullptr : &array_; }

    private:
        std::vector<double> values_;
        std::vector<float> floats_;
        conn_array array_{};
    };

    void build() {
        const int dim = params_["d"];
        const bool is_float = params_.value("f32", false);
        const Array sources(file_, "in_sources", dim, is_float),
            targets(file_, "in_targets", dim, is_float),
            source_radii(file_, "in_source_radii", 1, is_float),
            target_radii(file_, "in_target_radii", 1, is_float);
        conn_tree_input input = CONN_TREE_INPUT_INIT;
        input.dim = dim;
        input.sources = sources.get();
        input.targets = targets.get();
        input.source_radii = source_radii.get();
        input.target_radii = target_radii.get();
        conn_tree_options options = tree_options();
        std::vector<std::int32_t> weights;
        conn_array weight_array{};
        if (file_.has("in_refine_weights")) {
            weights = file_.read<int>("in_refine_weights");
            weight_array =
                conn_array_vector_int32(weights.data(), static_cast<std::int64_t>(weights.size()));
            input.refine_weights = &weight_array;
        }
        if (input.source_radii != nullptr || input.target_radii != nullptr)
            options.stick_out_factor = params_.value("sof", 0.0);
        EXPECT_TRUE(ok(conn_tree_build(tree_.handle, &input, &options)));
        EXPECT_TRUE(ok(conn_tree_acquire(tree_.handle, CONN_SPACE_HOST, &boxes_.view)));
    }
    conn_tree_options tree_options() const {
        conn_tree_options options = CONN_TREE_OPTIONS_INIT;
        const auto kind = params_.value("kind", std::string("adaptive"));
        options.kind = kind == "non-adaptive"                ? CONN_TREE_NON_ADAPTIVE
                       : kind == "adaptive-level-restricted" ? CONN_TREE_LEVEL_RESTRICTED
                                                             : CONN_TREE_ADAPTIVE;
        if (file_.has("in_refine_weights"))
            options.max_leaf_refine_weight = params_["maxw"];
        else
            options.max_particles_in_box = params_["leaf"];
        if (params_.value("norm", std::string("linf")) == "l2")
            options.extent_norm = CONN_EXTENT_L2;
        options.hulls = CONN_HULLS_ALWAYS;
        return options;
    }
    conn_lists_options lists_options() const {
        conn_lists_options options = CONN_LISTS_OPTIONS_INIT;
        options.well_sep_is_n_away = params_.value("n_away", 1);
        options.from_sep_smaller_min_nsources_cumul = params_.value("minsrc", 0);
        if (!params_.contains("crit") || !params_["crit"].is_string()) return options;
        const auto crit = params_["crit"].get<std::string>();
        options.from_sep_smaller_crit = crit == "static_linf"    ? CONN_CRIT_STATIC_LINF
                                        : crit == "precise_linf" ? CONN_CRIT_PRECISE_LINF
                                                                 : CONN_CRIT_STATIC_L2;
        return options;
    }

    template <class T>
    void expect_same(const std::string& key, const T* ours, std::int64_t n) const {
        if (!file_.has(key)) return;
        ++n_compared_;
        const auto theirs = file_.read<int>(key);
        ASSERT_EQ(n, static_cast<std::int64_t>(theirs.size())) << key;
        for (std::int64_t k = 0; k < n; ++k)
            ASSERT_EQ(ours[k], static_cast<T>(theirs[static_cast<std::size_t>(k)])) << key << k;
    }
    /// A list under boxtree's name, which has none of those that are none here.
    void expect_list(const conn_lists* lists, const std::string& name, int which) const {
        const BoxRows ours(lists, which);
        if (ours->is_none) {
            EXPECT_FALSE(file_.has(name + "_starts")) << name;
            return;
        }
        expect_same(name + "_starts", ours->starts, ours->n_rows + 1);
        expect_same(name + "_lists", ours->lists, ours->n_entries);
    }
    void expect_base(const conn_lists* lists, const std::string& name, const std::string& starts,
                     int which) const {
        const BoxRows ours(lists, which);
        expect_same("trav_" + name, ours->lists, ours->n_entries);
        expect_same("trav_" + starts, ours->starts, ours->n_rows + 1);
    }

    PlainFile file_ = PlainFile::open(GetParam().string());
    nlohmann::json params_;
    mutable int n_compared_ = 0;  ///< arrays
    Context context_;
    Tree tree_{context_};
    TreeArrays boxes_;
};

TEST_P(CapiBoxtree, boxes_and_particle_orders_are_the_same) {
    const conn_tree_view& t = boxes_.view;
    expect_same("tree_level_start_box_nrs", t.level_start_box_nrs, t.n_levels + 1);
    expect_same("tree_box_parent_ids", t.box_parent_ids, t.n_boxes);
    expect_same("tree_box_child_ids", t.box_child_ids, (1 << t.dim) * t.aligned_n_boxes);
    expect_same("tree_box_levels", t.box_levels, t.n_boxes);
    expect_same("tree_box_flags", t.box_flags, t.n_boxes);
    expect_same("tree_user_source_ids", t.user_source_ids, t.n_sources);
    expect_same("tree_sorted_target_ids", t.sorted_target_ids, t.n_targets);
    expect_same("tree_box_source_starts", t.box_source_starts, t.n_boxes);
    expect_same("tree_box_source_counts_cumul", t.box_source_counts_cumul, t.n_boxes);
    expect_same("tree_box_target_starts", t.box_target_starts, t.n_boxes);
    expect_same("tree_box_target_counts_nonchild", t.box_target_counts_nonchild, t.n_boxes);
}

TEST_P(CapiBoxtree, interaction_lists_are_the_same) {
    if (!file_.has("trav_source_boxes")) GTEST_SKIP() << GetParam().stem() << " has a tree only";
    const InteractionLists built(context_, tree_, lists_options());
    const conn_lists* const lists = built.handle;
    expect_base(lists, "source_boxes", "level_start_source_box_nrs", CONN_LIST_SOURCE_BOXES);
    expect_base(lists, "target_boxes", "level_start_target_box_nrs", CONN_LIST_TARGET_BOXES);
    expect_base(lists, "source_parent_boxes", "level_start_source_parent_box_nrs",
                CONN_LIST_SOURCE_PARENT_BOXES);
    expect_base(lists, "target_or_target_parent_boxes",
                "level_start_target_or_target_parent_box_nrs",
                CONN_LIST_TARGET_OR_TARGET_PARENT_BOXES);
    expect_list(lists, "trav_same_level_non_well_sep_boxes",
                CONN_LIST_SAME_LEVEL_NON_WELL_SEP_BOXES);
    expect_list(lists, "trav_colleagues", CONN_LIST_COLLEAGUES);
    expect_list(lists, "trav_neighbor_source_boxes", CONN_LIST_NEIGHBOR_SOURCE_BOXES);
    expect_list(lists, "trav_from_sep_siblings", CONN_LIST_FROM_SEP_SIBLINGS);
    expect_list(lists, "trav_from_sep_close_smaller", CONN_LIST_FROM_SEP_CLOSE_SMALLER);
    expect_list(lists, "trav_from_sep_bigger", CONN_LIST_FROM_SEP_BIGGER);
    expect_list(lists, "trav_from_sep_close_bigger", CONN_LIST_FROM_SEP_CLOSE_BIGGER);
    for (int level = 0; level < boxes_->n_levels; ++level) {
        const BoxRows ours(lists, CONN_LIST_FROM_SEP_SMALLER, level);
        const std::string name = "trav_fss" + std::to_string(level);
        expect_same(name + "_starts", ours->starts, ours->n_rows + 1);
        expect_same(name + "_lists", ours->lists, ours->n_entries);
        expect_same(name + "_nonempty_indices", ours->nonempty_indices, ours->n_rows);
        expect_same(name + "_targets", ours->row_boxes, ours->n_rows);
    }
    const Classes translations(lists, CONN_CLASSES_TRANSLATION_PER_LEVEL),
        rotations(lists, CONN_CLASSES_ROTATION);
    expect_same("tc_classes", translations->classes, translations->n_entries);
    expect_same("tc_level_starts", translations->level_starts, translations->n_levels + 1);
    expect_same("rot_classes", rotations->classes, rotations->n_entries);
    ASSERT_TRUE(ok(conn_lists_merge_close(built.handle)));
    expect_list(lists, "merged_neighbor_source_boxes", CONN_LIST_NEIGHBOR_SOURCE_BOXES);
    EXPECT_GE(n_compared_, 18);
}

INSTANTIATE_TEST_SUITE_P(Files, CapiBoxtree, ::testing::ValuesIn(boxtree_files()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace connectivity::test
