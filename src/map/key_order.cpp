// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/key_order.hpp>

#include <connectivity/base/parallel_sort.hpp>
#include <connectivity/keys/morton.hpp>

namespace connectivity {

namespace {

using Slots = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// What of a list the order asks for; slots are counted from its first one.
struct ListIds {
    Offset n_internal;
    const std::int64_t* global_id;  // null: node ids
    const Slot* owner;              // by ghost; null: none has one

    Offset owner_of(Offset node) const {
        if (owner == nullptr || node < n_internal || owner[node - n_internal] < 0) return node;
        return owner[node - n_internal];
    }
    std::int64_t id(Offset node) const {
        const Offset named = owner_of(node);
        return global_id != nullptr ? global_id[named] : named;
    }
};

std::vector<ListIds> ids_of(std::span<const NodeList> lists) {
    std::vector<ListIds> ids;
    for (const NodeList& list : lists) {
        for (std::size_t g = 0; g < list.owners().size(); ++g)
            if (const Slot owner = list.owners()(g); owner < -1 || owner >= list.n_internal())
                throw Error(Status::argument, "node list \"" + list.name() + "\": ghost " +
                                                  std::to_string(g) + " has owner " +
                                                  std::to_string(owner) + ", must be in [-1, " +
                                                  std::to_string(list.n_internal()) + ")");
        ids.push_back({list.n_internal(), list.global_ids().data(), list.owners().data()});
    }
    return ids;
}

/// The total order of nodes whose keys are equal.
template <int Dim>
struct TieBreak {
    const double* positions;
    const SlotLayout& layout;
    const ListIds* ids;

    bool operator()(Slot a, Slot b) const {
        for (int d = 0; d < Dim; ++d) {
            const double x = positions[Offset{a} * Dim + d], y = positions[Offset{b} * Dim + d];
            if (x != y) return x < y;
        }
        const int list_a = layout.list_of_slot(a), list_b = layout.list_of_slot(b);
        if (list_a != list_b) return list_a < list_b;
        const Offset first = layout.list_offset()[list_a];
        const std::int64_t id_a = ids[list_a].id(a - first), id_b = ids[list_a].id(b - first);
        return id_a != id_b ? id_a < id_b : a < b;
    }
};

/// Slot whose key a node has: its own or its owner's.
struct KeySlot {
    const SlotLayout& layout;
    const ListIds* ids;
    bool any_owner;

    Offset operator()(Offset slot) const {
        if (!any_owner) return slot;
        const int list = layout.list_of_slot(slot);
        const Offset first = layout.list_offset()[list];
        return first + ids[list].owner_of(slot - first);
    }
};

/// Bounding box of all nodes that have a key of their own.
template <int Dim>
KeyBox<Dim> key_box(const ConstView<double>& positions, Offset n, const KeySlot& key_slot) {
    if (!key_slot.any_owner) return bounding_key_box<Dim>(positions);
    KeyBox<Dim> box{};
    for (int d = 0; d < Dim; ++d) {
        Kokkos::MinMaxScalar<double> range{};
        Kokkos::parallel_reduce(
            "map/key_order/box", Slots(0, n),
            [=](const Offset slot, Kokkos::MinMaxScalar<double>& r) {
                const double x = positions(key_slot(slot) * Dim + d);
                if (x < r.min_val) r.min_val = x;
                if (x > r.max_val) r.max_val = x;
            },
            Kokkos::MinMax<double>(range));
        if (n > 0) box.lo[d] = range.min_val, box.hi[d] = range.max_val;
    }
    return box;
}

}  // namespace

void KeyOrder::take(Offset n) {
    ensure_capacity(slots_, "map/key_order/slots", n);
    ensure_capacity(ranks_, "map/key_order/ranks", n);
    ensure_capacity(keys_, "map/key_order/keys", n);
    n_ = n;
}

template <int Dim>
void KeyOrder::build(std::span<const NodeList> lists, ConstView<double> positions,
                     const SlotLayout& layout) {
    const std::vector<ListIds> ids = ids_of(lists);
    const bool any_owner =
        std::any_of(lists.begin(), lists.end(), [](auto& l) { return l.owners().size() > 0; });
    const KeySlot key_slot{layout, ids.data(), any_owner};
    const Offset n = layout.n_slots();
    take(n);
    ensure_capacity(entries_, "map/key_order/entries", n);
    ensure_capacity(scratch_, "map/key_order/scratch", n);

    const KeyBox<Dim> box = key_box<Dim>(positions, n, key_slot);
    const auto entries = entries_;
    Kokkos::parallel_for("map/key_order/keys", Slots(0, n), [=](const Offset slot) {
        entries(slot) = {box.key(positions.data() + key_slot(slot) * Dim), static_cast<Slot>(slot)};
    });
    HostExec().fence();
    const TieBreak<Dim> tie{positions.data(), layout, ids.data()};
    parallel_sort(entries_, scratch_, n, [=](const Entry& a, const Entry& b) {
        return a.key != b.key ? a.key < b.key : tie(a.slot, b.slot);
    });
    const auto sorted = entries_;
    const auto slots = slots_, ranks = ranks_;
    const auto keys = keys_;
    Kokkos::parallel_for("map/key_order/ranks", Slots(0, n), [=](const Offset rank) {
        slots(rank) = sorted(rank).slot;
        keys(rank) = sorted(rank).key;
        ranks(sorted(rank).slot) = static_cast<Slot>(rank);
    });
    HostExec().fence();
}

void KeyOrder::assign(const KeyOrder& old, const Slot* new_slot, Offset n) {
    take(n);
    Offset rank = 0;
    for (Offset k = 0; k < old.n_; ++k) {
        const Slot slot = new_slot[old.slots_(k)];
        if (slot < 0) continue;
        slots_(rank) = slot;
        keys_(rank) = old.keys_(k);
        ranks_(slot) = static_cast<Slot>(rank++);
    }
}

KeyOrderView<> KeyOrder::view() const {
    const auto all = std::pair<std::size_t, std::size_t>(0, n_);
    return {Kokkos::subview(slots_, all), Kokkos::subview(ranks_, all),
            Kokkos::subview(keys_, all)};
}

Offset KeyOrder::bytes() const {
    return static_cast<Offset>((slots_.size() + ranks_.size()) * sizeof(Slot) +
                               keys_.size() * sizeof(std::uint64_t) +
                               (entries_.size() + scratch_.size()) * sizeof(Entry));
}

template void KeyOrder::build<1>(std::span<const NodeList>, ConstView<double>, const SlotLayout&);
template void KeyOrder::build<2>(std::span<const NodeList>, ConstView<double>, const SlotLayout&);
template void KeyOrder::build<3>(std::span<const NodeList>, ConstView<double>, const SlotLayout&);

}  // namespace connectivity
