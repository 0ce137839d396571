// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The numbers that nodes have while lists are built: labels.
///
/// In slot order the label of a node is its slot, in key order its rank. Builders work on rows of
/// ascending labels, over all nodes, and hand them out through here: as slots, cut by target list.
/// Invariant: slot_of and label_of are inverse permutations of [0, n_slots), or both null.

#include <algorithm>

#include <connectivity/search/layout.hpp>

namespace connectivity {

struct Labels {
    const SlotLayout& layout;        ///< every node has a row: row number = slot
    const Slot* slot_of = nullptr;   ///< [n_slots]; null: labels are slots
    const Slot* label_of = nullptr;  ///< [n_slots], the inverse

    Slot slot(Slot label) const { return slot_of != nullptr ? slot_of[label] : label; }
    Slot label(Slot slot) const { return label_of != nullptr ? label_of[slot] : slot; }

    /// Adds the lengths of a row's segments, one for each target list, to counts[n_lists].
    void count_lists(const Slot* row, Offset n, Slot* counts) const {
        if (layout.n_lists() == 1)
            counts[0] += static_cast<Slot>(n);
        else
            for (Offset k = 0; k < n; ++k) ++counts[layout.list_of_slot(slot(row[k]))];
    }

    /// Writes a row of n ascending labels as slots: lists one after the other, labels ascending in
    /// each. Cost: one copy, and a sort of the row in key order of several lists.
    void write(const Slot* row, Offset n, Slot* out) const {
        for (Offset k = 0; k < n; ++k) out[k] = slot(row[k]);
        if (slot_of == nullptr || layout.n_lists() == 1) return;
        std::sort(out, out + n, [this](Slot a, Slot b) {
            const int list_a = layout.list_of_slot(a), list_b = layout.list_of_slot(b);
            return list_a != list_b ? list_a < list_b : label_of[a] < label_of[b];
        });
    }
};

}  // namespace connectivity
