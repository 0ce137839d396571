// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Key order: all nodes by (Morton key, position, list, global id), whatever their storage.
///
/// Invariants: slots and ranks are inverse permutations of [0, n_slots); keys ascend. The keys'
/// box is the bounding box of all nodes but images, see NodeList::set_owners; an image has its
/// owner's key and id. Without global ids the node id is the last word, so coincident nodes of one
/// list keep their order of storage. Cost: one parallel sort of 16 bytes a node.

#include <span>

#include <connectivity/map/node_list.hpp>
#include <connectivity/search/layout.hpp>

namespace connectivity {

/// Captured by value in kernels.
template <class Space = HostMemory>
struct KeyOrderView {
    ConstView<Slot, Space> slots;          ///< [n_slots] by rank
    ConstView<Slot, Space> ranks;          ///< [n_slots] by slot
    ConstView<std::uint64_t, Space> keys;  ///< [n_slots] by rank
};

/// Storage of an order; views of it that are held elsewhere stay as they are.
class KeyOrder {
public:
    /// Orders the nodes of `lists`; positions [n_slots * Dim], lists laid end to end. Throws
    /// Error{argument} for an owner that is no internal node, Error{memory}; the order is then of
    /// no meaning.
    template <int Dim>
    void build(std::span<const NodeList> lists, ConstView<double> positions,
               const SlotLayout& layout);

    /// Keeps the nodes with new_slot[slot] >= 0, in the same order and with the same keys, under
    /// their new slots. n: how many there are. Throws Error{memory}.
    void assign(const KeyOrder& old, const Slot* new_slot, Offset n);

    Offset size() const { return n_; }
    KeyOrderView<> view() const;
    const Slot* slots() const { return slots_.data(); }
    const Slot* ranks() const { return ranks_.data(); }
    Offset bytes() const;
    void clear() { *this = KeyOrder(); }

private:
    struct Entry {
        std::uint64_t key;
        Slot slot;
    };
    void take(Offset n);

    Offset n_ = 0;
    View<Slot> slots_, ranks_;
    View<std::uint64_t> keys_;
    View<Entry> entries_, scratch_;  // of the sort
};

}  // namespace connectivity
