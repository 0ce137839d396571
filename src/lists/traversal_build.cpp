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

TraversalBuild::TraversalBuild(const TreeView& tree, const TraversalOptions& options)
    : options_(checked(options, tree)),
      tables_(tree),
      separation_(tree, options),
      near_(tables_, separation_, options, options.same_level_non_well_sep_boxes),
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
    for (int level = 0; level < tree.n_levels; ++level) {
        for (Base* base : {&sources_, &targets_, &source_parents_, &target_parents_})
            base->level_starts.push_back(static_cast<Offset>(base->boxes.size()));
        for (BoxId b = tree.level_start_box_nrs(level); b < tree.level_start_box_nrs(level + 1);
             ++b) {
            const unsigned flags = tables_.flags(b);
            if ((flags & box_flag::has_own_sources) && passes(options_.source_boxes_mask, b))
                sources_.boxes.push_back(b);
            if ((flags & box_flag::has_child_sources) &&
                passes(options_.source_parent_boxes_mask, b))
                source_parents_.boxes.push_back(b);
            if (flags & box_flag::has_own_targets) targets_.boxes.push_back(b);
            if (flags & target_flags) target_parents_.boxes.push_back(b);
        }
    }
    for (Base* base : {&sources_, &targets_, &source_parents_, &target_parents_})
        base->level_starts.push_back(static_cast<Offset>(base->boxes.size()));
}

void TraversalBuild::count_targets() {
    if (!options_.neighbor_source_boxes && !options_.from_sep_smaller) return;
    const auto chunks = static_cast<std::size_t>(n_chunks(n_targets(), chunk));
    n_near_.resize(targets_.boxes.size());
    n_close_.resize(targets_.boxes.size());
    smaller_entries_.assign(chunks * static_cast<std::size_t>(n_levels()), 0);
    smaller_rows_ = smaller_entries_;
    for_each_chunk("lists/count", n_targets(), chunk, [&](Offset c, Offset first, Offset last) {
        CountSink sink{tables_, options_.from_sep_smaller, &smaller_entries_[cell(c, 0)],
                       &smaller_rows_[cell(c, 0)]};
        TargetWalk walk(tables_, separation_, sink);
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
            sink.target = targets_.boxes[i];
            sink.n_near = sink.n_close = 0;
            walk(sink.target, near_.row(sink.target));
            n_near_[i] = sink.n_near;
            n_close_[i] = sink.n_close;
        }
    });
}

void TraversalBuild::prepare_lists(TraversalState& state) {
    const auto nth = [](const std::vector<Offset>& counts) {
        return [&](Offset i) { return counts[static_cast<std::size_t>(i)]; };
    };
    const auto n_target_parents = static_cast<Offset>(target_parents_.boxes.size());
    const bool smaller = options_.from_sep_smaller, bigger = options_.from_sep_bigger;
    plan("same_level_non_well_sep_boxes", options_.same_level_non_well_sep_boxes, state.same_level,
         tables_.tree.n_boxes, [&](Offset b) { return near_.n_same_level(static_cast<BoxId>(b)); });
    plan("neighbor_source_boxes", options_.neighbor_source_boxes, state.neighbors, n_targets(),
         nth(n_near_));
    plan("from_sep_siblings", options_.from_sep_siblings, state.siblings, n_target_parents,
         [&](Offset i) { return near_.n_from_sep_siblings(target_parent(i)); });
    plan("from_sep_close_smaller", has_close_ && smaller, state.close_smaller, n_targets(),
         nth(n_close_));
    plan("from_sep_bigger", bigger, state.bigger, n_target_parents, [&](Offset i) {
        Offset n = 0;
        near_.make_row(
            target_parent(i), [](const Near&) {}, [&](BoxId, ImageCode) { ++n; });
        return n;
    });
    plan("from_sep_close_bigger", has_close_ && bigger, state.close_bigger, n_targets(),
         [&](Offset i) {
             Offset n = 0;
             for (const Near& e : near_.row(target(i))) n += e.open();
             return n;
         });
    const auto by_level = [&](Csr& rows, const Base& base) {
        rows.prepare(n_levels(), [&](Offset level) { return base.n_in(level); });
    };
    by_level(state.base.sources, sources_);
    by_level(state.base.targets, targets_);
    by_level(state.base.source_parents, source_parents_);
    by_level(state.base.target_parents, target_parents_);
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
                entries += std::exchange(smaller_entries_[cell(c, level)], entries);
                rows += std::exchange(smaller_rows_[cell(c, level)], rows);
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
    report_.entry("near").reason = "temporary, for all lists";
    report_.entry("count").reason = "of all lists";
    report_.entry("fill").reason = "of all lists";
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
