// SPDX-License-Identifier: BSD-3-Clause
#include "program/lists_scene.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace connectivity::program {

namespace {

/// Place of a number in ascending ones.
template <class T>
std::optional<Offset> place_of(const ConstView<T>& numbers, T number) {
    const T* const end = numbers.data() + numbers.size();
    const T* const at = std::lower_bound(numbers.data(), end, number);
    if (at == end || *at != number) return std::nullopt;
    return at - numbers.data();
}

bool is_split(const TreeView& tree, BoxId box) {
    for (int k = 0; k < 1 << tree.dim; ++k)
        if (tree.child(k, box) != 0) return true;
    return false;
}

class SceneBuilder {
public:
    SceneBuilder(const FMMTraversalInfo& lists, BoxId box)
        : lists_(lists), targets_(lists.target_boxes()) {
        scene_.tree = lists.tree();
        scene_.box = box;
        scene_.well_sep_is_n_away = lists.well_sep_is_n_away();
        scene_.exists.fill(true);
    }

    ListsScene build() {
        const TreeView& tree = scene_.tree;
        for (BoxId box = scene_.box; box != 0;) {
            box = tree.box_parent_ids(box);
            add_far(ListRole::siblings_of_ancestor, lists_.from_sep_siblings(), box);
        }
        for (BoxId box = scene_.box; box != 0;) {
            box = tree.box_parent_ids(box);
            add_far(ListRole::bigger_of_ancestor, lists_.from_sep_bigger(), box);
        }
        add_far(ListRole::siblings, lists_.from_sep_siblings(), scene_.box);
        add_smaller();
        add_far(ListRole::bigger, lists_.from_sep_bigger(), scene_.box);
        add_direct(ListRole::neighbor, lists_.neighbor_source_boxes());
        add_direct(ListRole::close_smaller, lists_.from_sep_close_smaller());
        add_direct(ListRole::close_bigger, lists_.from_sep_close_bigger());
        return std::move(scene_);
    }

private:
    void add(ListRole role, const BoxList& list, Offset row) {
        const TreeView& tree = scene_.tree;
        for (Offset e = list.starts(row); e < list.starts(row + 1); ++e) {
            const BoxId box = list.lists(e);
            const auto shift = image_shift(list.image(e));
            ListedBox listed{role, box, {}, tree.half_width(box), is_split(tree, box)};
            for (int d = 0; d < tree.dim; ++d) {
                const auto k = static_cast<std::size_t>(d);
                listed.center[k] = tree.center(d, box) + shift[k] * tree.root_extent;
            }
            scene_.listed.push_back(listed);
            ++scene_.counts[static_cast<std::size_t>(role)];
        }
    }
    /// Rows of boxes with targets in or below them.
    void add_far(ListRole role, const BoxList& list, BoxId box) {
        if (const auto row = place_of(lists_.target_or_target_parent_boxes(), box))
            add(role, list, *row);
    }
    /// Rows of boxes with own targets.
    void add_direct(ListRole role, const std::optional<BoxList>& list) {
        scene_.exists[static_cast<std::size_t>(role)] = list.has_value();
        const auto row = place_of(targets_, scene_.box);
        if (list && row) add(role, *list, *row);
    }
    void add_smaller() {
        const auto row = place_of(targets_, scene_.box);
        if (!row) return;
        for (int level = 0; level < lists_.nlevels(); ++level) {
            const LevelBoxList list = lists_.from_sep_smaller(level);
            const auto at = place_of(list.nonempty_indices, static_cast<std::int32_t>(*row));
            if (at) add(ListRole::smaller, list, *at);
        }
    }

    const FMMTraversalInfo& lists_;
    ConstView<BoxId> targets_;
    ListsScene scene_;
};

}  // namespace

namespace {

/// Entries of list 3 of each target box.
std::vector<Offset> smaller_counts(const FMMTraversalInfo& lists) {
    std::vector<Offset> counts(static_cast<std::size_t>(lists.ntarget_boxes()), 0);
    for (int level = 0; level < lists.nlevels(); ++level) {
        const LevelBoxList list = lists.from_sep_smaller(level);
        for (Offset row = 0; row < list.size(); ++row)
            counts[static_cast<std::size_t>(list.nonempty_indices(row))] +=
                static_cast<Offset>(list[row].size());
    }
    return counts;
}

}  // namespace

BoxId telling_target_box(const FMMTraversalInfo& lists) {
    const auto targets = lists.target_boxes();
    if (targets.size() == 0)
        throw Error(Status::argument, "there are no targets, so no box has lists to draw");
    const auto smaller = smaller_counts(lists);
    const auto close_smaller = lists.from_sep_close_smaller(),
               close_bigger = lists.from_sep_close_bigger();
    const auto size_of = [](const auto& list, Offset row) {
        return static_cast<Offset>(list[row].size());
    };
    std::pair<int, Offset> most{-1, 0};  // kinds of lists, entries
    BoxId best = 0;
    for (Offset i = 0; i < static_cast<Offset>(targets.size()); ++i) {
        const Offset row = *place_of(lists.target_or_target_parent_boxes(), targets(i));
        std::pair<int, Offset> score{0, 0};
        for (const Offset n :
             {size_of(lists.neighbor_source_boxes(), i), size_of(lists.from_sep_siblings(), row),
              smaller[static_cast<std::size_t>(i)], size_of(lists.from_sep_bigger(), row),
              close_smaller ? size_of(*close_smaller, i) : 0,
              close_bigger ? size_of(*close_bigger, i) : 0}) {
            score.first += n > 0;
            score.second += n;
        }
        if (score <= most) continue;
        most = score;
        best = targets(i);
    }
    return best;
}

ListsScene lists_scene(const FMMTraversalInfo& lists, BoxId box) {
    if (box < 0 || box >= lists.nboxes())
        throw Error(Status::argument, fmt::format("there is no box {}, the tree has 0 to {}", box,
                                                  lists.nboxes() - 1));
    if (!place_of(lists.target_or_target_parent_boxes(), box))
        throw Error(Status::argument,
                    fmt::format("box {} has no lists: no targets are in or below it", box));
    return SceneBuilder(lists, box).build();
}

}  // namespace connectivity::program
