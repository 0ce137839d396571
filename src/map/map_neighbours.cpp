// SPDX-License-Identifier: BSD-3-Clause
// Neighbours of any two nodes together, pair or not.
#include <numeric>

#include "map_impl.hpp"
#include "segment.hpp"

namespace connectivity {

namespace {

/// Positions of some slots, [n * dim].
std::vector<double> positions_of(std::span<const NodeList> lists, const SlotLayout& layout,
                                 std::span<const Slot> slots) {
    std::vector<double> x;
    for (const Slot slot : slots) {
        const int list = layout.list_of_slot(slot), dim = lists[list].dim();
        const Offset node = slot - layout.list_offset()[list];
        for (int d = 0; d < dim; ++d) x.push_back(lists[list].positions()(node * dim + d));
    }
    return x;
}

/// Leaves those whose foot on the line from slots[a] to slots[b] lies between the two.
template <int Dim>
void keep_between(std::vector<Slot>& slots, std::size_t a, std::size_t b,
                  const std::vector<double>& x, const Domain& domain) {
    std::vector<Slot> places(slots.size());
    std::iota(places.begin(), places.end(), 0);
    detail::SegmentsFrom<Dim> segments;
    segments.start(x.data(), periods<Dim>(domain), static_cast<Slot>(a), places);
    segments.aim(b);
    std::size_t n = 0;
    for (std::size_t k = 0; k < slots.size(); ++k)
        if (k == a || k == b || segments.holds(k)) slots[n++] = slots[k];
    slots.resize(n);
}

}  // namespace

std::span<const Slot> ConnectivityMap::row_of(const char* call, Slot slot) const {
    const RowsView<> all = rows();
    const Offset n = layout_.n_slots(),
                 row = slot >= 0 && slot < n ? layout_.row_of_slot(slot) : -1;
    if (row < 0)
        throw Error(Status::argument,
                    std::string(call) + ": slot " + std::to_string(slot) +
                        (slot >= 0 && slot < n ? " has no row: a ghost without, or not active"
                                               : ", must be in [0, " + std::to_string(n) + ")"));
    return {all[row].begin(), static_cast<std::size_t>(all[row].size())};
}

/// Both ascending by slot: in key order rows are not.
std::vector<Slot> ConnectivityMap::common_neighbours(Slot a, Slot b) const {
    return combined("common_neighbours", a, b, false);
}

std::vector<Slot> ConnectivityMap::all_neighbours(Slot a, Slot b) const {
    return combined("all_neighbours", a, b, true);
}

std::vector<Slot> ConnectivityMap::combined(const char* call, Slot a, Slot b, bool all) const {
    const auto sorted = [&](Slot slot) {
        const std::span<const Slot> row = row_of(call, slot);
        std::vector<Slot> slots(row.begin(), row.end());
        std::sort(slots.begin(), slots.end());
        return slots;
    };
    const std::vector<Slot> of_a = sorted(a), of_b = sorted(b);
    std::vector<Slot> out;
    if (all) {
        std::set_union(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(out));
        return out;
    }
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                          std::back_inserter(out));
    for (const Slot self : {a, b})
        if (const auto at = std::lower_bound(out.begin(), out.end(), self);
            at == out.end() || *at != self)
            out.insert(at, self);
    return out;
}

std::vector<Slot> ConnectivityMap::common_neighbours(Slot a, Slot b,
                                                     std::span<const NodeList> lists) const {
    std::vector<Slot> slots = common_neighbours(a, b);
    bool same = static_cast<int>(lists.size()) == layout_.n_lists();
    for (std::size_t l = 0; same && l < lists.size(); ++l)
        same = lists[l].dim() == dim_ &&
               lists[l].n() == layout_.list_offset()[l + 1] - layout_.list_offset()[l];
    if (!same)
        throw Error(Status::argument,
                    "common_neighbours: lists differ from those of the last rebuild in number, "
                    "dimension or size");
    const auto place = [&](Slot slot) {
        return static_cast<std::size_t>(std::lower_bound(slots.begin(), slots.end(), slot) -
                                        slots.begin());
    };
    // The line runs as that of the pair would.
    const bool by_key = options_.order == ListOrder::key;
    const bool turned = by_key ? key_order_.ranks()[b] < key_order_.ranks()[a] : b < a;
    const std::size_t first = place(turned ? b : a), second = place(turned ? a : b);
    const std::vector<double> x = positions_of(lists, layout_, slots);
    switch (dim_) {
        case 1: keep_between<1>(slots, first, second, x, options_.domain); break;
        case 2: keep_between<2>(slots, first, second, x, options_.domain); break;
        default: keep_between<3>(slots, first, second, x, options_.domain);
    }
    return slots;
}

}  // namespace connectivity
