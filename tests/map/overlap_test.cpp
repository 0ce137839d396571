// SPDX-License-Identifier: BSD-3-Clause
// Overlap rows equal their definition, whatever numbers the nodes have and in whatever order they
// are worked on.

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/random.hpp>
#include <support/random_case.hpp>

#include "map/overlap.hpp"

#include "label_case.hpp"

namespace connectivity::test {
namespace {

/// Rows of a list by slot, segment after segment.
SlotRows segments(const Csr& csr) {
    SlotRows rows;
    for (Offset k = 0; k < csr.n_rows(); ++k)
        rows.emplace_back(csr.values().data() + csr.offsets()(k),
                          csr.values().data() + csr.offsets()(k + 1));
    return rows;
}

/// What the segments must be: rows cut by list, each list ascending by label.
SlotRows expected(const LabelCase& c) {
    SlotRows rows;
    for (const std::vector<Slot>& row : c.sight().overlap())
        for (int l = 0; l < c.layout().n_lists(); ++l) {
            std::vector<Slot> segment;
            for (const Slot b : row)
                if (c.layout().list_of_slot(b) == l) segment.push_back(b);
            rows.push_back(c.by_label(segment));
        }
    return rows;
}

class Overlap : public ::testing::Test {
protected:
    Overlap() { start_runtime(); }

    void build(const LabelCase& c, const Slot* order = nullptr) {
        const OwnedRows gather = c.gather(), scatter = c.scatter();
        const Labels labels = c.labels();
        const OverlapInput input{gather.view(), scatter.view(), labels, order};
        const Offset bytes = build_.prepare(input, rows_);
        rows_.reserve();
        build_.commit(rows_);
        EXPECT_EQ(bytes, rows_.n_values() * 4 + (rows_.n_rows() + 1) * 8);
    }

    /// One builder for all cases, so that the memory of every build serves the next one.
    OverlapBuild build_;
    Csr rows_;
};

TEST_F(Overlap, rows_of_random_cases_equal_the_definition) {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const Case source = all_rows_case(seed, static_cast<int>(seed % 3) + 1, seed % 2 == 1, 120);
        const LabelCase c(source, seed % 4 < 2 ? Numbering::by_slot : Numbering::at_random, random);
        const std::vector<Slot> order = c.random_order(random);
        build(c, seed % 5 < 2 ? order.data() : nullptr);
        ASSERT_EQ(segments(rows_), expected(c)) << source.text;
    }
}

TEST_F(Overlap, rows_of_larger_cases_equal_the_definition) {
    for (std::uint64_t seed = 9000; seed < 9012; ++seed) {
        Random random(seed);
        Case source = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 1500, 700});
        source.mode = SearchMode::gather_scatter;
        const LabelCase c(source, Numbering::at_random, random);
        const std::vector<Slot> order = c.random_order(random);
        build(c, seed % 2 == 0 ? order.data() : nullptr);
        ASSERT_EQ(segments(rows_), expected(c)) << source.text;
    }
}

TEST_F(Overlap, a_shared_witness_counts_and_mere_geometry_does_not) {
    // Supports of 0 and 2 overlap, but only with node 1 between them is there a witness.
    Random random(1);
    const LabelCase with(uniform_case(1, {0, 1, 2}, 0.5), Numbering::by_slot, random);
    build(with);
    EXPECT_EQ(segments(rows_), (SlotRows{{1, 2}, {0, 2}, {0, 1}}));
    const LabelCase without(uniform_case(1, {0, 2, 2}, 0.9), Numbering::by_slot, random);
    build(without);
    EXPECT_EQ(segments(rows_), (SlotRows{{}, {2}, {1}}));
}

TEST_F(Overlap, a_node_that_sees_nobody_still_overlaps_those_that_see_it) {
    Random random(1);
    const LabelCase c(scalar_case(1, {0, 1, 2}, {1, 0, 1}, 1), Numbering::by_slot, random);
    build(c);
    EXPECT_EQ(segments(rows_), (SlotRows{{1, 2}, {0, 2}, {0, 1}}));
}

TEST_F(Overlap, one_node_that_sees_everybody_makes_all_rows_name_it) {
    Random random(3);
    Case source = cloud(3000, 5, 0.01);
    source.lists[0].h[77] = 10;
    const LabelCase c(source, Numbering::by_slot, random);
    build(c);
    EXPECT_EQ(segments(rows_), expected(c));
    EXPECT_EQ(segments(rows_)[77].size(), 2999u);
}

TEST_F(Overlap, no_nodes_have_no_rows) {
    Random random(1);
    const LabelCase c(uniform_case(3, {}, 1), Numbering::by_slot, random);
    build(c);
    EXPECT_EQ(rows_.n_rows(), 0);
    EXPECT_EQ(rows_.n_values(), 0);
}

TEST_F(Overlap, until_commit_the_old_rows_stay) {
    Random random(1);
    const LabelCase first(cloud(200, 1, 0.1), Numbering::by_slot, random),
        second(cloud(900, 2, 0.1), Numbering::by_slot, random);
    build(first);
    const SlotRows before = segments(rows_);
    const OwnedRows gather = second.gather(), scatter = second.scatter();
    const Labels labels = second.labels();
    build_.prepare({gather.view(), scatter.view(), labels}, rows_);
    rows_.reserve();
    EXPECT_EQ(segments(rows_), before);
    build_.commit(rows_);
    EXPECT_EQ(segments(rows_), expected(second));
}

}  // namespace
}  // namespace connectivity::test
