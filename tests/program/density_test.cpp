// SPDX-License-Identifier: BSD-3-Clause
// `--density` against a sum over all nodes written from the definition.
#include <cmath>

#include <gtest/gtest.h>

#include <support/random_case.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

double kernel(double r, double R, int dim) {
    const double pi = std::acos(-1.0), q = r / R;
    const double shape = q < 0.5 ? 1 - 6 * q * q + 6 * q * q * q : 2 * std::pow(1 - q, 3);
    const double factor[] = {4 / (3 * R), 40 / (7 * pi * R * R), 8 / (pi * R * R * R)};
    return factor[dim - 1] * shape;
}

double distance(const Case& c, const ListData& list, std::size_t i, std::size_t j) {
    double r2 = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(c.dim); ++d) {
        double r = list.x[i * static_cast<std::size_t>(c.dim) + d] -
                   list.x[j * static_cast<std::size_t>(c.dim) + d];
        if (c.domain.periodic[d])
            r -= c.domain.length(static_cast<int>(d)) *
                 std::rint(r / c.domain.length(static_cast<int>(d)));
        r2 += r * r;
    }
    return std::sqrt(r2);
}

std::vector<double> density(const Case& c, const ListData& list, const std::vector<double>& mass) {
    std::vector<double> rho(list.h.size(), 0);
    for (std::size_t i = 0; i < rho.size(); ++i)
        for (std::size_t j = 0; j < rho.size(); ++j) {
            const double R = list.extent * list.h[i], r = distance(c, list, i, j);
            if (r < R) rho[i] += mass[j] * kernel(r, R, c.dim);
        }
    return rho;
}

/// Writes a case with masses 1, 2, 3, ..., runs it, and compares the density of every scalar list.
void expect_density(Case c, const std::vector<std::string>& more = {}) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    std::vector<std::vector<double>> masses;
    for (const auto& list : c.lists) {
        std::vector<double> mass(list.tensor
                                     ? list.H.size() / static_cast<std::size_t>(n_symmetric(c.dim))
                                     : list.h.size());
        for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = 1.0 + static_cast<double>(i);
        masses.push_back(mass);
    }
    {
        auto file = PlainFile::modify(folder / "in.h5");
        for (std::size_t k = 0; k < c.lists.size(); ++k)
            file.data<double>("node_lists/" + c.lists[k].name + "/mass", masses[k]);
    }
    std::vector<std::string> arguments{"pairs", folder / "in.h5", "--density", "--out",
                                       folder / "out.h5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = run_program(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err << c.text;
    const auto out = PlainFile::open(folder / "out.h5");
    for (std::size_t k = 0; k < c.lists.size(); ++k) {
        const std::string name = "density/" + c.lists[k].name;
        if (c.lists[k].tensor) {
            EXPECT_FALSE(out.has("density") && out.has(name));
            continue;
        }
        const auto expected = density(c, c.lists[k], masses[k]), found = out.read<double>(name);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_NEAR(found[i], expected[i], 1e-12 * std::abs(expected[i]))
                << c.text << ", node " << i;
    }
}

TEST(Density, is_the_sum_over_the_nodes_of_the_same_list) {
    for (int dim = 1; dim <= 3; ++dim)
        for (std::uint64_t seed = 20; seed < 26; ++seed)
            expect_density(
                random_case(seed, {.dim = dim, .periodic = seed % 2 == 0, .min_nodes = 1}));
}

TEST(Density, ghosts_count_and_have_their_own) {
    Case c = uniform_case(2, {0, 0, 1, 0, 2, 0, 2.5, 0.5, 9, 9}, 0.7);
    c.lists[0].n_internal = 2;
    expect_density(c);
    expect_density(c, {"--ghost-rows"});
}

TEST(Density, nodes_that_see_nobody_have_none) {
    Case c = scalar_case(3, {0, 0, 0, 0.1, 0, 0}, {0, 1});
    expect_density(c);
}

TEST(Density, does_not_depend_on_the_other_lists) {
    Case c = uniform_case(1, {0, 0.5, 1}, 0.5, 1);
    c.lists[0].name = "narrow";
    c.lists.push_back(c.lists[0]);
    c.lists[1].name = "wide";
    c.lists[1].extent = 3;
    expect_density(c);
}

TEST(Density, of_an_empty_list_is_empty) {
    Case c = uniform_case(1, {0, 0.5}, 0.5);
    c.lists[0].name = "some";
    c.lists.push_back(c.lists[0]);
    c.lists[1] = {};
    c.lists[1].name = "none";
    expect_density(c);
}

TEST(Density, is_not_written_without_masses) {
    const TemporaryFolder folder;
    write_case(folder / "in.h5", uniform_case(1, {0, 1}, 0.5));
    const auto outcome =
        run_program({"pairs", folder / "in.h5", "--density", "--out", folder / "out.h5"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("no masses"), std::string::npos) << outcome.out;
    EXPECT_FALSE(PlainFile::open(folder / "out.h5").has("density"));
}

}  // namespace
}  // namespace connectivity::test
