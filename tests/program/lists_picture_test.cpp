// SPDX-License-Identifier: BSD-3-Clause
// The picture of interaction lists: it is a PNG, and what it shows accounts for every source once.
#include <fstream>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/tree/box_tree.hpp>

#include <support/random.hpp>

#include <program/case_file.hpp>
#include <program/lists_scene.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

using program::ListedBox;
using program::ListRole;
using program::ListsScene;

bool has_gnuplot() { return std::system("command -v gnuplot > /dev/null 2>&1") == 0; }

/// Random particles in the unit cube, denser towards the origin; targets with radii if told.
struct Cloud {
    Cloud(int dim, bool with_radii, bool periodic) {
        start_runtime();
        constexpr Offset n = 400;
        Random random(5);
        for (Offset i = 0; i < n * dim; ++i) sources.push_back(power(random.uniform()));
        for (Offset i = 0; i < n * dim; ++i) targets.push_back(power(random.uniform()));
        for (Offset i = 0; i < n; ++i) radii.push_back(0.1 * power(random.uniform()));
        TreeInput input;
        input.dim = dim;
        input.sources = ParticleArray::interleaved(sources.data(), n, dim);
        TreeOptions options;
        options.max_particles_in_box = 5;
        if (with_radii) {
            input.targets = ParticleArray::interleaved(targets.data(), n, dim);
            input.targets->radii = radii.data();
            options.stick_out_factor = 0.25;
        }
        if (periodic) {
            options.bounding_box = TreeOptions::Box{{0, 0, 0}, {1, 1, 1}};
            options.periodic = {true, true, true};
        }
        tree.build(input, options);
        lists.rebuild(tree.view());
    }
    static double power(double x) { return x * x * x; }

    std::vector<double> sources, targets, radii;
    BoxTree tree;
    FMMTraversalInfo lists;
};

Offset sources_of(const ListsScene& scene) {
    Offset n = 0;
    for (const ListedBox& listed : scene.listed) {
        const bool all_below = listed.role == ListRole::siblings ||
                               listed.role == ListRole::siblings_of_ancestor ||
                               listed.role == ListRole::smaller;
        n += all_below ? scene.tree.sources.box_counts_cumul(listed.box)
                       : scene.tree.sources.box_counts_nonchild(listed.box);
    }
    return n;
}

TEST(ListsScene, each_source_is_shown_once) {
    for (const int dim : {2, 3})
        for (const bool with_radii : {false, true}) {
            const Cloud cloud(dim, with_radii, false);
            const auto targets = cloud.lists.target_boxes();
            for (std::size_t i = 0; i < targets.size(); ++i)
                ASSERT_EQ(sources_of(program::lists_scene(cloud.lists, targets(i))), 400)
                    << "box " << targets(i) << " in " << dim << "D";
        }
}

TEST(ListsScene, each_image_of_a_source_is_shown_once) {
    const Cloud cloud(2, false, true);
    const auto scene = program::lists_scene(cloud.lists, program::telling_target_box(cloud.lists));
    EXPECT_EQ(sources_of(scene), 9 * 400);
    double lowest = 0, highest = 0;
    for (const auto& listed : scene.listed) {
        lowest = std::min(lowest, listed.center[0] - listed.half_width);
        highest = std::max(highest, listed.center[0] + listed.half_width);
    }
    EXPECT_NEAR(lowest, -1, 1e-12);
    EXPECT_NEAR(highest, 2, 1e-12);
}

TEST(ListsScene, the_box_chosen_has_the_most_kinds_of_lists_and_then_entries) {
    const Cloud cloud(2, true, false);
    const auto score = [&](BoxId box) {
        const auto& counts = program::lists_scene(cloud.lists, box).counts;
        std::pair<int, Offset> kinds_and_entries{0, 0};
        for (auto role = static_cast<std::size_t>(ListRole::siblings); role < counts.size();
             ++role) {
            kinds_and_entries.first += counts[role] > 0;
            kinds_and_entries.second += counts[role];
        }
        return kinds_and_entries;
    };
    const auto most = score(program::telling_target_box(cloud.lists));
    EXPECT_GE(most.first, 4);
    const auto targets = cloud.lists.target_boxes();
    for (std::size_t i = 0; i < targets.size(); ++i) EXPECT_LE(score(targets(i)), most);
}

/// n random points in a case file.
void write_points(const std::string& path, hsize_t n, hsize_t dim) {
    Random random(3);
    std::vector<double> x(n * dim);
    for (double& value : x) value = Cloud::power(random.uniform());
    PlainFile::create(path).data<double>("in_sources", x, {n, dim});
}

TEST(ListsPicture, is_a_png_of_two_and_three_dimensions) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not here";
    for (const hsize_t dim : {2, 3})
        for (const char* leaf : {"10", "1000"}) {  // the second is one box alone
            const TemporaryFolder folder;
            write_points(folder / "it's {in}.h5", 600, dim);
            const auto outcome = run_program(
                {"lists", folder / "it's {in}.h5", "--leaf", leaf, "--plot", folder / "a.png"});
            ASSERT_EQ(outcome.status, 0) << outcome.err;
            std::string bytes(8, '\0');
            std::ifstream(folder / "a.png", std::ios::binary).read(bytes.data(), 8);
            EXPECT_EQ(bytes, "\x89PNG\r\n\x1a\n");
            EXPECT_EQ(folder.names().size(), 2u);
        }
}

void expect_no_picture(const std::string& in, const std::vector<std::string>& flags, Status status,
                       const std::string& text) {
    const TemporaryFolder folder;
    std::vector<std::string> words{"lists", in, "--plot", folder / "a.png"};
    words.insert(words.end(), flags.begin(), flags.end());
    const auto outcome = run_program(words);
    EXPECT_EQ(outcome.status, static_cast<int>(status)) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(ListsPicture, refuses_boxes_and_trees_it_cannot_show) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not here";
    const TemporaryFolder folder;
    write_points(folder / "plane.h5", 100, 2);
    write_points(folder / "line.h5", 100, 1);
    expect_no_picture(folder / "plane.h5", {"--box", "100000"}, Status::argument, "no box 100000");
    expect_no_picture(folder / "line.h5", {}, Status::unsupported, "1 dimension");
    PlainFile::create(folder / "empty.h5")
        .data<double>("in_sources", {0, 0, 1, 1, 0, 1}, {3, 2})
        .data<double>("in_targets", {}, {0, 2});
    expect_no_picture(folder / "empty.h5", {}, Status::argument, "no targets");
    expect_no_picture(folder / "empty.h5", {"--leaf", "1", "--box", "1"}, Status::argument,
                      "box 1");
}

}  // namespace
}  // namespace connectivity::test
