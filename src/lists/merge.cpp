// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include <connectivity/base/runtime.hpp>

#include "chunks.hpp"
#include "state.hpp"

namespace connectivity {
namespace {

Offset row_size(const BoxList& list, Offset row) {
    return list.size() == 0 ? 0 : list.starts(row + 1) - list.starts(row);
}

/// Writes a row behind others; where the next one begins.
Offset append(const BoxList& list, Offset row, const detail::BoxRows::Out& out, Offset at) {
    if (list.size() == 0) return at;
    for (Offset k = list.starts(row); k < list.starts(row + 1); ++k)
        out.put(at++, list.lists(k), list.image(k));
    return at;
}

void merge(detail::TraversalState& state) {
    const BoxList near = state.neighbors.view(), smaller = state.close_smaller.view(),
                  bigger = state.close_bigger.view();
    const Offset n_rows = near.size();
    detail::BoxRows joined("lists/neighbor_source_boxes");
    const bool periodic = std::ranges::count(state.tree.periodic, true) > 0;
    const Offset bytes = joined.prepare(n_rows, periodic, [&](Offset i) {
        return row_size(near, i) + row_size(smaller, i) + row_size(bigger, i);
    });
    if (!state.options.budget.allows(bytes))
        throw Error(Status::budget, "merged close lists need " + human_bytes(bytes) +
                                        ", the budget allows " +
                                        human_bytes(state.options.budget.allowed()));
    joined.reserve();
    const auto out = joined.out();
    detail::for_each_chunk("lists/merge", n_rows, 256, [&](Offset, Offset first, Offset last) {
        for (Offset i = first; i < last; ++i)
            append(bigger, i, out, append(smaller, i, out, append(near, i, out, out.starts[i])));
    });
    joined.publish();
    state.neighbors = joined;
    state.close_smaller.clear();
    state.close_bigger.clear();
    state.has_close = false;
    state.report.entry("neighbor_source_boxes").bytes = joined.bytes();
    for (const char* name : {"from_sep_close_smaller", "from_sep_close_bigger"}) {
        state.report.entry(name) = {.product = name, .asked_by = "", .reason = "merged"};
    }
}

}  // namespace

FMMTraversalInfo FMMTraversalInfo::merge_close_lists() const {
    if (state_->has_close && !has_neighbor_source_boxes())
        throw Error(Status::not_built,
                    "merge_close_lists: neighbor_source_boxes was not asked for in the last build "
                    "of the traversal");
    std::optional<FMMTraversalInfo> merged;
    run_kernels("merged lists", [&] {
        merged.emplace(*this);
        if (state_->has_close) merge(*merged->state_);
    });
    return *std::move(merged);
}

}  // namespace connectivity
