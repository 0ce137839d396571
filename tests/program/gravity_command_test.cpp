// SPDX-License-Identifier: BSD-3-Clause
// `connectivity gravity` is the sum over pairs, whatever file the particles come from.
#include <fstream>
#include <numeric>

#include <gtest/gtest.h>

#include <support/ewald_brute.hpp>

#include <program/gravity_case.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

using Words = std::vector<std::string>;

Outcome run_gravity(const std::string& in, const std::string& out, const Words& flags = {}) {
    Words words{"gravity", in, "--out", out};
    words.insert(words.end(), flags.begin(), flags.end());
    return run_program(words);
}

std::vector<std::int64_t> all_of(const GravityScene& scene) {
    std::vector<std::int64_t> all(static_cast<std::size_t>(scene.n()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

/// All images without end of a scene in the unit cube.
std::vector<BruteSum> ewald(const GravityScene& scene) {
    std::vector<double> x;
    for (std::size_t i = 0; i < scene.x.size(); ++i)
        x.insert(x.end(), {scene.x[i], scene.y[i], scene.z[i]});
    const auto sums = ewald_brute({1, 1, 1}, x, scene.m, x);
    std::vector<BruteSum> result(scene.x.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = {sums.p[i], {sums.a[3 * i], sums.a[3 * i + 1], sums.a[3 * i + 2]}};
    return result;
}

TEST(GravityCommand, is_the_sum_over_pairs_in_every_dimension) {
    for (const int dim : {1, 2, 3}) {
        const std::vector<MassList> lists{random_masses("b_gas", dim, 90, 1),
                                          random_masses("a_dark", dim, 120, 2, 0.05)};
        const TemporaryFolder folder;
        write_masses(folder / "in.h5", dim, lists);
        const auto outcome = run_gravity(folder / "in.h5", folder / "out.h5");
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto scene = internal_nodes(dim, lists);
        EXPECT_EQ(share_beyond(1e-12, GravityResult(folder / "out.h5"),
                               brute_gravity(scene, BruteLaw::plummer), all_of(scene)),
                  0)
            << dim << "D";
    }
}

TEST(GravityCommand, keeps_the_tolerance_by_every_method) {
    const std::vector<MassList> lists{random_masses("gas", 3, 2000, 3)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    const auto scene = internal_nodes(3, lists);
    const auto targets = sample_targets(scene.n(), 300);
    const auto expected = brute_gravity(scene, targets);
    for (const char* const method : {"auto", "direct", "walk", "fmm"})
        for (const char* const tolerance : {"1e-2", "1e-5"}) {
            const auto outcome = run_gravity(folder / "in.h5", folder / "out.h5",
                                             {"--method", method, "--tolerance", tolerance});
            ASSERT_EQ(outcome.status, 0) << outcome.err;
            EXPECT_NE(outcome.out.find(std::string("tolerance ")), std::string::npos);
            EXPECT_EQ(outcome.out.find("NOT"), std::string::npos) << outcome.out;
            EXPECT_LE(share_beyond(std::stod(tolerance), GravityResult(folder / "out.h5"), expected,
                                   targets),
                      0.01)
                << method << " " << tolerance;
        }
}

TEST(GravityCommand, a_list_alone_feels_itself_alone) {
    const std::vector<MassList> lists{random_masses("gas", 3, 60, 4),
                                      random_masses("stars", 3, 40, 5)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    ASSERT_EQ(run_gravity(folder / "in.h5", folder / "out.h5", {"--list", "stars"}).status, 0);
    const auto scene = internal_nodes(3, {lists[1]});
    EXPECT_EQ(
        share_beyond(1e-12, GravityResult(folder / "out.h5"), brute_gravity(scene), all_of(scene)),
        0);
}

TEST(GravityCommand, constant_and_softening_are_those_of_the_flags) {
    const std::vector<MassList> lists{random_masses("gas", 3, 150, 6, 0.2)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    ASSERT_EQ(run_gravity(folder / "in.h5", folder / "out.h5",
                          {"--constant", "43007.1", "--softening", "sph-exa"})
                  .status,
              0);
    const auto scene = internal_nodes(3, lists);
    EXPECT_EQ(share_beyond(1e-12, GravityResult(folder / "out.h5"),
                           brute_gravity(scene, BruteLaw::sph_exa), all_of(scene), 43007.1),
              0);
}

TEST(GravityCommand, a_periodic_box_has_images_and_open_ignores_them) {
    const std::vector<MassList> lists{random_masses("gas", 3, 60, 7)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    PlainFile::modify(folder / "in.h5")
        .attribute("/", "periodic", std::vector<int>{1, 1, 1})
        .attribute("/", "box_lo", std::vector<double>{0, 0, 0})
        .attribute("/", "box_hi", std::vector<double>{1, 1, 1});
    ASSERT_EQ(run_gravity(folder / "in.h5", folder / "periodic.h5", {"--tolerance", "1e-6"}).status,
              0);
    ASSERT_EQ(run_gravity(folder / "in.h5", folder / "open.h5", {"--open"}).status, 0);
    const auto scene = internal_nodes(3, lists);
    EXPECT_EQ(
        share_beyond(1e-12, GravityResult(folder / "open.h5"), brute_gravity(scene), all_of(scene)),
        0);
    EXPECT_EQ(
        share_beyond(1e-6, GravityResult(folder / "periodic.h5"), ewald(scene), all_of(scene)), 0);
}

TEST(GravityCommand, the_result_tells_how_it_was_made) {
    auto lists = std::vector<MassList>{random_masses("b", 3, 600, 8), random_masses("a", 3, 30, 9)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    ASSERT_EQ(run_gravity(folder / "in.h5", folder / "out.h5",
                          {"--method", "fmm", "--order", "6", "--acceptance", "geometric",
                           "--epsilon", "0.5", "--leaf", "20", "--near", "float64", "--samples",
                           "40", "--symmetric", "--threads", "1"})
                  .status,
              0);
    const auto file = PlainFile::open(folder / "out.h5");
    EXPECT_EQ(file.extents("gravity/acceleration"), (Extents{525, 3}));
    EXPECT_EQ(file.extents("gravity/potential"), (Extents{525}));
    EXPECT_EQ(file.strings("/", "list_names"), (Words{"b", "a"}));
    EXPECT_EQ(file.numbers<int>("/", "n_internal"), (std::vector<int>{500, 25}));
    EXPECT_EQ(file.numbers<int>("/", "list_offset"), (std::vector<int>{0, 600, 630}));
    EXPECT_EQ(file.numbers<int>("/", "row_offset"), (std::vector<int>{0, 500, 525}));
    EXPECT_NE(file.strings("/", "command").at(0).find("--order 6"), std::string::npos);
    EXPECT_FALSE(file.strings("/", "library_version").at(0).empty());
    EXPECT_EQ(file.strings("gravity", "method"), Words{"fmm"});
    EXPECT_EQ(file.strings("gravity", "acceptance"), Words{"geometric"});
    EXPECT_EQ(file.strings("gravity", "near"), Words{"float64"});
    EXPECT_EQ(file.strings("gravity", "softening"), Words{"plummer"});
    EXPECT_EQ(file.numbers<double>("gravity", "epsilon"), std::vector<double>{0.5});
    EXPECT_EQ(file.numbers<double>("gravity", "tolerance"), std::vector<double>{1e-4});
    for (const auto& [name, value] :
         {std::pair{"order", 6}, {"n_samples", 40}, {"symmetric", 1}, {"constant", 1}})
        EXPECT_EQ(file.numbers<int>("gravity", name), std::vector<int>{value}) << name;
    EXPECT_GT(file.numbers<double>("gravity", "error_max").at(0), 0);
    EXPECT_GE(file.numbers<double>("gravity", "error_max"),
              file.numbers<double>("gravity", "error_rms"));
    EXPECT_EQ(file.strings("gravity", "phases").size(),
              file.numbers<double>("gravity", "seconds").size());
}

/// The number after a text of the program.
double number_after(const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

TEST(GravityCommand, prints_energy_and_momentum_of_what_it_wrote) {
    const std::vector<MassList> lists{random_masses("gas", 3, 1200, 10)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    const auto outcome = run_gravity(folder / "in.h5", folder / "out.h5",
                                     {"--method", "fmm", "--tolerance", "1e-3", "--leaf", "16"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const GravityResult result(folder / "out.h5");
    double energy = 0, force[3] = {0, 0, 0}, forces = 0;
    for (std::size_t i = 0; i < result.potential.size(); ++i) {
        const double m = lists[0].mass[i];
        const double* const a = result.acceleration.data() + 3 * i;
        energy += 0.5 * m * result.potential[i];
        for (int d = 0; d < 3; ++d) force[d] += m * a[d];
        forces += m * std::hypot(a[0], a[1], a[2]);
    }
    EXPECT_NEAR(number_after(outcome.out, "(sum m phi / 2)"), energy, 1e-8 * std::abs(energy));
    const double drift = std::hypot(force[0], force[1], force[2]) / forces;
    EXPECT_NEAR(number_after(outcome.out, "sum m|a|"), drift, 0.01 * drift + 1e-16);
}

TEST(GravityCommand, a_tolerance_that_settings_by_hand_miss_is_said) {
    const std::vector<MassList> lists{random_masses("gas", 3, 3000, 11)};
    const TemporaryFolder folder;
    write_masses(folder / "in.h5", 3, lists);
    const auto outcome = run_gravity(folder / "in.h5", folder / "out.h5",
                                     {"--method", "fmm", "--order", "1", "--acceptance",
                                      "geometric", "--epsilon", "0.9", "--tolerance", "1e-8"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("warning: tolerance 1e-08 NOT kept"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(PlainFile::open(folder / "out.h5").numbers<int>("gravity", "reached"),
              std::vector<int>{0});
}

TEST(GravityCommand, a_snapshot_is_the_sum_over_pairs_of_all_types) {
    const std::string path = shared_data("data/lcdm_gas_z0.hdf5");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const TemporaryFolder folder;
    const auto outcome = run_gravity(path, folder / "out.h5", {"--open"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto in = PlainFile::open(path);
    const auto table = in.numbers<double>("Header", "MassTable");
    GravityScene scene;
    for (const std::size_t type : {0, 1, 4, 5}) {
        const std::string group = "PartType" + std::to_string(type);
        if (!in.has(group) || !in.has(group + "/Coordinates")) continue;
        const auto x = in.read<float>(group + "/Coordinates");
        const auto mass =
            in.has(group + "/Masses") ? in.read<float>(group + "/Masses") : std::vector<float>{};
        for (std::size_t i = 0; i < x.size() / 3; ++i)
            scene.add(x[3 * i], x[3 * i + 1], x[3 * i + 2],
                      mass.empty() ? table[type] : double{mass[i]});
    }
    const auto targets = sample_targets(scene.n(), 200);
    const GravityResult result(folder / "out.h5");
    ASSERT_EQ(result.potential.size(), static_cast<std::size_t>(scene.n()));
    EXPECT_LE(share_beyond(1e-4, result, brute_gravity(scene, targets), targets), 0.01);
}

TEST(GravityCommand, a_picture_is_a_png) {
    if (std::system("command -v gnuplot > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "gnuplot is not here";
    for (const int n : {2, 400}) {
        const TemporaryFolder folder;
        write_masses(folder / "it's {in}.h5", 2, {random_masses("gas's", 2, n, 12)});
        const auto outcome =
            run_program({"gravity", folder / "it's {in}.h5", "--plot", folder / "a.png"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        std::string bytes(8, '\0');
        std::ifstream(folder / "a.png", std::ios::binary).read(bytes.data(), 8);
        EXPECT_EQ(bytes, "\x89PNG\r\n\x1a\n");
        EXPECT_EQ(folder.names().size(), 2u);
    }
}

}  // namespace
}  // namespace connectivity::test
