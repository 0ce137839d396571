// SPDX-License-Identifier: BSD-3-Clause
// `connectivity pairs` with --overlap, --intersection, --order and --cull: the result file holds
// what the definitions say.

#include <gtest/gtest.h>

#include <support/brute_overlap.hpp>
#include <support/key_order.hpp>
#include <support/random_case.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

class ResultOfFlags : public ::testing::Test {
protected:
    /// Runs a case; the result is at result().
    void run(const Case& c, const std::vector<std::string>& flags) {
        write_case(folder_ / "in.h5", c);
        std::vector<std::string> arguments{"pairs", folder_ / "in.h5", "--out", result()};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        const auto outcome = run_program(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err << c.text;
    }
    std::string result() const { return folder_ / "out.h5"; }

    static Case any_case(std::uint64_t seed) {
        Case c = random_case(seed, {.dim = static_cast<int>(seed % 3) + 1,
                                    .periodic = seed % 2 == 0,
                                    .max_nodes = 70,
                                    .min_nodes = 1});
        c.mode = SearchMode::gather_scatter;
        return c;
    }

private:
    TemporaryFolder folder_;
};

int list_of(const Case& c, Slot slot) {
    int list = 0;
    Offset end = c.n(0);
    while (slot >= end) end += c.n(static_cast<std::size_t>(++list));
    return list;
}

TEST_F(ResultOfFlags, overlap_rows_are_all_nodes_with_a_common_witness) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Case c = any_case(seed);
        run(c, {"--overlap"});
        c.ghost_rows = true;
        expect_result(result(), brute_force(c));
        std::vector<std::int64_t> offsets{0};
        std::vector<int> slots;
        for (const auto& row : Sight(c).overlap())
            for (int l = 0; l < static_cast<int>(c.lists.size()); ++l) {
                for (const Slot j : row)
                    if (list_of(c, j) == l) slots.push_back(j);
                offsets.push_back(static_cast<std::int64_t>(slots.size()));
            }
        const auto file = PlainFile::open(result());
        EXPECT_EQ(file.read<std::int64_t>("overlap/offsets"), offsets) << c.text;
        EXPECT_EQ(file.read<int>("overlap/slots"), slots) << c.text;
        EXPECT_FALSE(file.has("intersection"));
        EXPECT_FALSE(file.has("order"));
        EXPECT_FALSE(file.has("cull"));
    }
}

TEST_F(ResultOfFlags, intersections_are_filtered_or_not) {
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
        Case c = any_case(seed);
        const bool filtered = seed % 3 != 0;
        run(c, {seed % 3 == 0   ? "--intersection=unfiltered"
                : seed % 3 == 1 ? "--intersection=filtered"
                                : "--intersection"});
        c.ghost_rows = true;
        const Expected e = brute_force(c);
        expect_result(result(), e);
        const Sight sight(c);
        std::vector<std::int64_t> offsets{0};
        std::vector<int> slots;
        for (Slot i = 0; i < sight.n(); ++i)
            for (Offset p = e.pair_offsets[static_cast<std::size_t>(i)];
                 p < e.pair_offsets[static_cast<std::size_t>(i) + 1]; ++p) {
                const Slot j = e.pair_j[static_cast<std::size_t>(p)];
                for (const Slot k : sight.intersection(i, j))
                    if (!filtered || k == i || k == j || is_in_segment(c, i, j, k))
                        slots.push_back(k);
                offsets.push_back(static_cast<std::int64_t>(slots.size()));
            }
        const auto file = PlainFile::open(result());
        EXPECT_EQ(file.read<std::int64_t>("intersection/offsets"), offsets) << c.text;
        EXPECT_EQ(file.read<int>("intersection/slots"), slots) << c.text;
        EXPECT_EQ(file.numbers<std::int64_t>("/intersection", "filtered"),
                  std::vector<std::int64_t>{filtered});
    }
}

TEST_F(ResultOfFlags, key_order_sorts_rows_and_pairs_by_rank) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Case c = any_case(seed);
        run(c, {"--order", "key"});
        c.ghost_rows = true;
        const ExpectedOrder order = key_order_of(c);
        const Expected want = in_key_order(brute_force(c), order);
        const auto file = PlainFile::open(result());
        EXPECT_EQ(file.read<int>("order/slots"), order.slots) << c.text;
        EXPECT_EQ(file.read<std::uint64_t>("order/keys"), order.keys) << c.text;
        EXPECT_EQ(file.read<int>("rows/slots"), want.row_slots) << c.text;
        EXPECT_EQ(file.read<int>("pairs/j"), want.pair_j) << c.text;
        std::vector<int> i;
        for (std::size_t r = 0; r + 1 < want.pair_offsets.size(); ++r)
            i.resize(static_cast<std::size_t>(want.pair_offsets[r + 1]), order.slots[r]);
        EXPECT_EQ(file.read<int>("pairs/i"), i) << c.text;
    }
}

/// Only nodes that stand in a row of an internal node, or are internal, stay.
TEST_F(ResultOfFlags, culling_leaves_what_internal_nodes_interact_with) {
    int n_dropped = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Case c = any_case(seed);
        run(c, {"--cull"});
        const Sight sight(c);
        std::vector<int> old2new;
        Case left = c;
        Slot slot = 0, next = 0;
        for (std::size_t l = 0; l < c.lists.size(); ++l) {
            ListData& list = left.lists[l];
            const auto dim = static_cast<std::size_t>(c.dim);
            const std::size_t n_H =
                c.lists[l].tensor ? static_cast<std::size_t>(n_symmetric(c.dim)) : 0;
            list.x.clear(), list.h.clear(), list.H.clear();
            for (Offset a = 0; a < c.n(l); ++a, ++slot) {
                bool stays = a < c.lists[l].n_internal;
                Slot other = 0;
                for (std::size_t m = 0; m < c.lists.size(); ++m)
                    for (Offset b = 0; b < c.n(m); ++b, ++other)
                        stays =
                            stays || (b < c.lists[m].n_internal && sight.neighbours(slot, other));
                old2new.push_back(stays ? next++ : -1);
                n_dropped += !stays;
                if (!stays) continue;
                const auto at = static_cast<std::size_t>(a);
                for (std::size_t d = 0; d < dim; ++d) list.x.push_back(c.lists[l].x[at * dim + d]);
                if (!c.lists[l].tensor) list.h.push_back(c.lists[l].h[at]);
                for (std::size_t d = 0; d < n_H; ++d) list.H.push_back(c.lists[l].H[at * n_H + d]);
            }
        }
        EXPECT_EQ(PlainFile::open(result()).read<int>("cull/old2new"), old2new) << c.text;
        left.ghost_rows = false;
        expect_result(result(), brute_force(left));
    }
    EXPECT_GT(n_dropped, 0);
}

}  // namespace
}  // namespace connectivity::test
