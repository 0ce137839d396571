// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// boxtree's own answers: trees as it built them, and every array of its traversals, in HDF5 files.
/// Some lie in the repository, all of them in the shared data.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <connectivity/base/runtime.hpp>
#include <connectivity/lists/traversal.hpp>

#include "io/plain_hdf5.hpp"
#include "support/shared_data.hpp"

namespace connectivity::test {

inline const std::vector<std::string> oracle_names = {"a1_2d",
                                                      "a3_linked",
                                                      "c01_2d_uniform",
                                                      "c02_3d_uniform",
                                                      "c03_2d_normal_st",
                                                      "c05_2d_ring_n2",
                                                      "c06_3d_torus_lr",
                                                      "c07_2d_clusters",
                                                      "c09_2d_text_linf_slinf",
                                                      "c10_2d_text_linf_plinf",
                                                      "c11_2d_text_linf_sl2",
                                                      "c12_2d_text_l2_sl2",
                                                      "c14_3d_text_linf_slinf",
                                                      "c15_3d_text_l2_plinf_n2",
                                                      "c18_2d_srcext_treeonly",
                                                      "c19_3d_srcext_treeonly_l2",
                                                      "c20_2d_nonadaptive",
                                                      "c21_3d_nonadaptive_st",
                                                      "c23_2d_disjoint_st",
                                                      "c24_2d_singlebox",
                                                      "c25_3d_twolevel",
                                                      "c26_2d_weights",
                                                      "c27_2d_gridedge",
                                                      "c29_3d_plummer_5000",
                                                      "c30_2d_ring_f32",
                                                      "c32_2d_n3",
                                                      "c34_2d_text_sof0",
                                                      "c36_2d_text_nonad"};

/// Where the file lies; empty where it does not.
inline std::string oracle_path(const std::string& name) {
    for (const std::string& path :
         {shared_data("oracle/boxtree/" + name + ".h5"),
          std::string(CONNECTIVITY_SOURCE_DIR "/tests/support/data/boxtree/") + name + ".h5"})
        if (std::filesystem::exists(path)) return path;
    return {};
}

class OracleCase {
public:
    explicit OracleCase(const std::string& path) : file_(PlainFile::open(path)) {
        start_runtime();
        try {
            params_ = nlohmann::json::parse(file_.strings("/", "params").at(0));
        } catch (const std::runtime_error&) {  // a3 has none
        }
        if (has("trav_source_boxes") || has("tree_box_flags")) read_tree();
    }

    bool has(const std::string& name) const { return file_.has(name); }
    bool has_lists() const { return has("trav_source_boxes"); }
    std::vector<int> ints(const std::string& name) const { return file_.read<int>(name); }
    std::vector<double> doubles(const std::string& name) const { return file_.read<double>(name); }
    Extents extents(const std::string& name) const { return file_.extents(name); }
    const TreeView& tree() const { return tree_; }

    TraversalOptions options() const {
        TraversalOptions options;
        options.well_sep_is_n_away = params_.value("n_away", 1);
        options.from_sep_smaller_min_nsources_cumul = params_.value("minsrc", 0);
        if (params_.contains("crit") && params_["crit"].is_string())
            options.from_sep_smaller_crit =
                from_sep_smaller_crit_named(params_["crit"].get<std::string>());
        return options;
    }

private:
    template <class T, class File = T>
    View<T> array(const std::string& name) const {
        if (!has(name)) return {};
        const auto values = file_.read<File>(name);
        auto view = allocate<T>(name, static_cast<Offset>(values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) view(i) = static_cast<T>(values[i]);
        return view;
    }

    TreeParticles particles(const std::string& kind) const {
        TreeParticles p;
        p.positions = array<double>("tree_" + kind + "s");
        p.n = static_cast<Offset>(p.positions.size()) / tree_.dim;
        p.radii = array<double>("tree_" + kind + "_radii");
        p.box_starts = array<int>("tree_box_" + kind + "_starts");
        p.box_counts_nonchild = array<int>("tree_box_" + kind + "_counts_nonchild");
        p.box_counts_cumul = array<int>("tree_box_" + kind + "_counts_cumul");
        p.bounding_box_min = array<double>("trav_box_" + kind + "_bounding_box_min");
        p.bounding_box_max = array<double>("trav_box_" + kind + "_bounding_box_max");
        return p;
    }

    void read_tree() {
        tree_.dim = params_.at("d");
        if (params_.value("f32", false)) tree_.coordinates = CoordinateType::float32;
        tree_.sources_are_targets = !has("in_targets");
        tree_.root_extent = doubles("tree_root_extent").at(0);
        tree_.stick_out_factor = params_.value("sof", 0.0);
        tree_.n_levels = ints("tree_nlevels").at(0);
        tree_.n_boxes = ints("tree_nboxes").at(0);
        tree_.aligned_n_boxes = ints("tree_aligned_nboxes").at(0);
        tree_.level_start_box_nrs = array<BoxId>("tree_level_start_box_nrs");
        tree_.box_parent_ids = array<BoxId>("tree_box_parent_ids");
        tree_.box_child_ids = array<BoxId>("tree_box_child_ids");
        tree_.box_centers = array<double>("tree_box_centers");
        tree_.box_levels = array<std::uint8_t, int>("tree_box_levels");
        tree_.box_flags = array<std::uint8_t, int>("tree_box_flags");
        tree_.sources = particles("source");
        tree_.targets = particles("target");
        if (tree_.have_extent())
            tree_.extent_norm = params_.value("norm", std::string("linf")) == "l2"
                                    ? ExtentNorm::l2
                                    : ExtentNorm::linf;
    }

    PlainFile file_;
    nlohmann::json params_ = nlohmann::json::object();
    TreeView tree_;
};

template <class T>
void expect_equal(const std::string& name, const ConstView<T>& ours,
                  const std::vector<int>& theirs) {
    ASSERT_EQ(static_cast<std::size_t>(ours.size()), theirs.size()) << name;
    for (std::size_t i = 0; i < theirs.size(); ++i)
        ASSERT_EQ(static_cast<Offset>(ours(i)), theirs[i]) << name << "[" << i << "]";
}

/// One test for every file, skipped where it is absent.
class Oracle : public ::testing::TestWithParam<std::string> {
protected:
    std::string path() const { return oracle_path(GetParam()); }
};

}  // namespace connectivity::test
