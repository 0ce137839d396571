// SPDX-License-Identifier: BSD-3-Clause
// `connectivity cloud`: reproducible, inside its box, and about 60 nodes in every support.
#include <cmath>

#include <gtest/gtest.h>

#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

struct CloudFile {
    std::vector<double> x, h, mass;
};

CloudFile cloud(int n, int seed, const std::string& threads = "2") {
    const TemporaryFolder folder;
    const auto outcome =
        run_program({"cloud", "--n", std::to_string(n), "--seed", std::to_string(seed), "--threads",
                     threads, "--out", folder / "c.h5"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto file = PlainFile::open(folder / "c.h5");
    const std::string list = "node_lists/cloud/";
    return {file.read<double>(list + "positions"), file.read<double>(list + "h"),
            file.read<double>(list + "mass")};
}

TEST(Cloud, is_the_same_for_any_number_of_threads) {
    const auto one = cloud(3000, 5, "1"), two = cloud(3000, 5, "2");
    EXPECT_EQ(one.x, two.x);
    EXPECT_EQ(one.h, two.h);
    EXPECT_NE(one.x, cloud(3000, 6).x);
}

TEST(Cloud, larger_cloud_begins_at_the_same_places) {
    const auto small = cloud(100, 5), large = cloud(1000, 5);
    EXPECT_TRUE(std::equal(small.x.begin(), small.x.end(), large.x.begin()));
}

TEST(Cloud, lies_in_its_box_and_weighs_one) {
    const auto c = cloud(5000, 9);
    for (const double x : c.x) ASSERT_TRUE(x >= 0 && x <= 1) << x;
    double mass = 0;
    for (const double m : c.mass) mass += m;
    EXPECT_NEAR(mass, 1, 1e-12);
}

TEST(Cloud, supports_hold_about_sixty_others) {
    const auto c = cloud(4000, 3);
    const std::size_t n = c.h.size();
    double total = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            double r2 = 0;
            for (std::size_t d = 0; d < 3; ++d) {
                const double r = c.x[3 * i + d] - c.x[3 * j + d];
                r2 += std::pow(r - std::rint(r), 2);
            }
            total += i != j && r2 <= 4 * c.h[i] * c.h[i];
        }
    EXPECT_NEAR(total / static_cast<double>(n), 60, 6);
}

TEST(Cloud, a_single_node_is_legal) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"cloud", "--n", "1", "--out", folder / "c.h5"}).status, 0);
    EXPECT_EQ(run_program({"pairs", folder / "c.h5"}).status, 0);
}

}  // namespace
}  // namespace connectivity::test
