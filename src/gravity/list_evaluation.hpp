// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The order of work of a fast multipole method on the lists of a traversal, for any expansion.
///
/// `Operators` has, for boxes by number; `worker` numbers the thread:
///     clear_moments(b), p2m(b), m2m(b, children)     moments of b from its own sources; children
///     clear_local(b)
///     m2l(b, boxes)                     local expansion of b from the moments of boxes (list 2)
///     p2l(worker, b, runs)              the same from sources (list 4)
///     l2l(b, children)                  local expansion of b to those of children
///     begin_targets(b), l2p(b)          own targets of b: sums are 0; add the local expansion
///     p2p(worker, b, runs)              own targets of b from sources (lists 1, 3 and 4 close)
///     m2p(b, boxes)                     own targets of b from moments (list 3)
///
/// Invariants: each function writes to its box or that box's own targets (l2l: to the children), in
/// an order that depends on the lists alone: the same bits for any number of threads. Every moment
/// and local expansion that is read was cleared. Cost: one call an entry of lists 2 and 3 at most.

#include <vector>

#include <connectivity/base/parallel.hpp>
#include <connectivity/base/report.hpp>
#include <connectivity/lists/traversal.hpp>

#include "base/first_exception.hpp"
#include "direct_kernels.hpp"

namespace connectivity::detail {

/// A row of a list: boxes, and where axes are periodic the image of each.
struct BoxEntries {
    const BoxId* boxes;
    Offset n;
    const ImageCode* images = nullptr;  ///< null: no_image

    static BoxEntries of(const BoxList& list, Offset row) {
        const Offset first = list.starts(row);
        return {list.lists.data() + first, list.starts(row + 1) - first,
                list.images.size() > 0 ? list.images.data() + first : nullptr};
    }
};

/// Consecutive sources, several boxes' where these lie side by side.
struct SourceRuns {
    std::vector<SourceRun> runs;
    Offset n = 0;  ///< sources

    void clear() { runs.clear(), n = 0; }
    void add(const SourceRun& run) {
        if (run.n == 0) return;
        n += run.n;
        if (!runs.empty()) {
            SourceRun& last = runs.back();
            if (last.image == run.image && last.first + last.n == run.first) {
                last.n += run.n;
                return;
            }
        }
        runs.push_back(run);
    }
    /// The own sources of boxes.
    void add(const TreeParticles& sources, const BoxEntries& entries) {
        for (Offset k = 0; k < entries.n; ++k) {
            const BoxId s = entries.boxes[k];
            add({sources.box_starts(s), sources.box_counts_nonchild(s),
                 entries.images != nullptr ? entries.images[k] : no_image});
        }
    }
};

template <class Operators>
class ListEvaluation {
public:
    /// All of it. Throws Error{memory} if rows of sources get no memory, and what the operators do.
    void run(const FMMTraversalInfo& lists, Operators& operators, Report& report) {
        lists_ = &lists;
        tree_ = &lists.tree();
        ops_ = &operators;
        if (tree_->n_boxes == 0) return;
        runs_.resize(static_cast<std::size_t>(n_workers()));
        locals_.assign(static_cast<std::size_t>(tree_->n_boxes), 0);
        timed(report, "moments", [&] { make_moments(); });
        timed(report, "far", [&] { make_locals(); });
        timed(report, "down", [&] { pass_down(); });
        timed(report, "near", [&] { sum_near(); });
        timed(report, "smaller", [&] { sum_smaller(); });
    }

    Offset bytes() const {
        Offset bytes = static_cast<Offset>(locals_.capacity());
        for (const SourceRuns& r : runs_)
            bytes += static_cast<Offset>(r.runs.capacity() * sizeof(SourceRun));
        return bytes;
    }

private:
    struct Children {
        BoxId box[8];
        int n = 0;
    };

    template <class Body>
    static void timed(Report& report, const char* phase, const Body& body) {
        const Stopwatch watch;
        body();
        report.entry(phase).ms = watch.ms();
    }

    /// body(worker, item), which may throw.
    template <class Body>
    static void for_each(const char* label, Offset n, const Body& body) {
        FirstException failure;
        for_each_dynamic(label, n, [&](int worker, Offset item) {
            if (failure.any()) return;
            try {
                body(worker, item);
            } catch (...) {
                failure.keep();
            }
        });
        failure.rethrow("list sums, for rows of sources,");
    }

    Children children_of(BoxId b, const TreeParticles& particles) const {
        Children children;
        for (int m = 0; m < 1 << tree_->dim; ++m)
            if (const BoxId c = tree_->child(m, b); c != 0 && particles.box_counts_cumul(c) > 0)
                children.box[children.n++] = c;
        return children;
    }

    void make_moments() {
        const TreeParticles& sources = tree_->sources;
        for (int level = tree_->n_levels - 1; level >= 0; --level) {
            const BoxId first = tree_->level_start_box_nrs(level);
            const Offset n = tree_->level_start_box_nrs(level + 1) - first;
            for_each("list_sums/moments", n, [&](int, Offset k) {
                const BoxId b = static_cast<BoxId>(first + k);
                ops_->clear_moments(b);
                if (sources.box_counts_nonchild(b) > 0) ops_->p2m(b);
                const Children children = children_of(b, sources);
                if (children.n > 0) ops_->m2m(b, {children.box, children.n});
            });
        }
    }

    void make_locals() {
        const auto boxes = lists_->target_or_target_parent_boxes();
        const BoxList siblings = lists_->from_sep_siblings(), bigger = lists_->from_sep_bigger();
        for_each("list_sums/far", static_cast<Offset>(boxes.size()), [&](int worker, Offset i) {
            const BoxId b = boxes(i);
            const BoxEntries entries = BoxEntries::of(siblings, i);
            SourceRuns& runs = runs_[worker];
            runs.clear();
            runs.add(tree_->sources, BoxEntries::of(bigger, i));
            locals_[b] = entries.n > 0 || runs.n > 0;
            ops_->clear_local(b);
            if (entries.n > 0) ops_->m2l(b, entries);
            if (runs.n > 0) ops_->p2l(worker, b, runs);
        });
    }

    void pass_down() {
        const auto boxes = lists_->target_or_target_parent_boxes();
        const auto levels = lists_->level_start_target_or_target_parent_box_nrs();
        for (int level = 0; level + 1 < tree_->n_levels; ++level) {
            const Offset first = levels(level);
            for_each("list_sums/down", levels(level + 1) - first, [&](int, Offset k) {
                const BoxId b = boxes(first + k);
                if (locals_[b] == 0) return;
                const Children children = children_of(b, tree_->targets);
                if (children.n > 0) ops_->l2l(b, {children.box, children.n});
                for (int c = 0; c < children.n; ++c) locals_[children.box[c]] = 1;
            });
        }
    }

    void sum_near() {
        const auto boxes = lists_->target_boxes();
        const BoxList touching = lists_->neighbor_source_boxes();
        const auto smaller = lists_->from_sep_close_smaller(),
                   bigger = lists_->from_sep_close_bigger();
        for_each("list_sums/near", static_cast<Offset>(boxes.size()), [&](int worker, Offset i) {
            const BoxId b = boxes(i);
            SourceRuns& runs = runs_[worker];
            runs.clear();
            runs.add(tree_->sources, BoxEntries::of(touching, i));
            if (smaller) runs.add(tree_->sources, BoxEntries::of(*smaller, i));
            if (bigger) runs.add(tree_->sources, BoxEntries::of(*bigger, i));
            ops_->begin_targets(b);
            if (runs.n > 0) ops_->p2p(worker, b, runs);
            if (locals_[b] != 0) ops_->l2p(b);
        });
    }

    void sum_smaller() {
        for (int level = 0; level < tree_->n_levels; ++level) {
            const LevelBoxList list = lists_->from_sep_smaller(level);
            for_each("list_sums/smaller", list.num_nonempty_lists(), [&](int, Offset j) {
                ops_->m2p(list.target_boxes_sep_smaller(j), BoxEntries::of(list, j));
            });
        }
    }

    const FMMTraversalInfo* lists_ = nullptr;
    const TreeView* tree_ = nullptr;
    Operators* ops_ = nullptr;
    std::vector<SourceRuns> runs_;      ///< [workers]
    std::vector<std::uint8_t> locals_;  ///< [boxes] whether the local expansion is not 0
};

}  // namespace connectivity::detail
