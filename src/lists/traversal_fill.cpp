// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "target_walk.hpp"
#include "traversal_build.hpp"

namespace connectivity::detail {
namespace {

/// Adds an entry behind [begin, end) of a row that is to be ordered by level, the deepest first.
void put_by_level(const TreeTables& tables, const BoxRows::Out& out, Offset begin, Offset end,
                  BoxId box, ImageCode image) {
    const int level = tables.level(box);
    for (; end > begin && tables.level(out.boxes[end - 1]) < level; --end)
        out.put(end, out.boxes[end - 1], out.images != nullptr ? out.images[end - 1] : no_image);
    out.put(end, box, image);
}

/// Where a chunk of target boxes writes its list 3 of one level.
struct LevelCursor {
    BoxRows::Out out;
    std::int32_t* indices;
    BoxId* targets;
    Offset row, entry;
    BoxId last = -1;  // target that wrote last
};

struct FillSink {
    const TreeTables& tables;
    BoxRows::Out near_out, close_out;
    LevelCursor* levels;  // null where list 3 is not asked for
    BoxId target = 0;
    Offset index = 0, near_at = 0, close_at = 0;

    bool wants_apart() const { return levels != nullptr; }
    void near(BoxId source, ImageCode image) {
        if (near_out.boxes != nullptr) near_out.put(near_at++, source, image);
    }
    void close(BoxId source, ImageCode image) { close_out.put(close_at++, source, image); }
    void smaller(BoxId source, ImageCode image) {
        LevelCursor& at = levels[tables.level(source)];
        if (at.last != target) {
            at.last = target;
            at.out.starts[at.row] = at.entry;
            at.indices[at.row] = static_cast<std::int32_t>(index);
            at.targets[at.row] = target;
            ++at.row;
        }
        at.out.put(at.entry++, source, image);
    }
};

/// fill(row, out, first entry) for all rows.
template <class Fill>
void fill_rows(BoxRows& rows, Offset n_rows, const Fill& fill) {
    const BoxRows::Out out = rows.out();
    for_each_chunk(rows.fill_label(), n_rows, 256, [&](Offset, Offset first, Offset last) {
        for (Offset i = first; i < last; ++i) fill(i, out, out.starts[i]);
    });
}

}  // namespace

void TraversalBuild::fill_bases(BaseLists& base) const {
    const auto fill = [](Csr& rows, const BaseBoxes& from) {
        std::copy(from.boxes.begin(), from.boxes.end(), rows.prepared_values());
    };
    fill(base.sources, scratch_.sources);
    fill(base.targets, scratch_.targets);
    fill(base.source_parents, scratch_.source_parents);
    fill(base.target_parents, scratch_.target_parents);
}

void TraversalBuild::fill_same_level(BoxRows& rows) const {
    fill_rows(rows, tables_.tree.n_boxes, [&](Offset i, const BoxRows::Out& out, Offset at) {
        const auto b = static_cast<BoxId>(i);
        for (const Near& e : near_.row(b))
            if (NearRows::is_same_level(b, e)) out.put(at++, e.box, e.image);
    });
}

void TraversalBuild::fill_siblings(BoxRows& rows) const {
    const Offset n = scratch_.target_parents.size();
    fill_rows(rows, n, [&](Offset i, const BoxRows::Out& out, Offset at) {
        near_.from_sep_siblings(
            target_parent(i), [&](BoxId source, ImageCode image) { out.put(at++, source, image); });
    });
}

/// Makes rows another time where list 4 takes some of them.
void TraversalBuild::fill_bigger(BoxRows& rows) const {
    const Offset n = scratch_.target_parents.size();
    fill_rows(rows, n, [&](Offset i, const BoxRows::Out& out, Offset begin) {
        if (near_.row(target_parent(i)).n_from_sep_bigger == 0) return;
        Offset at = begin;
        near_.make_row(
            target_parent(i), [](const Near&) {},
            [&](BoxId source, ImageCode image) {
                put_by_level(tables_, out, begin, at++, source, image);
            });
    });
}

void TraversalBuild::fill_close_bigger(BoxRows& rows) const {
    fill_rows(rows, n_targets(), [&](Offset i, const BoxRows::Out& out, Offset begin) {
        Offset at = begin;
        for (const Near& e : near_.row(target(i)))
            if (e.open()) put_by_level(tables_, out, begin, at++, e.box, e.image);
    });
}

void TraversalBuild::fill_targets(TraversalState& state) {
    const bool smaller = options_.from_sep_smaller;
    const auto out_of = [](BoxRows& rows, bool wanted) {
        return wanted ? rows.out() : BoxRows::Out{};
    };
    const auto near_out = out_of(state.neighbors, options_.neighbor_source_boxes),
               close_out = out_of(state.close_smaller, smaller && has_close_);
    for_each_chunk(walk_label_, n_targets(), chunk, [&](Offset c, Offset first, Offset last) {
        std::array<LevelCursor, 256> cursors;
        for (Offset l = 0; smaller && l < n_levels(); ++l) {
            const auto level = static_cast<std::size_t>(l);
            cursors[level] = {state.smaller.levels[level].out(),
                              state.smaller.indices.prepared_values() +
                                  state.smaller.indices.prepared_offsets()[l],
                              state.smaller.targets.prepared_values() +
                                  state.smaller.targets.prepared_offsets()[l],
                              scratch_.smaller_rows[cell(c, l)],
                              scratch_.smaller_entries[cell(c, l)]};
        }
        FillSink sink{tables_, near_out, close_out, smaller ? cursors.data() : nullptr};
        TargetWalk walk(tables_, separation_, sink);
        for (Offset i = first; i < last; ++i) {
            sink.target = target(i);
            sink.index = i;
            if (near_out.starts != nullptr) sink.near_at = near_out.starts[i];
            if (close_out.starts != nullptr) sink.close_at = close_out.starts[i];
            walk(sink.target, near_.row(sink.target));
        }
    });
}

void TraversalBuild::commit(TraversalState& state) {
    fill_bases(state.base);
    if (options_.same_level_non_well_sep_boxes) fill_same_level(state.same_level);
    if (options_.from_sep_siblings) fill_siblings(state.siblings);
    if (options_.from_sep_bigger) fill_bigger(state.bigger);
    if (options_.from_sep_bigger && has_close_) fill_close_bigger(state.close_bigger);
    if (options_.neighbor_source_boxes || options_.from_sep_smaller) fill_targets(state);
    publish(state);
}

}  // namespace connectivity::detail
