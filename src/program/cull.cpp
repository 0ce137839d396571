// SPDX-License-Identifier: BSD-3-Clause
#include "program/cull.hpp"

namespace connectivity::program {

namespace {

/// 1 for internal nodes and all that stand in their rows.
std::vector<Slot> named_by_internal(const ConnectivityMap& map) {
    const SlotLayout& layout = map.layout();
    std::vector<Slot> keep(static_cast<std::size_t>(layout.n_slots()), 0);
    for (std::size_t l = 0; l < map.n_internal().size(); ++l)
        for (Offset a = 0; a < map.n_internal()[l]; ++a) {
            keep[static_cast<std::size_t>(layout.list_offset()[l] + a)] = 1;
            for (const Slot j : map.rows()[layout.row_offset()[l] + a])
                keep[static_cast<std::size_t>(j)] = 1;
        }
    return keep;
}

/// Blocks of values of the nodes that stay.
template <class T>
ConstView<T> compacted(const ConstView<T>& values, std::span<const Slot> keep, Offset n) {
    if (values.size() == 0 || keep.empty()) return values;
    const Offset width = static_cast<Offset>(values.size()) / static_cast<Offset>(keep.size());
    const auto out = allocate<T>("program/cull", n * width);
    Offset at = 0;
    for (std::size_t a = 0; a < keep.size(); ++a)
        for (Offset c = 0; c < width && keep[a] != 0; ++c)
            out(at++) = values(static_cast<Offset>(a) * width + c);
    return out;
}

ListData compacted(const ListData& list, std::span<const Slot> keep, Offset n) {
    const NodeList& old = list.nodes;
    const auto positions = compacted(old.positions(), keep, n);
    ListData out{old.has_tensor()
                     ? NodeList::with_H(old.name(), old.dim(), old.n_internal(), positions,
                                        compacted(old.H(), keep, n), old.kernel_extent())
                     : NodeList::with_h(old.name(), old.dim(), old.n_internal(), positions,
                                        compacted(old.h(), keep, n), old.kernel_extent())};
    out.mass = compacted(list.mass, keep, n);
    out.density = compacted(list.density, keep, n);
    out.softening = compacted(list.softening, keep, n);
    out.global_id = compacted(list.global_id, keep, n);
    return out;
}

}  // namespace

NewSlots cull_ghosts(ConnectivityMap& map, std::vector<ListData>& lists) {
    const std::vector<Slot> keep = named_by_internal(map);
    const std::vector<Offset> first = map.layout().list_offset();
    std::vector<Slot> old2new(keep.size(), -1);
    for (std::size_t l = 0; l < lists.size(); ++l)
        for (Offset slot = first[l], next = 0; slot < first[l + 1]; ++slot)
            if (keep[static_cast<std::size_t>(slot)] != 0)
                old2new[static_cast<std::size_t>(slot)] = static_cast<Slot>(next++);
    map.patch(keep, old2new);
    for (std::size_t l = 0; l < lists.size(); ++l) {
        const Offset now = map.layout().list_offset()[l];
        const auto n_old = static_cast<std::size_t>(first[l + 1] - first[l]);
        const auto begin = static_cast<std::size_t>(first[l]);
        lists[l] = compacted(lists[l], std::span(keep).subspan(begin, n_old),
                             map.layout().list_offset()[l + 1] - now);
        for (std::size_t slot = begin; slot < begin + n_old; ++slot)
            if (old2new[slot] >= 0) old2new[slot] += static_cast<Slot>(now);
    }
    return old2new;
}

}  // namespace connectivity::program
