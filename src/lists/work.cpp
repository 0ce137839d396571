// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/lists/work.hpp>

#include <string>

#include <connectivity/base/runtime.hpp>

#include "chunks.hpp"

namespace connectivity {
namespace {

struct Counts {
    const std::int32_t *sources, *targets;

    Offset sources_in(const BoxList& list, Offset row) const {
        Offset n = 0;
        for (const BoxId s : list[row]) n += sources[s];
        return n;
    }
};

const std::int32_t* counts_of(const TreeParticles& particles, const char* name, Offset n_boxes) {
    if (static_cast<Offset>(particles.box_counts_nonchild.size()) < n_boxes)
        throw Error(Status::null, std::string("count_work: tree.") + name +
                                      ".box_counts_nonchild has fewer elements than boxes");
    return particles.box_counts_nonchild.data();
}

/// add(row, work of its box) for all rows.
template <class Add>
void each_row(const ConstView<BoxId>& boxes, const View<Work>& works, const Add& add) {
    detail::for_each_chunk("lists/work", static_cast<Offset>(boxes.size()), 256,
                           [&](Offset, Offset first, Offset last) {
                               for (Offset i = first; i < last; ++i) add(i, works(boxes(i)));
                           });
}

void count_targets(const FMMTraversalInfo& traversal, const Counts& counts,
                   const View<Work>& works) {
    const auto boxes = traversal.target_boxes();
    const auto direct = [&](const BoxList& list, Offset Work::*kind) {
        each_row(boxes, works, [&](Offset i, Work& work) {
            work.*kind += counts.targets[boxes(i)] * counts.sources_in(list, i);
        });
    };
    if (traversal.has_neighbor_source_boxes())
        direct(traversal.neighbor_source_boxes(), &Work::p2p);
    if (traversal.has_from_sep_smaller())
        if (const auto close = traversal.from_sep_close_smaller()) direct(*close, &Work::p2p_close);
    if (traversal.has_from_sep_bigger())
        if (const auto close = traversal.from_sep_close_bigger()) direct(*close, &Work::p2p_close);
    for (int level = 0; traversal.has_from_sep_smaller() && level < traversal.nlevels(); ++level) {
        const LevelBoxList list = traversal.from_sep_smaller(level);
        each_row(list.target_boxes_sep_smaller, works, [&](Offset j, Work& work) {
            const Offset n = list.starts(j + 1) - list.starts(j);
            work.from_sep_smaller_entries += n;
            work.m2p += n * counts.targets[list.target_boxes_sep_smaller(j)];
        });
    }
}

void count_target_parents(const FMMTraversalInfo& traversal, const Counts& counts,
                          const View<Work>& works) {
    const auto boxes = traversal.target_or_target_parent_boxes();
    if (traversal.has_from_sep_siblings()) {
        const BoxList list = traversal.from_sep_siblings();
        each_row(boxes, works,
                 [&](Offset i, Work& work) { work.m2l += list.starts(i + 1) - list.starts(i); });
    }
    if (traversal.has_from_sep_bigger()) {
        const BoxList list = traversal.from_sep_bigger();
        each_row(boxes, works, [&](Offset i, Work& work) {
            work.from_sep_bigger_entries += list.starts(i + 1) - list.starts(i);
            work.p2l += counts.sources_in(list, i);
        });
    }
}

void count_boxes(const TreeView& tree, const Counts& counts, const View<Work>& works) {
    using namespace box_flag;
    for (Offset b = 0; b < tree.n_boxes; ++b) {
        const unsigned flags = tree.box_flags(b);
        works(b).p2m += counts.sources[b];
        works(b).l2p += counts.targets[b];
        works(b).m2m += b > 0 && (flags & (has_own_sources | has_child_sources));
        works(b).l2l += b > 0 && (flags & (has_own_targets | has_child_targets));
    }
}

}  // namespace

Work& Work::operator+=(const Work& other) {
    for (Offset Work::*kind :
         {&Work::p2p, &Work::p2p_close, &Work::m2l, &Work::m2p, &Work::p2l, &Work::p2m, &Work::l2p,
          &Work::m2m, &Work::l2l, &Work::from_sep_smaller_entries, &Work::from_sep_bigger_entries})
        this->*kind += other.*kind;
    return *this;
}

double WorkWeights::of(const Work& work) const {
    const auto times = [](double weight, Offset n) { return weight * static_cast<double>(n); };
    return times(p2p, work.p2p + work.p2p_close) + times(m2l, work.m2l) + times(m2p, work.m2p) +
           times(p2l, work.p2l) + times(p2m, work.p2m) + times(l2p, work.l2p) +
           times(m2m, work.m2m) + times(l2l, work.l2l);
}

WorkCounts count_work(const FMMTraversalInfo& traversal) {
    WorkCounts work;
    run_kernels("count_work", [&] {
        const TreeView& tree = traversal.tree();
        if (tree.n_boxes == 0) return;
        const Counts counts{counts_of(tree.sources, "sources", tree.n_boxes),
                            counts_of(tree.targets, "targets", tree.n_boxes)};
        work.boxes = allocate_zeroed<Work>("lists/work", tree.n_boxes);
        count_targets(traversal, counts, work.boxes);
        count_target_parents(traversal, counts, work.boxes);
        count_boxes(tree, counts, work.boxes);
        for (Offset b = 0; b < tree.n_boxes; ++b) work.total += work.boxes(b);
    });
    return work;
}

}  // namespace connectivity
