// SPDX-License-Identifier: BSD-3-Clause
// `connectivity lists`: read, build tree and lists, report; on request result file and picture.
#include <filesystem>

#include <fmt/format.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/lists_file.hpp>
#include <connectivity/io/lists_input.hpp>
#include <connectivity/io/snapshot.hpp>

#include "program/commands.hpp"
#include "program/console.hpp"
#include "program/describe.hpp"
#include "program/lists_describe.hpp"
#include "program/lists_particles.hpp"
#include "program/lists_picture.hpp"
#include "program/outputs.hpp"
#include "program/plot.hpp"
#include "program/units.hpp"

namespace connectivity::program {

namespace {

class ListsRun {
public:
    explicit ListsRun(const ListsOptions& options)
        : options_(options),
          console_(4 + 2 * !options.out.empty() + !options.plot.empty()),
          is_case_(is_lists_input(options.file)) {}

    void run() {
        is_case_ ? read_case() : read_snapshot();
        choose();
        Console::line(describe_choices(input_) + "\n");
        grow();
        if (!input_.tree_only) interact();
        if (!options_.out.empty()) write();
        if (!options_.plot.empty()) draw();
        Console::line(fmt::format("\npeak memory {}", human_bytes(peak_memory())));
    }

private:
    void read_case();
    void read_snapshot();
    void choose();
    void grow();
    void interact();
    void write();
    void draw();

    const ListsOptions& options_;
    Console console_;
    bool is_case_;
    ListsInput input_;
    std::string length_unit_;
    BoxTree tree_;
    FMMTraversalInfo lists_;
};

void ListsRun::read_case() {
    if (!options_.lists.empty() || options_.step)
        throw Error(Status::argument,
                    fmt::format("'{}' is a case of sources and targets: it has no lists and no "
                                "steps to choose",
                                options_.file));
    console_.phase("reading " + options_.file, [&] { input_ = read_lists_input(options_.file); });
    Console::line(fmt::format("{}: case of sources and targets, {}D", options_.file, input_.dim));
}

void ListsRun::read_snapshot() {
    const auto reader = open_snapshot(options_.file, {{}, options_.step, options_.open});
    const SnapshotInfo& info = reader->info();
    Console::line(describe_input(info));
    length_unit_ = length_unit(info.units);
    std::vector<NodeList> nodes;
    console_.phase("reading", [&] {
        for (const auto& name : all_or_selected(info, options_.lists))
            nodes.push_back(reader->read(name, {}).nodes);
        input_ = particles_of(nodes, info.domain, info.dim);
    });
    for (const auto& list : nodes)
        Console::line(fmt::format("{:<20}{:>12} nodes", list.name(), list.n()));
}

/// Flags come before what the file says.
void ListsRun::choose() {
    auto& tree = input_.tree;
    auto& lists = input_.lists;
    if (options_.leaf)
        (tree.max_leaf_refine_weight ? tree.max_leaf_refine_weight : tree.max_particles_in_box) =
            options_.leaf;
    tree.kind = options_.kind.value_or(tree.kind);
    tree.coincident = options_.coincident.value_or(tree.coincident);
    if (options_.stick_out) tree.stick_out_factor = options_.stick_out;
    tree.extent_norm = options_.extent_norm.value_or(tree.extent_norm);
    lists.well_sep_is_n_away = options_.n_away.value_or(lists.well_sep_is_n_away);
    if (options_.criterion) lists.from_sep_smaller_crit = options_.criterion;
    lists.from_sep_smaller_min_nsources_cumul =
        options_.min_sources.value_or(lists.from_sep_smaller_min_nsources_cumul);
    input_.tree_only = input_.tree_only || options_.tree_only;
    tree.budget.bytes = lists.budget.bytes = static_cast<Offset>(options_.budget);
    const bool writes_hulls = !options_.out.empty() && !input_.tree_only;
    tree.hulls = writes_hulls ? Hulls::always : Hulls::automatic;
    if (options_.plot.empty()) return;
    if (input_.tree_only)
        throw Error(Status::argument, "a picture shows lists, but only the tree was asked for");
    if (input_.dim == 1)
        throw Error(
            Status::unsupported,
            fmt::format("'{}' has 1 dimension: pictures show trees of 2 or 3", options_.file));
}

void ListsRun::grow() {
    const int n_threads = runtime_threads();
    console_.phase(fmt::format("tree with {} thread{}", n_threads, n_threads == 1 ? "" : "s"),
                   [&] { tree_.build(input_.particles(), input_.tree); });
    Console::line("    " + describe_times(tree_.report()));
    tree_.release_scratch();
    if (input_.tree_only) Console::line("\n" + describe_tree(tree_) + "\n");
}

void ListsRun::interact() {
    Work work;
    console_.phase("lists", [&] { lists_.rebuild(tree_.view(), input_.lists); });
    Console::line("    " + describe_times(lists_.report()));
    console_.phase("work counts", [&] { work = count_work(lists_).total; });
    Console::line("\n" + describe_tree(tree_) + "\n");
    Console::line(describe_interactions(lists_) + "\n");
    Console::line(describe_work(work) + "\n");
}

void ListsRun::write() {
    ListsFile out(options_.out);
    const bool classes = !input_.tree_only && lists_.from_sep_siblings().lists.size() > 0;
    TranslationClassesInfo by_level, level_free;
    RotationClassesInfo rotations;
    if (classes) {
        console_.phase("classes of list 2", [&] {
            by_level = TranslationClassesInfo(lists_);
            level_free = TranslationClassesInfo(lists_, false);
            rotations = RotationClassesInfo(lists_);
        });
        Console::line(fmt::format("{} translations by level, {} level-free, {} rotations",
                                  by_level.nfrom_sep_siblings_translation_classes(),
                                  level_free.nfrom_sep_siblings_translation_classes(),
                                  rotations.nfrom_sep_siblings_rotation_classes()));
    }
    console_.phase("writing " + options_.out, [&] {
        out.write(tree_.view());
        if (!input_.tree_only) out.write(lists_);
        if (!input_.tree_only && tree_.view().have_extent())
            out.write_merged(lists_.merge_close_lists());
        if (classes) out.write(by_level, level_free);
        if (classes) out.write(rotations);
        out.commit(options_.command);
    });
}

void ListsRun::draw() {
    console_.phase("drawing " + options_.plot, [&] {
        const BoxId box = options_.box ? *options_.box : telling_target_box(lists_);
        const auto name = std::filesystem::path(options_.file).filename();
        draw_lists(options_.plot, lists_scene(lists_, box), {name.string(), length_unit_});
    });
}

}  // namespace

void run_lists(const ListsOptions& options) {
    check_outputs(options.file, {options.out, options.plot});
    if (!options.plot.empty()) require_plotting(options.plot);
    start_runtime({.n_threads = options.n_threads});
    ListsRun(options).run();
}

}  // namespace connectivity::program
