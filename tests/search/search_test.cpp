// SPDX-License-Identifier: BSD-3-Clause
// The searcher by itself: every method fills the same lists, only those asked for, and keeps them
// on failure.

#include <gtest/gtest.h>

#include <support/expect_error.hpp>

#include "search_problem.hpp"

namespace connectivity::test {
namespace {

constexpr SearchMethod methods[] = {SearchMethod::brute, SearchMethod::cells, SearchMethod::groups,
                                    SearchMethod::device};

TEST(Searcher, every_method_fills_rows_and_half_rows) {
    Search<3> search;
    Csr rows, halves;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Problem p = random_problem(seed);
        for (const SearchMethod method : methods) {
            Report report;
            search.run(p.nodes, p.layout, {true, true, SearchMode::gather_scatter, method, {}},
                       rows, halves, report);
            ASSERT_TRUE(filled(rows, halves, p)) << name_of(method) << ", " << p.c.text;
        }
    }
}

TEST(Searcher, what_is_not_asked_for_is_cleared) {
    const Problem p = random_problem(3);
    Search<3> search;
    for (const SearchMethod method : methods) {
        Csr rows, halves;
        Report report;
        const auto run = [&](bool want_rows, bool want_halves) {
            search.run(p.nodes, p.layout,
                       {want_rows, want_halves, SearchMode::gather_scatter, method, {}}, rows,
                       halves, report);
        };
        run(true, true);
        run(true, false);
        EXPECT_GT(rows.n_rows(), 0);
        EXPECT_EQ(halves.bytes(), 0);
        run(false, true);
        EXPECT_EQ(rows.bytes(), 0);
        EXPECT_EQ(halves.n_values(), static_cast<Offset>(p.expected.pair_j.size()));
        run(false, false);
        EXPECT_EQ(rows.bytes() + halves.bytes(), 0);
    }
}

TEST(Searcher, a_search_over_budget_leaves_both_lists_as_they_were) {
    const Problem first = random_problem(4), second = random_problem(8, 3000);
    for (const SearchMethod method : methods) {
        Search<3> search;
        Csr rows, halves;
        Report report;
        SearchRequest request{true, true, SearchMode::gather_scatter, method, {}};
        search.run(first.nodes, first.layout, request, rows, halves, report);
        request.budget.bytes = 64;
        EXPECT_TRUE(fails_with(Status::budget, {"64"}, [&] {
            search.run(second.nodes, second.layout, request, rows, halves, report);
        }));
        EXPECT_TRUE(filled(rows, halves, first)) << name_of(method);
        request.budget.bytes = 0;
        search.run(second.nodes, second.layout, request, rows, halves, report);
        EXPECT_TRUE(filled(rows, halves, second)) << name_of(method);
    }
}

TEST(Searcher, the_budget_counts_what_is_built_and_no_more) {
    const Problem p = random_problem(6, 3000);
    const auto rows_bytes = static_cast<Offset>(p.expected.row_slots.size() * sizeof(Slot) +
                                                p.expected.row_offsets.size() * sizeof(Offset));
    for (const SearchMethod method : methods) {
        Search<3> search;
        Csr rows, halves;
        Report report;
        SearchRequest request{true, false, SearchMode::gather_scatter, method, {}};
        request.budget.bytes = 3 * rows_bytes;
        EXPECT_NO_THROW(search.run(p.nodes, p.layout, request, rows, halves, report))
            << name_of(method);
        request.budget.bytes = rows_bytes - 64;
        EXPECT_TRUE(fails_with(Status::budget, {}, [&] {
            search.run(p.nodes, p.layout, request, rows, halves, report);
        })) << name_of(method);
    }
}

TEST(Searcher, the_chosen_method_and_its_reason_stand_in_the_report) {
    const Problem p = random_problem(5);
    for (const SearchMethod method : all_methods) {
        Search<3> search;
        Csr rows, halves;
        Report report;
        search.run(p.nodes, p.layout, {true, true, SearchMode::gather_scatter, method, {}}, rows,
                   halves, report);
        ASSERT_NE(report.find("rows"), nullptr);
        const std::string& reason = report.find("rows")->reason;
        EXPECT_FALSE(reason.empty());
        EXPECT_TRUE(method == SearchMethod::automatic || reason.find(name_of(method)) == 0)
            << reason;
    }
}

}  // namespace
}  // namespace connectivity::test
