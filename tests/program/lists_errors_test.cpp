// SPDX-License-Identifier: BSD-3-Clause
// Errors of `connectivity lists`: one sentence, an exit status per kind, nothing left behind.
#include <limits>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

using Words = std::vector<std::string>;

/// A folder with the case in.h5: four points in the plane, two targets.
class ListsErrors : public ::testing::Test {
protected:
    void write(const char* params) { write_points({0, 0, 1, 0, 0, 1, 1, 1}, params); }
    void write_points(const std::vector<double>& x, const char* params) {
        std::filesystem::remove(in());
        auto file = PlainFile::create(in());
        file.data<double>("in_sources", x, {x.size() / 2, 2});
        file.data<double>("in_targets", {0.5, 0.5, 0.2, 0.3}, {2, 2});
        if (params) file.attribute("/", "params", params);
    }
    std::string in() const { return folder_ / "in.h5"; }

    void expect_fails(Status status, const Words& texts, const Words& flags = {}) {
        Words words{"lists", in(), "--out", folder_ / "out.h5"};
        words.insert(words.end(), flags.begin(), flags.end());
        const auto outcome = run_program(words);
        EXPECT_EQ(outcome.status, static_cast<int>(status)) << outcome.err;
        EXPECT_TRUE(outcome.error_is_one_line()) << outcome.err;
        for (const auto& text : texts)
            EXPECT_NE(outcome.err.find(text), std::string::npos)
                << "'" << text << "' is not in: " << outcome.err;
        EXPECT_EQ(folder_.names(), Words{"in.h5"});
    }

    TemporaryFolder folder_;
};

TEST_F(ListsErrors, flags_with_impossible_values) {
    write(R"({"d": 2, "leaf": 1})");
    const std::vector<Words> wrong{{"--leaf", "0"},          {"--leaf", "2.5"},
                                   {"--leaf", "3000000000"}, {"--kind", "octree"},
                                   {"--n-away", "0"},        {"--criterion", "static"},
                                   {"--stick-out", "-1"},    {"--extent-norm", "l1"},
                                   {"--min-sources", "-1"},  {"--coincident", "ignore"},
                                   {"--threads", "0"},       {"--fast"}};
    for (const auto& flags : wrong) expect_fails(Status::argument, {"connectivity: "}, flags);
}

TEST_F(ListsErrors, flags_that_do_not_go_with_the_input) {
    write(R"({"d": 2, "leaf": 1})");
    expect_fails(Status::argument, {"no lists"}, {"--list", "gas"});
    expect_fails(Status::argument, {"no lists"}, {"--step", "1"});
    expect_fails(Status::argument, {"stick_out_factor", "radii"}, {"--stick-out", "0.25"});
    expect_fails(Status::argument, {"overwrite"}, {"--plot", in()});
    expect_fails(Status::argument, {".png"}, {"--plot", folder_ / "a.gif"});
    expect_fails(Status::argument, {"--box", "--plot"}, {"--box", "1"});
    expect_fails(Status::argument, {"tree"}, {"--tree-only", "--plot", folder_ / "a.png"});
    expect_fails(Status::budget, {}, {"--budget", "1"});
}

TEST_F(ListsErrors, params_without_a_meaning_are_named) {
    const std::vector<std::pair<const char*, Words>> wrong{
        {"leaf = 3", {"params", "no JSON object"}},
        {"[3]", {"params", "no JSON object"}},
        {R"({"d": 3})", {"params: d = 3", "must be 2"}},
        {R"({"d": "two"})", {"d = \"two\""}},
        {R"({"leaf": 0})", {"leaf = 0", "from 1"}},
        {R"({"leaf": 3.5})", {"leaf = 3.5"}},
        {R"({"leaf": 1e12})", {"leaf = "}},
        {R"({"kind": "octree"})", {"octree", "non-adaptive"}},
        {R"({"n_away": 0})", {"n_away = 0"}},
        {R"({"crit": "close"})", {"close", "static_l2"}},
        {R"({"norm": 2})", {"norm = 2", "linf"}},
        {R"({"sof": "much"})", {"sof = \"much\""}},
        {R"({"minsrc": -1})", {"minsrc = -1"}},
        {R"({"f32": 1})", {"f32 = 1", "true or false"}},
        {R"({"maxw": 5})", {"maxw = 5", "in_refine_weights"}}};
    for (const auto& [params, texts] : wrong) {
        write(params);
        expect_fails(Status::format, texts);
    }
}

TEST_F(ListsErrors, datasets_missing_or_of_the_wrong_shape) {
    { PlainFile::create(in()).data<double>("in_targets", {0, 0}, {1, 2}); }
    expect_fails(Status::format, {"in_sources"});
    { PlainFile::create(in()).attribute("/", "params", R"({"d": 2})"); }
    expect_fails(Status::format, {"in_sources"});
    { PlainFile::create(in()).data<double>("in_sources", {0, 0, 1, 1}); }
    expect_fails(Status::format, {"in_sources", "[4]", "[n, d]"});
    { PlainFile::create(in()).data<double>("in_sources", {0, 0, 1, 1}, {1, 4}); }
    expect_fails(Status::format, {"in_sources", "[1, 4]"});
    write(nullptr);
    { PlainFile::modify(in()).data<double>("in_target_radii", {1, 2, 3}); }
    expect_fails(Status::format, {"in_target_radii", "[3]", "[2]"});
    write(nullptr);
    { PlainFile::modify(in()).data<int>("in_refine_weights", {1, 1, 1, 1}); }
    expect_fails(Status::format, {"in_refine_weights", "[4]", "[6]"});
    write(nullptr);
    { PlainFile::modify(in()).data<double>("in_refine_weights", {1, 1, 1, 1, 1, 1}); }
    expect_fails(Status::format, {"in_refine_weights", "whole numbers"});
    write(nullptr);
    { PlainFile::modify(in()).data<int>("in_refine_weights", {1, 1, 1, 1, 1, 1}); }
    expect_fails(Status::format, {"maxw"});
    {
        PlainFile::create(in())
            .data<double>("in_sources", {0, 0}, {1, 2})
            .data<double>("in_target_radii", {1});
    }
    expect_fails(Status::format, {"in_target_radii", "in_targets"});
    { PlainFile::create(in()).unwritten("in_sources", {1000, 2}); }
    expect_fails(Status::format, {"in_sources", "written"});
    { PlainFile::create(in()).data<double>("other", {1}); }
    expect_fails(Status::format, {"in.h5"});
}

TEST_F(ListsErrors, values_out_of_range_name_the_particle) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    write_points({0, 0, 1, 0, nan, 1, 1, 1}, nullptr);
    expect_fails(Status::nonfinite, {"source 2"});
    write(nullptr);
    { PlainFile::modify(in()).data<double>("in_target_radii", {1, -0.5}); }
    expect_fails(Status::support, {"target 1", "-0.5"});
    write(R"({"maxw": 5})");
    { PlainFile::modify(in()).data<int>("in_refine_weights", {1, 1, 1, 9, 1, 1}); }
    expect_fails(Status::argument, {"source 3", "9"});
    write(R"({"norm": "l2", "crit": "static_linf"})");
    { PlainFile::modify(in()).data<double>("in_target_radii", {1, 1}); }
    expect_fails(Status::argument, {"static_linf", "l2"});
}

TEST_F(ListsErrors, coincident_particles_unless_leaves_may_hold_them) {
    write_points({1, 1, 1, 1, 1, 1, 0, 0}, R"({"leaf": 2})");
    expect_fails(Status::argument, {});
    EXPECT_EQ(run_program({"lists", in(), "--coincident", "leaf"}).status, 0);
}

TEST_F(ListsErrors, periodic_boxes_that_are_no_cube) {
    Case c = uniform_case(2, {0.5, 0.5, 1.5, 0.25}, 0.1);
    c.domain.periodic = {true, true, false};
    c.domain.hi = {2, 1, 0};
    write_case(in(), c);
    expect_fails(Status::box, {"2", "1", "--open"});
    c.domain.periodic[0] = false;
    write_case(in(), c);
    EXPECT_EQ(run_program({"lists", in()}).status, 0);
    c.lists[0].x[2] = 1.75;
    write_case(in(), c);
    expect_fails(Status::box, {"1.25", "axis 0", "--open"});
    EXPECT_EQ(run_program({"lists", in(), "--open"}).status, 0);
}

}  // namespace
}  // namespace connectivity::test
