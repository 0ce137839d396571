// SPDX-License-Identifier: BSD-3-Clause
// The report, the budget and readable byte counts.

#include <gtest/gtest.h>

#include <connectivity/base/budget.hpp>
#include <connectivity/base/report.hpp>

namespace connectivity::test {
namespace {

TEST(ReportTable, an_entry_is_made_on_first_use_with_zeros) {
    Report report;
    EXPECT_EQ(report.find("rows"), nullptr);
    EXPECT_EQ(report.entry("rows").bytes, 0);
    EXPECT_EQ(report.entry("rows").ms, 0);
    EXPECT_FALSE(report.entry("rows").built);
    ASSERT_NE(report.find("rows"), nullptr);
    EXPECT_EQ(report.entries().size(), 1u);
}

TEST(ReportTable, entries_keep_their_order_and_bytes_add_up) {
    Report report;
    report.entry("rows").bytes = 100;
    report.entry("pairs").bytes = 20;
    report.entry("rows").bytes += 5;
    EXPECT_EQ(report.total_bytes(), 125);
    EXPECT_EQ(report.entries()[0].product, "rows");
    EXPECT_EQ(report.entries()[1].product, "pairs");
}

TEST(ReportTable, counters_start_at_zero) {
    Report report;
    EXPECT_EQ(report.count("coincident_pairs"), 0);
    ++report.counter("coincident_pairs");
    ++report.counter("coincident_pairs");
    EXPECT_EQ(report.count("coincident_pairs"), 2);
    EXPECT_EQ(report.counters().size(), 1u);
}

TEST(ReportTable, the_text_has_a_line_for_each_product_and_counter) {
    Report report;
    report.entry("rows") = {"rows", "caller", "groups: 1000 nodes", true, false, 2048, 1.5};
    report.entry("pairs") = {};
    report.entry("pairs").product = "pairs";
    report.counter("coincident_pairs") = 3;
    const std::string text = report.text();
    for (const char* word : {"rows", "caller", "groups: 1000 nodes", "2.0 KiB", "1.50", "pairs",
                             "nobody", "coincident_pairs = 3"})
        EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
}

TEST(MemoryBudget, a_stated_number_holds_and_zero_means_part_of_what_is_free) {
    EXPECT_EQ(Budget{12345}.allowed(), 12345);
    const Offset free = available_memory();
    if (free == 0) GTEST_SKIP() << "this system does not tell how much memory is free";
    EXPECT_GT(Budget{}.allowed(), free / 2);
    EXPECT_LT(Budget{}.allowed(), free);
}

TEST(Bytes, are_written_for_people) {
    EXPECT_EQ(human_bytes(0), "0 B");
    EXPECT_EQ(human_bytes(1023), "1023 B");
    EXPECT_EQ(human_bytes(1024), "1.0 KiB");
    EXPECT_EQ(human_bytes(1536), "1.5 KiB");
    EXPECT_EQ(human_bytes(Offset{5} << 30), "5.0 GiB");
    EXPECT_EQ(human_bytes(Offset{1} << 62), "4.0 EiB");
}

TEST(StopwatchTime, never_runs_backwards) {
    const Stopwatch watch;
    const double first = watch.ms();
    EXPECT_GE(first, 0);
    EXPECT_GE(watch.ms(), first);
}

}  // namespace
}  // namespace connectivity::test
