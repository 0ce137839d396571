// SPDX-License-Identifier: BSD-3-Clause
// Errors of `connectivity gravity`: one sentence, an exit status per kind, nothing left behind.
#include <limits>

#include <gtest/gtest.h>

#include <connectivity/base/error.hpp>

#include <program/gravity_case.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

using Words = std::vector<std::string>;

class GravityErrors : public ::testing::Test {
protected:
    void write(const std::vector<MassList>& lists, int dim = 3) {
        std::filesystem::remove(in());
        write_masses(in(), dim, lists);
    }
    std::string in() const { return folder_ / "in.h5"; }

    void expect_fails(Status status, const Words& texts, const Words& flags = {}) {
        Words words{"gravity", in(), "--out", folder_ / "out.h5"};
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

TEST_F(GravityErrors, flags_with_impossible_values) {
    write({random_masses("gas", 3, 40, 1)});
    const std::vector<Words> wrong{{"--tolerance", "0"},
                                   {"--tolerance", "0.7"},
                                   {"--tolerance", "small"},
                                   {"--method", "tree"},
                                   {"--order", "0"},
                                   {"--order", "21"},
                                   {"--acceptance", "angle"},
                                   {"--order", "4", "--epsilon", "0"},
                                   {"--epsilon", "0.1"},
                                   {"--leaf", "0"},
                                   {"--near", "half"},
                                   {"--softening", "spline"},
                                   {"--constant", "0"},
                                   {"--constant", "nan"},
                                   {"--samples", "-1"},
                                   {"--seed", "-1"},
                                   {"--threads", "0"},
                                   {"--method", "walk", "--symmetric"},
                                   {"--step", "1"},
                                   {"--list", "dark"},
                                   {"--plot", in()},
                                   {"--plot", folder_ / "a.gif"},
                                   {"--fast"}};
    for (const auto& flags : wrong) {
        SCOPED_TRACE(flags.at(0) + (flags.size() > 1 ? " " + flags[1] : ""));
        expect_fails(Status::argument, {"connectivity: "}, flags);
    }
}

TEST_F(GravityErrors, a_list_without_masses_is_named) {
    auto lists = std::vector{random_masses("gas", 3, 40, 1), random_masses("tracers", 3, 20, 2)};
    lists[1].mass.clear();
    write(lists);
    expect_fails(Status::format, {"'tracers'", "no masses", "--list"});
    EXPECT_EQ(run_program({"gravity", in(), "--list", "gas"}).status, 0);
}

TEST_F(GravityErrors, an_empty_list_needs_no_masses) {
    write({random_masses("gas", 3, 40, 1), {"tracers", {}, {}, {}, 0}});
    EXPECT_EQ(run_program({"gravity", in()}).status, 0);
    write({{"tracers", {}, {}, {}, 0}});
    EXPECT_EQ(run_program({"gravity", in()}).status, 0);
}

TEST_F(GravityErrors, values_out_of_range_name_the_particle) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto list = random_masses("gas", 3, 40, 1, 0.1);
    list.x[3 * 7 + 1] = nan;
    write({list});
    expect_fails(Status::nonfinite, {"7"});
    list = random_masses("gas", 3, 40, 1, 0.1);
    list.mass[5] = nan;
    write({list});
    expect_fails(Status::nonfinite, {"5", "mass"});
    list = random_masses("gas", 3, 40, 1, 0.1);
    list.softening[6] = -1;
    write({list});
    expect_fails(Status::argument, {"6", "softening"});
}

TEST_F(GravityErrors, a_box_that_is_periodic_on_some_axes) {
    write({random_masses("gas", 3, 40, 1)});
    PlainFile::modify(in())
        .attribute("/", "periodic", std::vector<int>{1, 1, 0})
        .attribute("/", "box_lo", std::vector<double>{0, 0, 0})
        .attribute("/", "box_hi", std::vector<double>{1, 1, 1});
    expect_fails(Status::unsupported, {"periodic", "--open"});
    EXPECT_EQ(run_program({"gravity", in(), "--open"}).status, 0);
}

TEST_F(GravityErrors, nothing_to_draw) {
    if (std::system("command -v gnuplot > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "gnuplot is not here";
    write({{"gas", {}, {}, {}, 0}});
    const auto outcome = run_program({"gravity", in(), "--plot", folder_ / "a.png"});
    EXPECT_EQ(outcome.status, static_cast<int>(Status::argument));
    EXPECT_EQ(folder_.names(), Words{"in.h5"});
}

}  // namespace
}  // namespace connectivity::test
