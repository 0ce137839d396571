// SPDX-License-Identifier: BSD-3-Clause
// `connectivity pairs` on node files: what stands in the result file is what brute force finds.
#include <fstream>

#include <gtest/gtest.h>

#include <support/random_case.hpp>
#include <support/reference_cases.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

using nlohmann::json;

const char* const methods[] = {"automatic", "brute", "cells", "groups", "device"};

/// Runs a case and compares; `more` are further arguments.
void expect_brute_force(const Case& c, std::vector<std::string> more) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    std::vector<std::string> arguments{"pairs", folder / "in.h5", "--out", folder / "out.h5"};
    if (c.ghost_rows) arguments.push_back("--ghost-rows");
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = run_program(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err << c.text;
    EXPECT_EQ(outcome.err, "");
    SCOPED_TRACE(c.text);
    expect_result(folder / "out.h5", brute_force(c));
}

TEST(ResultOfPairs, equals_brute_force_in_every_dimension) {
    for (int dim = 1; dim <= 3; ++dim)
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            Case c = random_case(seed, {.dim = dim, .periodic = seed % 2 == 0, .min_nodes = 1});
            c.mode = SearchMode::gather_scatter;
            expect_brute_force(c,
                               {"--method", methods[seed % 5], "--threads", seed % 3 ? "2" : "1"});
        }
}

TEST(ResultOfPairs, open_ignores_the_box) {
    Case c = uniform_case(1, {0.1, 0.9}, 0.1);
    c.domain.periodic[0] = true;
    c.domain.hi[0] = 1;
    ASSERT_EQ(brute_force(c).pair_j.size(), 1u);
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    ASSERT_EQ(run_program({"pairs", folder / "in.h5", "--open", "--out", folder / "out.h5"}).status,
              0);
    c.domain = {};
    expect_result(folder / "out.h5", brute_force(c));
}

TEST(ResultOfPairs, extent_replaces_that_of_the_file) {
    Case c = uniform_case(1, {0, 1, 2, 3.5}, 0.5, 1);
    ASSERT_EQ(brute_force(c).pair_j.size(), 0u);
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    ASSERT_EQ(run_program({"pairs", folder / "in.h5", "--extent", "3", "--out", folder / "out.h5"})
                  .status,
              0);
    c.lists[0].extent = 3;
    expect_result(folder / "out.h5", brute_force(c));
}

TEST(ResultOfPairs, list_order_is_the_order_given) {
    Case c = uniform_case(1, {0, 1}, 0.5);
    c.lists[0].name = "a";
    c.lists.push_back(c.lists[0]);
    c.lists[1].name = "b";
    c.lists[1].x = {0.5};
    c.lists[1].h = {0.5};
    c.lists[1].n_internal = 1;
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    ASSERT_EQ(run_program({"pairs", "--list", "b", "--list", "a", folder / "in.h5", "--out",
                           folder / "out.h5"})
                  .status,
              0);
    EXPECT_EQ(PlainFile::open(folder / "out.h5").strings("/", "list_names"),
              (std::vector<std::string>{"b", "a"}));
    std::swap(c.lists[0], c.lists[1]);
    expect_result(folder / "out.h5", brute_force(c));
}

TEST(ResultOfPairs, command_is_kept_in_the_file) {
    const TemporaryFolder folder;
    write_case(folder / "with space.h5", uniform_case(1, {0, 1}, 0.5));
    ASSERT_EQ(run_program({"pairs", folder / "with space.h5", "--out", folder / "out.h5"}).status,
              0);
    EXPECT_EQ(PlainFile::open(folder / "out.h5").strings("/", "command")[0],
              "connectivity pairs '" + folder / "with space.h5" + "' --out " + folder / "out.h5");
}

/// Rows and pairs of a case as the reference has them, in slots.
Expected expected_of(const json& source) {
    const auto offsets = source["offsets"].get<std::vector<Offset>>();
    const auto stored = source["numStored"].get<std::vector<Offset>>();
    Expected e;
    e.list_offset = e.row_offset = e.row_offsets = {0};
    for (std::size_t k = 0; k < stored.size(); ++k) {
        e.list_offset.push_back(offsets[k] + stored[k]);  // no ghosts in these cases
        e.row_offset.push_back(e.row_offset.back() + stored[k]);
        for (const json& row : source["neighbors"][k])
            for (std::size_t l = 0; l < stored.size(); ++l) {
                for (const json& node : row[l])
                    e.row_slots.push_back(static_cast<Slot>(offsets[l] + node.get<Offset>()));
                e.row_offsets.push_back(static_cast<Offset>(e.row_slots.size()));
            }
    }
    e.pair_offsets.assign(static_cast<std::size_t>(e.list_offset.back()) + 1, 0);
    for (const json& pair : source["pairs"]) {
        const auto p = pair.get<std::vector<std::size_t>>();
        for (std::size_t slot = static_cast<std::size_t>(offsets[p[0]]) + p[1] + 1;
             slot < e.pair_offsets.size(); ++slot)
            ++e.pair_offsets[slot];
        e.pair_j.push_back(static_cast<Slot>(offsets[p[2]]) + static_cast<Slot>(p[3]));
    }
    return e;
}

TEST(ResultOfPairs, reference_cases_are_met) {
    std::ifstream in(shared_data("oracle/connectivity_cases.json"));
    if (!in) in.open(reference_file);
    if (!in) GTEST_SKIP() << "the reference cases are not here";
    const json reference = json::parse(in);
    int found = 0;
    for (const json& source : reference["cases"]) {
        const std::string name = source["name"].get<std::string>().substr(0, 3);
        if (name != "c01" && name != "c02" && name != "c03" && name != "c05") continue;
        ++found;
        for (const char* const method : methods) {
            const TemporaryFolder folder;
            write_case(folder / "in.h5", case_of(source));
            const auto outcome = run_program(
                {"pairs", folder / "in.h5", "--method", method, "--out", folder / "out.h5"});
            ASSERT_EQ(outcome.status, 0) << outcome.err;
            SCOPED_TRACE(name);
            expect_result(folder / "out.h5", expected_of(source["expected"]));
        }
    }
    EXPECT_EQ(found, 4);
}

}  // namespace
}  // namespace connectivity::test
