// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <numeric>

#include "target_walk.hpp"
#include "traversal_build.hpp"

namespace connectivity::detail {
namespace {

/// Writes a row ordered by level, the deepest first, and otherwise as each(f) calls f(box, image);
/// each is called a second time where that is another order.
template <class Each>
void put_by_level(const TreeTables& tables, const BoxRows::Out& out, Offset begin,
                  const Each& each) {
    std::array<Offset, 257> places;  // [256 - level]: how many, then where the next one goes
    std::fill_n(places.end() - tables.tree.n_levels, tables.tree.n_levels, 0);
    const auto place_of = [&](BoxId box) -> Offset& {
        return places[static_cast<std::size_t>(256 - tables.level(box))];
    };
    Offset at = begin;
    bool ordered = true;
    each([&](BoxId box, ImageCode image) {
        ordered &= at == begin || tables.level(out.boxes[at - 1]) >= tables.level(box);
        out.put(at++, box, image);
        ++place_of(box);
    });
    if (ordered) return;
    std::exclusive_scan(places.end() - tables.tree.n_levels, places.end(),
                        places.end() - tables.tree.n_levels, begin);
    each([&](BoxId box, ImageCode image) { out.put(place_of(box)++, box, image); });
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

/// Makes rows another time where list 4 takes some of their entries.
void TraversalBuild::fill_bigger(BoxRows& rows) const {
    const Offset n = scratch_.target_parents.size();
    fill_rows(rows, n, [&](Offset i, const BoxRows::Out& out, Offset begin) {
        if (near_.row(target_parent(i)).n_from_sep_bigger == 0) return;
        put_by_level(tables_, out, begin, [&](const auto& put) {
            near_.make_row(
                target_parent(i), [](const Near&) {}, put);
        });
    });
}

void TraversalBuild::fill_close_bigger(BoxRows& rows) const {
    fill_rows(rows, n_targets(), [&](Offset i, const BoxRows::Out& out, Offset begin) {
        put_by_level(tables_, out, begin, [&](const auto& put) {
            for (const Near& e : near_.row(target(i)))
                if (e.open()) put(e.box, e.image);
        });
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
