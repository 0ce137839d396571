// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/node_pair_list.hpp>

namespace connectivity {

Offset NodePairList::bytes() const {
    return half_rows_.bytes() + static_cast<Offset>(first_.size() * sizeof(Slot));
}

NodePairList::View<> NodePairList::expanded_view() {
    View<> expanded = view();
    if (first_generation_ != generation_) {
        ensure_capacity(first_, "map/pairs/i", size());
        const auto offsets = expanded.offsets;
        const auto first = first_;
        Kokkos::parallel_for(
            "map/pairs/expand",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, half_rows_.n_rows()),
            [=](const Offset i) {
                for (Offset k = offsets(i); k < offsets(i + 1); ++k)
                    first(k) = static_cast<Slot>(i);
            });
        HostExec().fence();
        first_generation_ = generation_;
    }
    expanded.i = Kokkos::subview(first_, std::pair<Offset, Offset>(0, size()));
    return expanded;
}

}  // namespace connectivity
