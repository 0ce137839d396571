// SPDX-License-Identifier: BSD-3-Clause
#include "program/lists_describe.hpp"

#include <fmt/format.h>

#include <connectivity/base/budget.hpp>
#include <connectivity/io/names.hpp>

#include "program/console.hpp"

namespace connectivity::program {

namespace {

std::string describe_particles(const char* kind, const ListsInput::Particles& particles) {
    return fmt::format("{} {}{}", particles.n, kind,
                       particles.radii.size() > 0 ? " with radii" : "");
}

std::string line_of(const char* number, const char* name, Offset rows, Offset entries,
                    Offset bytes) {
    return fmt::format(
        "\n{:<8} {:<30}{:>11}{:>13}{:>10}{:>12}", number, name, rows, entries,
        rows > 0 ? fmt::format("{:.1f}", static_cast<double>(entries) / static_cast<double>(rows))
                 : "-",
        human_bytes(bytes));
}

/// "1 box", "2 boxes"
std::string counted(Offset n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

std::string describe_choices(const ListsInput& input) {
    const auto& tree = input.tree;
    std::string text = describe_particles("sources", input.sources);
    text += input.targets ? ", " + describe_particles("targets", *input.targets)
                          : ", which are the targets";
    text += fmt::format("; {}, ", name_of(tree.kind, tree_kind_names()));
    text += tree.max_leaf_refine_weight
                ? fmt::format("weight of a leaf at most {}", *tree.max_leaf_refine_weight)
                : fmt::format("at most {} in a leaf", tree.max_particles_in_box.value_or(0));
    if (input.have_radii())
        text += fmt::format(", sticking out by {} ({}), {}", tree.stick_out_factor.value_or(0),
                            name_of(tree.extent_norm, extent_norm_names()),
                            name_of(input.lists.crit(), from_sep_smaller_crit_names()));
    if (!input.tree_only)
        text += fmt::format(", well separated beyond {}", input.lists.well_sep_is_n_away);
    if (input.coordinates == CoordinateType::float32) text += ", single precision";
    return text;
}

std::string describe_tree(const BoxTree& tree) {
    const TreeView& view = tree.view();
    Offset n_leaves = 0;
    for (Offset b = 0; b < view.n_boxes; ++b) {
        bool leaf = true;
        for (int k = 0; k < 1 << view.dim; ++k)
            leaf = leaf && view.child(k, static_cast<BoxId>(b)) == 0;
        n_leaves += leaf;
    }
    const Offset n = view.sources.n + (view.sources_are_targets ? 0 : view.targets.n);
    const std::string each =
        n > 0 ? fmt::format(" ({:.0f} bytes a particle)",
                            static_cast<double>(tree.bytes()) / static_cast<double>(n))
              : "";
    return fmt::format("{} ({}) on {}, side of the root {:.10g}; {}; tree {}{}",
                       counted(view.n_boxes, "box", "boxes"), counted(n_leaves, "leaf", "leaves"),
                       counted(view.n_levels, "level", "levels"), view.root_extent,
                       counted(n, "particle", "particles"), human_bytes(tree.bytes()), each);
}

std::string describe_interactions(const FMMTraversalInfo& lists) {
    const auto bytes_of = [&](const char* name) {
        const auto* const entry = lists.report().find(name);
        return entry ? Offset{entry->bytes} : Offset{0};
    };
    std::string text = fmt::format("{:<8} {:<30}{:>11}{:>13}{:>10}{:>12}", "list", "", "boxes",
                                   "entries", "a box", "bytes");
    const auto add = [&](const char* number, const char* name, const std::optional<BoxList>& list) {
        if (list)
            text += line_of(number, name, list->size(), static_cast<Offset>(list->lists.size()),
                            bytes_of(name));
    };
    Offset smaller = 0;
    for (int level = 0; level < lists.nlevels(); ++level)
        smaller += lists.from_sep_smaller(level).count();
    add("near", "same_level_non_well_sep_boxes", lists.same_level_non_well_sep_boxes());
    add("1", "neighbor_source_boxes", lists.neighbor_source_boxes());
    add("2", "from_sep_siblings", lists.from_sep_siblings());
    text += line_of("3", "from_sep_smaller", lists.ntarget_boxes(), smaller,
                    bytes_of("from_sep_smaller"));
    add("3 close", "from_sep_close_smaller", lists.from_sep_close_smaller());
    add("4", "from_sep_bigger", lists.from_sep_bigger());
    add("4 close", "from_sep_close_bigger", lists.from_sep_close_bigger());
    return text;
}

std::string describe_work(const Work& work) {
    std::string text = fmt::format("{:<9} {:>16}  of", "operation", "times");
    const auto add = [&](const char* name, Offset count, const char* what) {
        text += fmt::format("\n{:<9} {:>16}  {}", name, count, what);
    };
    add("P2P", work.p2p, "pairs of target and source in list 1");
    if (work.p2p_close > 0) add("P2P close", work.p2p_close, "such pairs in lists 3 and 4 close");
    add("M2L", work.m2l, "pairs of boxes in list 2");
    add("M2P", work.m2p, "pairs of target and box in list 3");
    add("P2L", work.p2l, "pairs of source and box in list 4");
    add("P2M", work.p2m, "sources");
    add("M2M", work.m2m, "boxes with a parent and sources");
    add("L2L", work.l2l, "boxes with a parent and targets");
    add("L2P", work.l2p, "targets");
    return text;
}

std::string describe_times(const Report& report) {
    std::string text;
    for (const auto& entry : report.entries())
        if (entry.ms > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", entry.product,
                                human_duration(entry.ms));
    return text;
}

}  // namespace connectivity::program
