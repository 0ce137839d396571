// SPDX-License-Identifier: BSD-3-Clause
// Errors of the program: one sentence on stderr, an exit status per kind, nothing left behind.
#include <array>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void expect_failure(const Outcome& outcome, Status status, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.status, static_cast<int>(status)) << outcome.err;
    EXPECT_TRUE(outcome.error_is_one_line()) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("connectivity: ")) << outcome.err;
    for (const auto& word : words)
        EXPECT_NE(outcome.err.find(word), std::string::npos)
            << "'" << word << "' is not in: " << outcome.err;
}

/// Runs a case that must fail, and looks that no result file is there.
void expect_case_fails(const Case& c, Status status, const std::vector<std::string>& words,
                       const std::vector<std::string>& more = {}) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    std::vector<std::string> arguments{"pairs", folder / "in.h5", "--out", folder / "out.h5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_failure(run_program(arguments), status, words);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.h5"});
}

Case periodic_line(std::vector<double> x, double h, double length) {
    Case c = uniform_case(1, std::move(x), h);
    c.domain.periodic[0] = true;
    c.domain.hi[0] = length;
    return c;
}

TEST(ExitStatus, is_zero_with_nothing_on_stderr_on_success) {
    for (const char* const word : {"--help", "--version", "info"}) {
        const auto outcome = run_program({word});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_FALSE(outcome.out.empty());
    }
}

TEST(ExitStatus, help_lists_every_kind_of_error) {
    const auto help = run_program({"--help"}).out;
    for (const Status status :
         {Status::argument, Status::nonfinite, Status::support, Status::not_spd, Status::box,
          Status::half_box, Status::budget, Status::file, Status::format})
        EXPECT_NE(help.find(status_text(status)), std::string::npos) << status_text(status);
}

TEST(ExitStatus, usage_errors) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    const std::string in = folder / "in.h5";
    const std::vector<std::vector<std::string>> wrong{
        {},                                  // no command
        {"fly"},                             // no such command
        {"pairs"},                           // no file
        {"pairs", in, "--fast"},             // no such option
        {"pairs", in, "--extent", "-1"},     //
        {"pairs", in, "--extent", "two"},    //
        {"pairs", in, "--threads", "0"},     //
        {"pairs", in, "--method", "guess"},  //
        {"pairs", in, "--budget", "much"},   //
        {"pairs", in, "--list", "water"},    // no such list
        {"pairs", in, "--list", "nodes", "--list", "nodes"},
        {"pairs", in, "--step", "1"},               // no steps in this format
        {"pairs", in, "--out", in},                 // would overwrite the input
        {"pairs", in, "--plot", folder / "a.gif"},  //
        {"cloud", "--n", "0", "--out", folder / "c.h5"},
    };
    for (const auto& arguments : wrong)
        expect_failure(run_program(arguments), Status::argument, {});
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.h5"});
}

TEST(ExitStatus, a_word_that_is_no_choice_is_answered_by_the_names_of_all) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    const std::string methods = "automatic, brute, cells, device, groups",
                      kinds = "adaptive, adaptive-level-restricted, non-adaptive";
    const std::vector<std::array<std::string, 4>> wrong{
        {"pairs", "--method", "guess", methods},
        {"pairs", "--method", "0", methods},  // nor are numbers of enumerators choices
        {"pairs", "--order", "slots", "key, slot"},
        {"pairs", "--intersection", "some", "filtered, unfiltered"},
        {"lists", "--kind", "octree", kinds},
        {"lists", "--kind", "1", kinds},
        {"lists", "--coincident", "ignore", "error, leaf"}};
    for (const auto& [command, flag, word, names] : wrong) {
        const auto outcome = run_program({command, folder / "in.h5", flag + "=" + word});
        expect_failure(outcome, Status::argument, {});
        EXPECT_EQ(outcome.err, "connectivity: " + flag + ": '" + word + "', must be one of " +
                                   names + " (see connectivity --help)\n");
    }
}

TEST(ExitStatus, files_that_cannot_be_read) {
    const TemporaryFolder folder;
    expect_failure(run_program({"pairs", folder / "none.h5"}), Status::file,
                   {"none.h5", "no such file"});
    std::ofstream(folder / "text.h5") << "this is no HDF5";
    expect_failure(run_program({"pairs", folder / "text.h5"}), Status::format,
                   {"text.h5", "not an HDF5 file"});
    { PlainFile::create(folder / "other.h5").data<double>("a/b", {1}); }
    expect_failure(run_program({"pairs", folder / "other.h5"}), Status::format, {"other.h5"});
    { PlainFile::create(folder / "gas.h5").data<double>("PartType0/SmoothingLength", {1}); }
    expect_failure(run_program({"pairs", folder / "gas.h5"}), Status::format,
                   {"gas.h5", "Coordinates"});
    write_case(folder / "cut.h5", uniform_case(1, std::vector<double>(1000, 0.5), 0.5));
    std::filesystem::resize_file(folder / "cut.h5", 4000);
    expect_failure(run_program({"pairs", folder / "cut.h5"}), Status::file,
                   {"cut.h5", "truncated"});
}

TEST(ExitStatus, places_that_cannot_be_written) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    expect_failure(run_program({"pairs", folder / "in.h5", "--out", folder / "no/out.h5"}),
                   Status::file, {"no folder"});
    expect_failure(run_program({"cloud", "--n", "5", "--out", folder.path()}), Status::file,
                   {"folder"});
}

TEST(ExitStatus, values_out_of_range_name_the_first_node) {
    expect_case_fails(scalar_case(1, {0, 1, nan, nan}, {1, 1, 1, 1}), Status::nonfinite,
                      {"node 2"});
    expect_case_fails(scalar_case(1, {0, 1, 2, 3}, {1, 1, 1, -0.5}), Status::support,
                      {"node 3", "-0.5"});
    expect_case_fails(scalar_case(1, {0, 1}, {nan, 1}), Status::support, {"node 0"});
    expect_case_fails(tensor_case(2, {0, 0, 1, 1}, {1, 0, 1, 1, 2, 1}), Status::not_spd,
                      {"node 1"});
}

TEST(ExitStatus, boxes_out_of_range) {
    expect_case_fails(periodic_line({0.5}, 0.1, -1), Status::box, {});
    expect_case_fails(periodic_line({0.5}, 0.1, 0), Status::box, {});
    expect_case_fails(periodic_line({0.1, 0.5}, 0.3, 1), Status::half_box, {"node 0"});
}

TEST(ExitStatus, results_over_the_budget) {
    expect_case_fails(uniform_case(1, std::vector<double>(2000, 0.5), 1), Status::budget, {"2"},
                      {"--budget", "1KiB"});
}

TEST(ExitStatus, a_missing_plotting_program) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    expect_failure(run_program({"pairs", folder / "in.h5", "--plot", folder / "a.png"},
                               {"PATH=" + folder.path()}),
                   Status::unsupported, {"gnuplot", "PATH"});
}

TEST(ExitStatus, a_failing_plotting_program) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    std::ofstream(folder / "gnuplot") << "#!/bin/sh\necho 'no pngcairo here' >&2\nexit 3\n";
    std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
    expect_failure(run_program({"pairs", folder / "in.h5", "--plot", folder / "a.png"},
                               {"PATH=" + folder.path()}),
                   Status::file, {"gnuplot", "no pngcairo here"});
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace connectivity::test
