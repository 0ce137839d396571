// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/search/layout.hpp>

namespace connectivity {

SlotLayout::SlotLayout(const std::vector<ListSize>& lists, bool ghost_rows,
                       ConstView<std::uint8_t> active)
    : list_offset_{0}, row_offset_{0}, active_(std::move(active)) {
    for (const ListSize& list : lists) {
        list_offset_.push_back(list_offset_.back() + list.n);
        row_offset_.push_back(row_offset_.back() + (ghost_rows ? list.n : list.n_internal));
    }
}

}  // namespace connectivity
