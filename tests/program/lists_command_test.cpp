// SPDX-License-Identifier: BSD-3-Clause
// Where particles and choices of `connectivity lists` come from: node files, snapshots, flags.
#include <gtest/gtest.h>

#include <support/boxtree_oracle.hpp>
#include <support/random_case.hpp>

#include <program/case_file.hpp>
#include <program/lists_result.hpp>
#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

/// A file of boxtree's answers; empty where it is not here.
std::string boxtree_file(const std::string& name) {
    for (const auto& path : boxtree_files())
        if (path.stem() == name) return path.string();
    return {};
}

Outcome run_lists(const std::string& in, const std::string& out,
                  const std::vector<std::string>& flags = {}) {
    std::vector<std::string> words{"lists", in, "--out", out};
    words.insert(words.end(), flags.begin(), flags.end());
    return run_program(words);
}

/// Its sources as a node file of two lists, some nodes ghosts.
void write_as_nodes(const std::string& path, const std::string& oracle) {
    const auto x = PlainFile::open(oracle).read<double>("in_sources");
    const auto extents = PlainFile::open(oracle).extents("in_sources");
    Case c;
    c.dim = static_cast<int>(extents[1]);
    const auto cut = static_cast<std::ptrdiff_t>(extents[0] / 3 * extents[1]);
    c.lists.resize(2);
    c.lists[0].name = "b_first";
    c.lists[1].name = "a_second";
    c.lists[0].x.assign(x.begin(), x.begin() + cut);
    c.lists[1].x.assign(x.begin() + cut, x.end());
    for (std::size_t k = 0; k < 2; ++k) {
        c.lists[k].n_internal = c.n(k) / 2;
        c.lists[k].h.assign(static_cast<std::size_t>(c.n(k)), 0.01);
    }
    write_case(path, c);
}

TEST(ListsCommand, nodes_of_all_lists_are_sources_and_targets) {
    for (const std::string name : {"c24_2d_singlebox", "c25_3d_twolevel"}) {
        const std::string oracle = boxtree_file(name);
        ASSERT_FALSE(oracle.empty()) << name;
        const TemporaryFolder folder;
        write_as_nodes(folder / "in.h5", oracle);
        const std::string leaf = name == "c24_2d_singlebox" ? "300" : "60";
        const auto outcome = run_lists(folder / "in.h5", folder / "out.h5", {"--leaf", leaf});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        expect_same_result(folder / "out.h5", oracle);
    }
}

TEST(ListsCommand, a_list_alone_is_a_part) {
    const TemporaryFolder folder;
    write_as_nodes(folder / "in.h5", boxtree_file("c25_3d_twolevel"));
    ASSERT_EQ(run_lists(folder / "in.h5", folder / "out.h5", {"--list", "a_second"}).status, 0);
    EXPECT_EQ(PlainFile::open(folder / "out.h5").extents("tree_sources"), (Extents{3, 134}));
}

/// The in_* arrays alone: without params.
void copy_particles(const std::string& path, const std::string& oracle) {
    const auto from = PlainFile::open(oracle);
    auto to = PlainFile::create(path);
    for (const auto& name : from.names())
        if (name.starts_with("in_")) to.data(name, from.read<double>(name), from.extents(name));
}

TEST(ListsCommand, flags_say_what_params_say) {
    const TemporaryFolder folder;
    const std::string oracle = boxtree_file("c36_2d_text_nonad");
    ASSERT_FALSE(oracle.empty());
    copy_particles(folder / "in.h5", oracle);
    const auto outcome =
        run_lists(folder / "in.h5", folder / "out.h5",
                  {"--leaf", "40", "--kind", "non-adaptive", "--stick-out", "0.25", "--extent-norm",
                   "linf", "--criterion", "precise_linf", "--n-away", "1", "--min-sources", "0"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expect_same_result(folder / "out.h5", oracle);
}

TEST(ListsCommand, flags_come_before_params) {
    const std::string oracle = boxtree_file("c15_3d_text_l2_plinf_n2");
    if (oracle.empty()) GTEST_SKIP() << "the shared answers of boxtree are not here";
    const TemporaryFolder folder;
    copy_particles(folder / "in.h5", oracle);
    PlainFile::modify(folder / "in.h5")
        .attribute("/", "params",
                   R"({"d": 3, "leaf": 7, "kind": "non-adaptive", "sof": 1, "norm": "linf",
                       "crit": "static_linf", "n_away": 1, "minsrc": null, "name": "other"})");
    const auto outcome =
        run_lists(folder / "in.h5", folder / "out.h5",
                  {"--leaf", "20", "--kind", "adaptive", "--stick-out", "0.25", "--extent-norm",
                   "l2", "--criterion", "precise_linf", "--n-away", "2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expect_same_result(folder / "out.h5", oracle);
}

/// Rows of a result file.
struct FileList {
    std::vector<int> starts, boxes, images;
    FileList(const PlainFile& file, const std::string& name)
        : starts(file.read<int>(name + "_starts")),
          boxes(file.read<int>(name + "_lists")),
          images(file.has(name + "_images") ? file.read<int>(name + "_images")
                                            : std::vector<int>{}) {}
    template <class F>
    void each(std::size_t row, const F& f) const {
        for (auto e = static_cast<std::size_t>(starts[row]);
             e < static_cast<std::size_t>(starts[row + 1]); ++e)
            f(boxes[e]);
    }
};

/// How many sources reach each target box in all, through its lists and those of its ancestors.
std::vector<long> sources_met(const PlainFile& file) {
    const auto own = file.read<int>("tree_box_source_counts_nonchild"),
               all = file.read<int>("tree_box_source_counts_cumul"),
               parent = file.read<int>("tree_box_parent_ids"),
               targets = file.read<int>("trav_target_boxes"),
               far = file.read<int>("trav_target_or_target_parent_boxes");
    const FileList near(file, "trav_neighbor_source_boxes"),
        siblings(file, "trav_from_sep_siblings"), bigger(file, "trav_from_sep_bigger");
    std::vector<long> local(own.size(), 0), met(targets.size(), 0);
    for (std::size_t i = 0; i < far.size(); ++i) {  // parents come first
        long& sum = local[static_cast<std::size_t>(far[i])];
        if (far[i] != 0)
            sum = local[static_cast<std::size_t>(parent[static_cast<std::size_t>(far[i])])];
        siblings.each(i, [&](int b) { sum += all[static_cast<std::size_t>(b)]; });
        bigger.each(i, [&](int b) { sum += own[static_cast<std::size_t>(b)]; });
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
        met[i] = local[static_cast<std::size_t>(targets[i])];
        near.each(i, [&](int b) { met[i] += own[static_cast<std::size_t>(b)]; });
    }
    for (int level = 0; level < file.read<int>("tree_nlevels").at(0); ++level) {
        const std::string name = "trav_fss" + std::to_string(level);
        const FileList smaller(file, name);
        const auto rows = file.read<int>(name + "_nonempty_indices");
        for (std::size_t row = 0; row < rows.size(); ++row)
            smaller.each(row, [&](int b) {
                met[static_cast<std::size_t>(rows[row])] += all[static_cast<std::size_t>(b)];
            });
    }
    return met;
}

void expect_each_target_meets(const std::string& path, long n_sources) {
    const auto met = sources_met(PlainFile::open(path));
    ASSERT_FALSE(met.empty());
    for (std::size_t i = 0; i < met.size(); ++i) ASSERT_EQ(met[i], n_sources) << "target box " << i;
}

TEST(ListsCommand, a_periodic_box_is_the_root_and_open_ignores_it) {
    Case c = cloud(500, 7);
    for (std::size_t k = 0; k < c.lists[0].x.size(); k += 7) c.lists[0].x[k] += 2;  // outside
    for (std::size_t d = 0; d < 3; ++d) {
        c.domain.periodic[d] = true;
        c.domain.lo[d] = 0.25;
        c.domain.hi[d] = 1.25;
    }
    const TemporaryFolder folder;
    write_case(folder / "in.h5", c);
    const std::vector<std::string> leaf{"--leaf", "10"}, open{"--leaf", "10", "--open"};
    ASSERT_EQ(run_lists(folder / "in.h5", folder / "periodic.h5", leaf).status, 0);
    ASSERT_EQ(run_lists(folder / "in.h5", folder / "open.h5", open).status, 0);
    const auto file = PlainFile::open(folder / "periodic.h5");
    EXPECT_EQ(file.read<double>("tree_bbox_min"), (std::vector<double>{0.25, 0.25, 0.25}));
    EXPECT_EQ(file.read<double>("tree_root_extent"), std::vector<double>{1});
    EXPECT_TRUE(file.has("trav_from_sep_siblings_images"));
    EXPECT_FALSE(PlainFile::open(folder / "open.h5").has("trav_from_sep_siblings_images"));
    for (const double x : file.read<double>("tree_sources")) {
        EXPECT_GE(x, 0.25);
        EXPECT_LT(x, 1.25);
    }
    expect_each_target_meets(folder / "periodic.h5", 27 * 500);
    expect_each_target_meets(folder / "open.h5", 500);
}

TEST(ListsCommand, a_snapshot_gives_every_type) {
    const std::string path = shared_data("data/lcdm_gas_z0.hdf5");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const TemporaryFolder folder;
    const auto outcome = run_lists(path, folder / "out.h5", {"--open"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto file = PlainFile::open(folder / "out.h5");
    std::vector<float> x;
    for (const char* type : {"PartType0", "PartType1", "PartType4", "PartType5"}) {
        const std::string name = std::string(type) + "/Coordinates";
        if (!PlainFile::open(path).has(name)) continue;
        const auto more = PlainFile::open(path).read<float>(name);
        x.insert(x.end(), more.begin(), more.end());
    }
    const auto sorted = file.read<double>("tree_sources");
    const auto user = file.read<int>("tree_user_source_ids");
    ASSERT_EQ(sorted.size(), x.size());
    for (std::size_t i = 0; i < user.size(); ++i)
        for (std::size_t d = 0; d < 3; ++d)
            ASSERT_EQ(sorted[d * user.size() + i],
                      static_cast<double>(x[3 * static_cast<std::size_t>(user[i]) + d]));
    for (const int n : file.read<int>("tree_box_source_counts_nonchild")) ASSERT_LE(n, 64);
    expect_each_target_meets(folder / "out.h5", static_cast<long>(user.size()));
}

TEST(ListsCommand, tables_tell_boxes_entries_and_work) {
    const auto outcome = run_program({"lists", boxtree_file("c25_3d_twolevel")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto file = PlainFile::open(boxtree_file("c25_3d_twolevel"));
    const auto n_boxes = file.read<int>("tree_nboxes").at(0);
    const auto n_near = file.extents("trav_neighbor_source_boxes_lists").at(0);
    EXPECT_NE(outcome.out.find(std::to_string(n_boxes) + " boxes"), std::string::npos);
    EXPECT_NE(outcome.out.find("neighbor_source_boxes"), std::string::npos);
    EXPECT_NE(outcome.out.find(" " + std::to_string(n_near) + " "), std::string::npos);
    EXPECT_NE(outcome.out.find("P2P                  40000"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace connectivity::test
