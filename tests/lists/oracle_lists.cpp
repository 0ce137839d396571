// SPDX-License-Identifier: BSD-3-Clause
/// Lists against boxtree's own, entry by entry, order included.

#include "lists/oracle_case.hpp"

namespace connectivity::test {
namespace {

class OracleLists : public Oracle {};

void expect_list(const OracleCase& oracle, const std::string& name,
                 const std::optional<BoxList>& ours) {
    ASSERT_EQ(ours.has_value(), oracle.has(name + "_starts")) << name;
    if (!ours) return;
    expect_equal(name + "_starts", ours->starts, oracle.ints(name + "_starts"));
    expect_equal(name + "_lists", ours->lists, oracle.ints(name + "_lists"));
}

TEST_P(OracleLists, base_lists_and_level_starts_are_boxtrees) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has_lists()) GTEST_SKIP() << GetParam() << " has a tree only";
    const FMMTraversalInfo ours(oracle.tree(), oracle.options());
    const auto same = [&](const std::string& name, const auto& values) {
        expect_equal(name, values, oracle.ints("trav_" + name));
    };
    same("source_boxes", ours.source_boxes());
    same("target_boxes", ours.target_boxes());
    same("source_parent_boxes", ours.source_parent_boxes());
    same("target_or_target_parent_boxes", ours.target_or_target_parent_boxes());
    same("level_start_source_box_nrs", ours.level_start_source_box_nrs());
    same("level_start_target_box_nrs", ours.level_start_target_box_nrs());
    same("level_start_source_parent_box_nrs", ours.level_start_source_parent_box_nrs());
    same("level_start_target_or_target_parent_box_nrs",
         ours.level_start_target_or_target_parent_box_nrs());
}

TEST_P(OracleLists, lists_1_to_4_and_close_lists_are_boxtrees) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has_lists()) GTEST_SKIP() << GetParam() << " has a tree only";
    const FMMTraversalInfo ours(oracle.tree(), oracle.options());
    if (oracle.has("trav_same_level_non_well_sep_boxes_starts"))  // a1 lacks some
        expect_list(oracle, "trav_same_level_non_well_sep_boxes",
                    ours.same_level_non_well_sep_boxes());
    expect_list(oracle, "trav_neighbor_source_boxes", ours.neighbor_source_boxes());
    expect_list(oracle, "trav_from_sep_siblings", ours.from_sep_siblings());
    expect_list(oracle, "trav_from_sep_close_smaller", ours.from_sep_close_smaller());
    expect_list(oracle, "trav_from_sep_bigger", ours.from_sep_bigger());
    expect_list(oracle, "trav_from_sep_close_bigger", ours.from_sep_close_bigger());
}

TEST_P(OracleLists, list_3_of_every_source_level_is_boxtrees) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has_lists()) GTEST_SKIP() << GetParam() << " has a tree only";
    const FMMTraversalInfo ours(oracle.tree(), oracle.options());
    for (int level = 0; level < ours.nlevels(); ++level) {
        const std::string name = "trav_fss" + std::to_string(level) + "_";
        const LevelBoxList list = ours.from_sep_smaller(level);
        expect_equal(name + "starts", list.starts, oracle.ints(name + "starts"));
        expect_equal(name + "lists", list.lists, oracle.ints(name + "lists"));
        expect_equal(name + "nonempty_indices", list.nonempty_indices,
                     oracle.ints(name + "nonempty_indices"));
        expect_equal(name + "targets", list.target_boxes_sep_smaller,
                     oracle.ints(name + "targets"));
        const auto scalars = oracle.ints(name + "scalars");
        EXPECT_EQ(list.count(), scalars.at(0)) << name;
        EXPECT_EQ(list.num_nonempty_lists(), scalars.at(1)) << name;
    }
}

TEST_P(OracleLists, merged_close_lists_are_boxtrees) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has_lists()) GTEST_SKIP() << GetParam() << " has a tree only";
    const FMMTraversalInfo ours =
        FMMTraversalInfo(oracle.tree(), oracle.options()).merge_close_lists();
    EXPECT_FALSE(ours.from_sep_close_smaller() || ours.from_sep_close_bigger());
    // boxtree fails to merge where it has no close lists: list 1 stays as it is.
    const std::string name =
        oracle.tree().have_extent() ? "merged_neighbor_source_boxes" : "trav_neighbor_source_boxes";
    expect_list(oracle, name, ours.neighbor_source_boxes());
}

INSTANTIATE_TEST_SUITE_P(boxtree, OracleLists, ::testing::ValuesIn(oracle_names),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace connectivity::test
