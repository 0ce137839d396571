// SPDX-License-Identifier: BSD-3-Clause
/// Translation and rotation classes against boxtree's.

#include <connectivity/lists/classes.hpp>

#include "lists/oracle_case.hpp"

namespace connectivity::test {
namespace {

class OracleClasses : public Oracle {};

/// boxtree has room for all codes and fills the first columns, and says the number of classes is
/// the dimension; the right number is the last level start.
void expect_vectors(const OracleCase& oracle, const std::string& name,
                    const TranslationClassesInfo& ours) {
    const auto theirs = oracle.doubles(name);
    const Offset n = ours.nfrom_sep_siblings_translation_classes();
    const auto columns = static_cast<Offset>(oracle.extents(name).at(1));
    ASSERT_GE(columns, n);
    const double tolerance = oracle.tree().coordinates == CoordinateType::float32 ? 1e-6 : 1e-13;
    const auto vectors = ours.from_sep_siblings_translation_class_to_distance_vector();
    ASSERT_EQ(static_cast<Offset>(vectors.size()), n * oracle.tree().dim);
    for (int k = 0; k < oracle.tree().dim; ++k)
        for (Offset c = 0; c < n; ++c) {
            const double value = theirs[static_cast<std::size_t>(k * columns + c)];
            ASSERT_NEAR(vectors(k * n + c), value, tolerance * std::abs(value)) << name << c;
        }
}

TEST_P(OracleClasses, translation_classes_by_level_are_boxtrees_with_the_right_count) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has("tc_classes")) GTEST_SKIP() << GetParam() << " has no classes";
    const FMMTraversalInfo lists(oracle.tree(), oracle.options());
    const TranslationClassesInfo ours(lists);
    expect_equal("tc_classes", ours.from_sep_siblings_translation_classes(),
                 oracle.ints("tc_classes"));
    expect_equal("tc_level_starts", ours.from_sep_siblings_translation_classes_level_starts(),
                 oracle.ints("tc_level_starts"));
    EXPECT_EQ(ours.nfrom_sep_siblings_translation_classes(), oracle.ints("tc_level_starts").back());
    expect_vectors(oracle, "tc_distance_vectors", ours);
}

TEST_P(OracleClasses, translation_classes_without_levels_are_boxtrees_with_the_right_count) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has("tcall_classes")) GTEST_SKIP() << GetParam() << " has no classes";
    const FMMTraversalInfo lists(oracle.tree(), oracle.options());
    const TranslationClassesInfo ours(lists, false);
    expect_equal("tcall_classes", ours.from_sep_siblings_translation_classes(),
                 oracle.ints("tcall_classes"));
    const auto starts = ours.from_sep_siblings_translation_classes_level_starts();
    ASSERT_EQ(static_cast<Offset>(starts.size()), lists.nlevels() + 1);
    EXPECT_EQ(starts(0), 0);
    EXPECT_EQ(starts(lists.nlevels()), oracle.ints("tcall_level_starts").back());
    expect_vectors(oracle, "tcall_distance_vectors", ours);
}

TEST_P(OracleClasses, rotation_classes_are_boxtrees) {
    if (path().empty()) GTEST_SKIP() << GetParam() << ": shared oracle data are not here";
    const OracleCase oracle(path());
    if (!oracle.has("rot_classes")) GTEST_SKIP() << GetParam() << " has no classes";
    const RotationClassesInfo ours(FMMTraversalInfo(oracle.tree(), oracle.options()));
    expect_equal("rot_classes", ours.from_sep_siblings_rotation_classes(),
                 oracle.ints("rot_classes"));
    const auto angles = oracle.doubles("rot_class_to_angle");
    ASSERT_EQ(static_cast<std::size_t>(ours.nfrom_sep_siblings_rotation_classes()), angles.size());
    const double tolerance = oracle.tree().coordinates == CoordinateType::float32 ? 1e-6 : 1e-13;
    for (std::size_t c = 0; c < angles.size(); ++c)
        EXPECT_NEAR(ours.from_sep_siblings_rotation_class_to_angle()(c), angles[c],
                    tolerance * std::max(1.0, angles[c]));
}

INSTANTIATE_TEST_SUITE_P(boxtree, OracleClasses, ::testing::ValuesIn(oracle_names),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace connectivity::test
