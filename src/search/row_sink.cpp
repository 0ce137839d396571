// SPDX-License-Identifier: BSD-3-Clause
#include "row_sink.hpp"

#include <algorithm>

namespace connectivity::detail {

void RowSink::want(const SlotLayout& layout, bool rows, bool halves) {
    layout_ = &layout;
    rows_ = rows;
    halves_ = halves;
    last_stored_ = -1;
    for (int l = 0; l < layout.n_lists(); ++l) {
        const Offset n_stored = layout.row_offset()[l + 1] - layout.row_offset()[l];
        if (n_stored > 0) last_stored_ = static_cast<Slot>(layout.list_offset()[l] + n_stored - 1);
    }
}

int RowSink::keep_stored(Slot* row, int n) const {
    return static_cast<int>(
        std::remove_if(row, row + n, [this](Slot s) { return !layout_->is_stored(s); }) - row);
}

}  // namespace connectivity::detail
