// SPDX-License-Identifier: BSD-3-Clause
// The picture: it is there, it is a PNG, and what it is drawn from is right.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <program/case_file.hpp>
#include <program/run_program.hpp>
#include <program/statistics.hpp>
#include <program/surface_density.hpp>

namespace connectivity::test {
namespace {

bool has_gnuplot() { return std::system("command -v gnuplot > /dev/null 2>&1") == 0; }

std::string first_bytes(const std::string& path) {
    std::string bytes(8, '\0');
    std::ifstream(path, std::ios::binary).read(bytes.data(), 8);
    return bytes;
}

TEST(Plot, is_a_png_in_every_dimension) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not here";
    for (int dim = 1; dim <= 3; ++dim) {
        std::vector<double> x;
        x.reserve(60);
        for (int i = 0; i < 60; ++i) x.push_back(std::fmod(0.618034 * i, 1.0));
        Case c = uniform_case(dim, x, 0.1);
        c.lists[0].name = "it's_a {list}";
        const TemporaryFolder folder;
        write_case(folder / "in.h5", c);
        const auto outcome = run_program({"pairs", folder / "in.h5", "--plot", folder / "a.png"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(first_bytes(folder / "a.png"), "\x89PNG\r\n\x1a\n");
        EXPECT_EQ(folder.names().size(), 2u);
    }
}

TEST(Plot, lists_without_neighbours_or_nodes_are_drawn) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not here";
    for (const auto& c : {uniform_case(3, {0.5, 0.5, 0.5}, 0), uniform_case(2, {}, 0)}) {
        const TemporaryFolder folder;
        write_case(folder / "in.h5", c);
        const auto outcome = run_program({"pairs", folder / "in.h5", "--plot", folder / "a.png"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
}

connectivity::ListData list_of(int dim, const std::vector<double>& x, double h, double mass) {
    start_runtime();
    const auto n = static_cast<Offset>(x.size()) / dim;
    auto positions = allocate<double>("x", n * dim), hs = allocate<double>("h", n),
         m = allocate<double>("m", n);
    std::copy(x.begin(), x.end(), positions.data());
    Kokkos::deep_copy(hs, h);
    Kokkos::deep_copy(m, mass);
    connectivity::ListData list{NodeList::with_h("nodes", dim, n, positions, hs, 2)};
    list.mass = m;
    return list;
}

TEST(SurfaceDensity, mass_is_conserved_in_a_periodic_box) {
    Domain box;
    box.periodic = {true, true, true};
    box.lo = {-1, -1, -1};
    box.hi = {1, 3, 1};
    for (const double h : {0.0, 0.02, 0.3}) {
        const std::vector<connectivity::ListData> lists{
            list_of(3, {-1, -1, 0, 0.99, 2.99, 0, 5.3, 1, 0, 0.1, 0.2, 0.3}, h, 2.5)};
        const auto map = program::surface_density(lists, box, 128);
        EXPECT_EQ(map.nx, 64);
        EXPECT_EQ(map.ny, 128);
        double sum = 0;
        for (const float value : map.values) sum += static_cast<double>(value);
        EXPECT_NEAR(sum * 8 / (64 * 128), 10, 0.01) << "h = " << h;
    }
}

TEST(SurfaceDensity, a_node_is_seen_where_it_is) {
    Domain box;
    box.periodic = {true, true, false};
    box.hi = {1, 1, 0};
    const auto map =
        program::surface_density(std::vector{list_of(2, {0.75, 0.25}, 0.0, 1)}, box, 10);
    const auto brightest = std::max_element(map.values.begin(), map.values.end());
    EXPECT_EQ(brightest - map.values.begin(), 2 * 10 + 7);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x) {
            const bool is_near = std::abs(x - 7) <= 1 && std::abs(y - 2) <= 1;
            EXPECT_EQ(map.values[static_cast<std::size_t>(y * 10 + x)] > 0, is_near)
                << x << ", " << y;
        }
}

TEST(Statistics, percentiles_are_nearest_ranks) {
    program::CountStatistics counts;
    counts.histogram = {1, 0, 2, 5, 2};  // 0 2 2 3 3 3 3 3 4 4
    counts.n = 10;
    EXPECT_EQ(counts.min(), 0);
    EXPECT_EQ(counts.max(), 4);
    EXPECT_EQ(counts.isolated(), 1);
    EXPECT_EQ(counts.percentile(10), 0);
    EXPECT_EQ(counts.percentile(11), 2);
    EXPECT_EQ(counts.percentile(50), 3);
    EXPECT_EQ(counts.percentile(80), 3);
    EXPECT_EQ(counts.percentile(81), 4);
    EXPECT_EQ(counts.percentile(100), 4);
}

}  // namespace
}  // namespace connectivity::test
