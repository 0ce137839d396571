// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/target_filter.hpp>

#include <string>
#include <vector>

namespace connectivity {

namespace {

/// User index of each target in tree order. Throws Error{argument}.
std::vector<std::int32_t> user_ids(const TreeView& tree, std::size_t n_flags) {
    const auto n = static_cast<std::size_t>(tree.targets.n);
    if (n_flags != n)
        throw Error(Status::argument, "there are " + std::to_string(n_flags) +
                                          " flags of targets, must be one for each of the " +
                                          std::to_string(n) + " targets");
    std::vector<std::int32_t> ids(n);
    for (std::size_t i = 0; i < n; ++i)
        ids[tree.sorted_target_ids(i)] = static_cast<std::int32_t>(i);
    return ids;
}

}  // namespace

Csr filter_targets_user_order(const TreeView& tree, std::span<const std::int8_t> flags) {
    const auto ids = user_ids(tree, flags.size());
    const auto for_each = [&](Offset b, const auto& f) {
        const Offset first = tree.targets.box_starts(b);
        for (Offset i = first; i < first + tree.targets.box_counts_nonchild(b); ++i)
            if (flags[ids[i]] != 0) f(ids[i]);
    };
    Csr out("tree/filtered_targets");
    out.prepare(tree.n_boxes, [&](Offset b) {
        Offset n = 0;
        for_each(b, [&](std::int32_t) { ++n; });
        return n;
    });
    out.reserve();
    out.commit([&](Offset first, Offset last, const Offset* offsets, Slot* values) {
        for (Offset b = first; b < last; ++b) {
            Slot* next = values + offsets[b];
            for_each(b, [&](std::int32_t id) { *next++ = id; });
        }
    });
    return out;
}

FilteredTargets filter_targets_tree_order(const TreeView& tree,
                                          std::span<const std::int8_t> flags) {
    const auto ids = user_ids(tree, flags.size());
    std::vector<std::int32_t> before(ids.size() + 1, 0);  // flagged ones among the first i
    for (std::size_t i = 0; i < ids.size(); ++i)
        before[i + 1] = before[i] + (flags[ids[i]] != 0 ? 1 : 0);
    FilteredTargets out;
    out.n = before.back();
    out.unfiltered_from_filtered = allocate<std::int32_t>("tree/filtered_targets", out.n);
    out.box_starts = allocate<std::int32_t>("tree/filtered_targets", tree.n_boxes);
    out.box_counts_nonchild = allocate<std::int32_t>("tree/filtered_targets", tree.n_boxes);
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (before[i + 1] > before[i])
            out.unfiltered_from_filtered(before[i]) = static_cast<std::int32_t>(i);
    for (Offset b = 0; b < tree.n_boxes; ++b) {
        const std::int32_t first = tree.targets.box_starts(b);
        out.box_starts(b) = before[first];
        out.box_counts_nonchild(b) =
            before[first + tree.targets.box_counts_nonchild(b)] - before[first];
    }
    return out;
}

}  // namespace connectivity
