// SPDX-License-Identifier: BSD-3-Clause
#include "renumbering.hpp"

#include <string>

namespace connectivity {

namespace {

std::string node_text(const PatchSource& source, Offset slot) {
    const int list = source.layout.list_of_slot(slot);
    return "patch: node list " + std::to_string(list) + " (\"" +
           source.names[static_cast<std::size_t>(list)] + "\"), node " +
           std::to_string(slot - source.layout.list_offset()[static_cast<std::size_t>(list)]) +
           ": ";
}

void check_sizes(const PatchSource& source, std::span<const Slot> keep,
                 std::span<const Slot> old2new) {
    const Offset n = source.layout.n_slots();
    for (const auto& [name, size] :
         {std::pair{"keep", keep.size()}, std::pair{"old2new", old2new.size()}})
        if (static_cast<Offset>(size) != n)
            throw Error(Status::argument, std::string("patch: ") + name + " has " +
                                              std::to_string(size) + " values, must be " +
                                              std::to_string(n) + ", one for each node");
    for (Offset slot = 0; slot < n; ++slot)
        if (const Slot flag = keep[static_cast<std::size_t>(slot)]; flag != 0 && flag != 1)
            throw Error(Status::argument, node_text(source, slot) + "keep = " +
                                              std::to_string(flag) + ", must be 0 or 1");
}

/// How many of each list stay, and of its internal nodes.
std::vector<ListSize> sizes_after(const PatchSource& source, std::span<const Slot> keep) {
    std::vector<ListSize> sizes;
    for (std::size_t l = 0; l < source.n_internal.size(); ++l) {
        const Offset first = source.layout.list_offset()[l],
                     last = source.layout.list_offset()[l + 1];
        sizes.emplace_back();
        for (Offset slot = first; slot < last; ++slot) {
            const Offset kept = keep[static_cast<std::size_t>(slot)];
            sizes.back().n += kept;
            if (slot - first < source.n_internal[l]) sizes.back().n_internal += kept;
        }
    }
    return sizes;
}

/// Allowed new ids of a node: [first, last).
struct Ids {
    Offset first, last;
};

Ids allowed_ids(const ListSize& size, bool internal) {
    return internal ? Ids{0, size.n_internal} : Ids{size.n_internal, size.n};
}

}  // namespace

Renumbering read_renumbering(const PatchSource& source, std::span<const Slot> keep,
                             std::span<const Slot> old2new) {
    check_sizes(source, keep, old2new);
    const std::vector<ListSize> sizes = sizes_after(source, keep);
    Renumbering out;
    out.layout = SlotLayout(sizes, source.all_rows);
    for (const ListSize& size : sizes) out.n_internal.push_back(size.n_internal);
    out.new_slot = allocate<Slot>("map/patch/new_slot", source.layout.n_slots());
    out.old_slot = allocate<Slot>("map/patch/old_slot", out.layout.n_slots());
    Kokkos::deep_copy(out.old_slot, -1);
    Slot last = -1;
    for (Offset slot = 0; slot < source.layout.n_slots(); ++slot) {
        const auto at = static_cast<std::size_t>(slot);
        out.new_slot(slot) = -1;
        if (keep[at] == 0) continue;
        const auto list = static_cast<std::size_t>(source.layout.list_of_slot(slot));
        const bool internal = slot - source.layout.list_offset()[list] < source.n_internal[list];
        const Ids allowed = allowed_ids(sizes[list], internal);
        if (old2new[at] < allowed.first || old2new[at] >= allowed.last)
            throw Error(Status::argument, node_text(source, slot) +
                                              "old2new = " + std::to_string(old2new[at]) +
                                              ", must be in [" + std::to_string(allowed.first) +
                                              ", " + std::to_string(allowed.last) + ") for this " +
                                              (internal ? "internal node" : "ghost"));
        const auto now = static_cast<Slot>(out.layout.list_offset()[list] + old2new[at]);
        if (out.old_slot(now) >= 0)
            throw Error(Status::argument, node_text(source, slot) +
                                              "old2new = " + std::to_string(old2new[at]) +
                                              " is the new id of an earlier node, too");
        out.old_slot(now) = static_cast<Slot>(slot);
        out.new_slot(slot) = now;
        out.keeps_order = out.keeps_order && now > last;
        last = now;
    }
    if (source.layout.active().size() > 0) {
        const auto active = allocate<std::uint8_t>("map/active", out.layout.n_slots());
        for (Offset slot = 0; slot < out.layout.n_slots(); ++slot)
            active(slot) = source.layout.active()(out.old_slot(slot));
        out.layout = SlotLayout(sizes, source.all_rows, active);
    }
    return out;
}

}  // namespace connectivity
