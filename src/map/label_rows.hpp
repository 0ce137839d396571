// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Rows by label, as builders of lists read them: one segment a label, labels ascending.
///
/// Nothing is owned; whoever holds one sees to it that the arrays live.

#include <span>

#include <connectivity/base/types.hpp>

namespace connectivity {

struct LabelRows {
    const Offset* offsets = nullptr;  ///< [n_labels + 1], host
    const Slot* values = nullptr;     ///< labels, host

    Offset size(Offset label) const { return offsets[label + 1] - offsets[label]; }
    std::span<const Slot> operator[](Offset label) const {
        return {values + offsets[label], static_cast<std::size_t>(size(label))};
    }

    /// Asks early for the row of a label; its offsets should be there already.
    void prefetch(Offset label) const {
        constexpr Offset line = 16, most = 8 * line;
        const Offset n = size(label) < most ? size(label) : most;
        for (Offset k = 0; k < n + line; k += line) __builtin_prefetch(values + offsets[label] + k);
    }
};

}  // namespace connectivity
