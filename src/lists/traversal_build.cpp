// SPDX-License-Identifier: BSD-3-Clause
#include "traversal_build.hpp"

#include <string>

#include "target_walk.hpp"

namespace connectivity::detail {
namespace {

void check_mask(const char* name, const ConstView<std::uint8_t>& mask, Offset n_boxes) {
    if (mask.size() > 0 && static_cast<Offset>(mask.size()) != n_boxes)
        throw Error(Status::argument, std::string(name) + " has " + std::to_string(mask.size()) +
                                          " elements, must have " + std::to_string(n_boxes) +
                                          ", one for each box, or none");
}

TraversalOptions checked(const TraversalOptions& options, const TreeView& tree) {
    if (options.from_sep_smaller_min_nsources_cumul < 0)
        throw Error(Status::argument,
                    "from_sep_smaller_min_nsources_cumul is " +
                        std::to_string(options.from_sep_smaller_min_nsources_cumul) +
                        ", must be at least 0");
    check_mask("source_boxes_mask", options.source_boxes_mask, tree.n_boxes);
    check_mask("source_parent_boxes_mask", options.source_parent_boxes_mask, tree.n_boxes);
    return options;
}

/// Counts what a target walk finds.
struct CountSink {
    const TreeTables& tables;
    bool apart_wanted;
    Offset *entries, *rows;  // [level] of list 3
    BoxId target = -1;
    Offset n_near = 0, n_close = 0;
    std::array<BoxId, 256> last{};  // target + 1 that had an entry on this level

    bool wants_apart() const { return apart_wanted; }
    void near(BoxId, ImageCode) { ++n_near; }
    void close(BoxId, ImageCode) { ++n_close; }
    void smaller(BoxId source, ImageCode) {
        const auto level = static_cast<std::size_t>(tables.level(source));
        ++entries[level];
        if (last[level] == target + 1) return;
        last[level] = target + 1;
        ++rows[level];
    }
};

}  // namespace

TraversalBuild::TraversalBuild(const TreeView& tree, const TraversalOptions& options,
                               BuildScratch& scratch)
    : scratch_(scratch),
      options_(checked(options, tree)),
      tables_(tree, scratch.tables),
      separation_(tree, options),
      near_(tables_, separation_, options, scratch.near),
      has_close_(tree.have_extent()) {
    for (int k = 0; k < tree.dim; ++k) periodic_ |= tree.periodic[static_cast<std::size_t>(k)];
    ms_near_ = watch_.ms();
}

void TraversalBuild::prepare(TraversalState& state) {
    find_bases();
    count_targets();
    try {
        prepare_lists(state);
        prepare_smaller(state.smaller);
        check_budget();
        reserve(state);
        make_report();
    } catch (...) {
        state.each_list([](BoxRows& rows) { rows.abandon(); });
        state.base.each([](Csr& rows) { rows.abandon(); });
        state.smaller.each([](auto& rows) { rows.abandon(); });
        throw;
    }
    ms_count_ = watch_.ms();
}

void TraversalBuild::find_bases() {
    const TreeView& tree = tables_.tree;
    const auto passes = [](const ConstView<std::uint8_t>& mask, Offset b) {
        return mask.size() == 0 || mask(b) != 0;
    };
    BuildScratch& to = scratch_;
    const std::array bases{&to.sources, &to.targets, &to.source_parents, &to.target_parents};
    for (BaseBoxes* base : bases) {
        base->boxes.clear();
        base->level_starts.assign(1, 0);
    }
    for (int level = 0; level < tree.n_levels; ++level) {
        for (BoxId b = tree.level_start_box_nrs(level); b < tree.level_start_box_nrs(level + 1);
             ++b) {
            const unsigned flags = tables_.flags(b);
            if ((flags & box_flag::has_own_sources) && passes(options_.source_boxes_mask, b))
                to.sources.boxes.push_back(b);
            if ((flags & box_flag::has_child_sources) &&
                passes(options_.source_parent_boxes_mask, b))
                to.source_parents.boxes.push_back(b);
            if (flags & box_flag::has_own_targets) to.targets.boxes.push_back(b);
            if (flags & target_flags) to.target_parents.boxes.push_back(b);
        }
        for (BaseBoxes* base : bases) base->level_starts.push_back(base->size());
    }
}

void TraversalBuild::count_targets() {
    if (!options_.neighbor_source_boxes && !options_.from_sep_smaller) return;
    const auto chunks = static_cast<std::size_t>(n_chunks(n_targets(), chunk));
    scratch_.n_near.resize(scratch_.targets.boxes.size());
    scratch_.n_close.resize(scratch_.targets.boxes.size());
    scratch_.smaller_entries.assign(chunks * static_cast<std::size_t>(n_levels()), 0);
    scratch_.smaller_rows = scratch_.smaller_entries;
    for_each_chunk("lists/count", n_targets(), chunk, [&](Offset c, Offset first, Offset last) {
        CountSink sink{tables_, options_.from_sep_smaller, &scratch_.smaller_entries[cell(c, 0)],
                       &scratch_.smaller_rows[cell(c, 0)]};
        TargetWalk walk(tables_, separation_, sink);
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
            sink.target = scratch_.targets.boxes[i];
            sink.n_near = sink.n_close = 0;
            walk(sink.target, near_.row(sink.target));
            scratch_.n_near[i] = sink.n_near;
            scratch_.n_close[i] = sink.n_close;
        }
    });
}

void TraversalBuild::prepare_lists(TraversalState& state) {
    const auto nth = [](const std::vector<Offset>& counts) {
        return [&](Offset i) { return counts[static_cast<std::size_t>(i)]; };
    };
    const auto n_target_parents = scratch_.target_parents.size();
    const bool smaller = options_.from_sep_smaller, bigger = options_.from_sep_bigger;
    plan("same_level_non_well_sep_boxes", options_.same_level_non_well_sep_boxes, state.same_level,
         tables_.tree.n_boxes,
         [&](Offset b) { return near_.row(static_cast<BoxId>(b)).n_same_level; });
    plan("neighbor_source_boxes", options_.neighbor_source_boxes, state.neighbors, n_targets(),
         nth(scratch_.n_near));
    plan("from_sep_siblings", options_.from_sep_siblings, state.siblings, n_target_parents,
         [&](Offset i) { return near_.row(target_parent(i)).n_from_sep_siblings; });
    plan("from_sep_close_smaller", has_close_ && smaller, state.close_smaller, n_targets(),
         nth(scratch_.n_close));
    plan("from_sep_bigger", bigger, state.bigger, n_target_parents,
         [&](Offset i) { return near_.row(target_parent(i)).n_from_sep_bigger; });
    plan("from_sep_close_bigger", has_close_ && bigger, state.close_bigger, n_targets(),
         [&](Offset i) {
             Offset n = 0;
             for (const Near& e : near_.row(target(i))) n += e.open();
             return n;
         });
    const auto by_level = [&](Csr& rows, const BaseBoxes& base) {
        rows.prepare(n_levels(), [&](Offset level) { return base.n_in(level); });
    };
    by_level(state.base.sources, scratch_.sources);
    by_level(state.base.targets, scratch_.targets);
    by_level(state.base.source_parents, scratch_.source_parents);
    by_level(state.base.target_parents, scratch_.target_parents);
}

void TraversalBuild::prepare_smaller(SmallerLists& smaller) {
    Plan all{"from_sep_smaller", options_.from_sep_smaller, 0, 0};
    if (all.wanted) {
        std::vector<Offset> n_rows(static_cast<std::size_t>(n_levels()));
        while (static_cast<Offset>(smaller.levels.size()) < n_levels())
            smaller.levels.emplace_back("lists/from_sep_smaller");
        for (Offset level = 0; level < n_levels(); ++level) {
            Offset entries = 0, rows = 0;
            for (Offset c = 0; c < n_chunks(n_targets(), chunk); ++c) {
                entries += std::exchange(scratch_.smaller_entries[cell(c, level)], entries);
                rows += std::exchange(scratch_.smaller_rows[cell(c, level)], rows);
            }
            const auto l = static_cast<std::size_t>(level);
            n_rows[l] = rows;
            all.bytes += smaller.levels[l].prepare_sizes(rows, entries, periodic_);
            all.entries += entries;
        }
        const auto count = [&](Offset level) { return n_rows[static_cast<std::size_t>(level)]; };
        all.bytes += smaller.indices.prepare(n_levels(), count);
        all.bytes += smaller.targets.prepare(n_levels(), count);
    }
    plans_.push_back(all);
}

void TraversalBuild::check_budget() const {
    Offset bytes = near_.bytes();
    const Plan* largest = &plans_.front();
    for (const Plan& plan : plans_) {
        bytes += plan.bytes;
        if (plan.bytes > largest->bytes) largest = &plan;
    }
    if (options_.budget.allows(bytes)) return;
    throw Error(Status::budget,
                "interaction lists need " + human_bytes(bytes) + ", the budget allows " +
                    human_bytes(options_.budget.allowed()) + "; the largest is " + largest->name +
                    " with " + std::to_string(largest->entries) + " entries");
}

void TraversalBuild::reserve(TraversalState& state) {
    state.base.each([](Csr& rows) { rows.reserve(); });
    std::size_t k = 0;
    state.each_list([&](BoxRows& rows) {
        if (plans_[k++].wanted) rows.reserve();
    });
    if (plans_.back().wanted) state.smaller.each([](auto& rows) { rows.reserve(); });
}

/// Before the fill, as it allocates; times are set when they are known.
void TraversalBuild::make_report() {
    for (const Plan& plan : plans_) {
        ReportEntry& entry = report_.entry(plan.name);
        entry.built = plan.wanted;
        entry.asked_by = plan.wanted ? "options" : "";
    }
    for (const char* phase : {"near", "count", "fill"})
        report_.entry(phase).reason = "of all lists";
    ReportEntry& scratch = report_.entry("scratch");
    scratch.reason = "kept for the next build";
    scratch.bytes = scratch_.bytes();
    report_.counter("near bytes") = near_.bytes();
}

void TraversalBuild::publish(TraversalState& state) {
    state.base.each([](Csr& rows) { rows.publish(); });
    std::size_t k = 0;
    state.each_list([&](BoxRows& rows) {
        const Plan& plan = plans_[k++];
        plan.wanted ? rows.publish() : rows.clear();
        report_.entry(plan.name).bytes = rows.bytes();
    });
    auto& levels = state.smaller.levels;
    if (!plans_.back().wanted) state.smaller.each([](auto& rows) { rows.clear(); });
    levels.erase(levels.begin() + (plans_.back().wanted ? n_levels() : 0), levels.end());
    Offset bytes = 0;
    state.smaller.each([&](auto& rows) {
        if (plans_.back().wanted) rows.publish();
        bytes += rows.bytes();
    });
    report_.entry("from_sep_smaller").bytes = bytes;
    report_.entry("near").ms = ms_near_;
    report_.entry("count").ms = ms_count_ - ms_near_;
    report_.entry("fill").ms = watch_.ms() - ms_count_;
    state.report = std::move(report_);
    state.tree = tables_.tree;
    state.options = options_;
    state.options.source_boxes_mask = state.options.source_parent_boxes_mask = {};
    state.has_close = has_close_;
    state.built = true;
}

}  // namespace connectivity::detail
