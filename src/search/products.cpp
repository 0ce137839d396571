// SPDX-License-Identifier: BSD-3-Clause
#include "products.hpp"

namespace connectivity::detail {

namespace {

/// Neighbours counted for a slot: its row, or its half row if only pairs are built.
Offset length_of(const Counts& counts, const SlotLayout& layout, Offset slot) {
    const Offset row = layout.row_of_slot(slot);
    if (!counts.has_rows) return counts.halves[slot];
    if (row < 0) return 0;
    Offset length = 0;
    for (int l = 0; l < layout.n_lists(); ++l) length += counts.rows[row * layout.n_lists() + l];
    return length;
}

}  // namespace

void throw_over_budget(const Counts& counts, const SlotLayout& layout, Offset needed,
                       Offset allowed) {
    Offset worst = 0, most = -1, entries = 0, pairs = 0;
    for (Offset slot = 0; slot < layout.n_slots(); ++slot) {
        const Offset length = length_of(counts, layout, slot);
        if (length > most) most = length, worst = slot;
        if (counts.has_rows) entries += length;
        if (counts.has_halves) pairs += counts.halves[slot];
    }
    const int list = layout.list_of_slot(worst);
    std::string text =
        "the result needs " + std::to_string(needed) + " bytes (" + human_bytes(needed) + "):";
    if (counts.has_rows) text += " " + std::to_string(entries) + " row entries";
    if (counts.has_halves)
        text += (counts.has_rows ? " and " : " ") + std::to_string(pairs) + " pairs";
    throw Error(Status::budget, text + "; allowed are " + std::to_string(allowed) + " bytes (" +
                                    human_bytes(allowed) + "); most " +
                                    (counts.has_rows ? "neighbours" : "pairs") + ": node list " +
                                    std::to_string(list) + ", node " +
                                    std::to_string(worst - layout.list_offset()[list]) + " with " +
                                    std::to_string(most));
}

void Products::abandon() {
    rows.abandon();
    halves.abandon();
}

Offset Products::prepare(const Counts& counts, const SlotLayout& layout, const Budget& budget) {
    Offset needed = 0;
    try {
        if (counts.has_rows)
            needed += rows.prepare(layout.n_rows() * layout.n_lists(),
                                   [c = counts.rows](Offset i) { return c[i]; });
        if (counts.has_halves)
            needed +=
                halves.prepare(layout.n_slots(), [c = counts.halves](Offset i) { return c[i]; });
        if (!budget.allows(needed)) throw_over_budget(counts, layout, needed, budget.allowed());
        if (counts.has_rows) rows.reserve();
        if (counts.has_halves) halves.reserve();
    } catch (...) {
        abandon();
        throw;
    }
    return needed;
}

}  // namespace connectivity::detail
