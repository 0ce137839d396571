// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The search problem as kernels read it: plain pointers, captured by value.
///
/// Invariant: every pointer leads to memory of the execution space. Nothing is owned.

#include "../group_order.hpp"
#include "box.hpp"

namespace connectivity::detail::device {

/// How slots are numbered; see SlotLayout.
struct Layout {
    int n_lists;
    const Offset* list_offset;   ///< [n_lists + 1]
    const Offset* row_offset;    ///< [n_lists + 1]
    const std::uint8_t* active;  ///< [n_slots], 0 or 1; nullptr: all are
    Offset last_stored;          ///< slot, -1: none
    bool rows, halves;           ///< what is asked for

    KOKKOS_INLINE_FUNCTION int list_of(Offset slot) const {
        int low = 0, high = n_lists;  // the last list that begins at or before the slot
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            (list_offset[middle] <= slot ? low : high) = middle;
        }
        return low;
    }
    /// Row of a slot, -1 if nothing is to be stored in it.
    KOKKOS_INLINE_FUNCTION Offset row_of(Offset slot) const {
        if (active != nullptr && active[slot] == 0) return -1;
        const int list = list_of(slot);
        const Offset row = row_offset[list] + (slot - list_offset[list]);
        return row < row_offset[list + 1] ? row : -1;
    }
    KOKKOS_INLINE_FUNCTION bool is_stored(Offset slot) const { return row_of(slot) >= 0; }
    /// Must anything be found for a slot?
    KOKKOS_INLINE_FUNCTION bool is_wanted(Offset slot) const {
        return (halves && slot <= last_stored) || (rows && is_stored(slot));
    }
};

template <int Dim>
struct Problem {
    static constexpr Offset leaf_stride = (Dim + 1) * leaf_size;

    Offset n, n_leaves, n_blocks;
    // The order.
    const Slot* slot;          ///< [n_leaves * 16], -1 where there is no node
    const Offset* block_leaf;  ///< [n_blocks + 1]
    const Slot* leaf_block;    ///< [n_leaves]
    const Offset* block_node;  ///< [n_blocks], of its tree node
    const ClassTree* tree;
    int n_trees;
    // What moves with the nodes.
    const double* place;   ///< [n * Dim], by slot: positions, folded on periodic axes
    const double* leaf_x;  ///< by leaf: place[Dim][16], reach²[16]
    const Box<Dim>* leaf;  ///< [n_leaves]
    const Box<Dim>* node;  ///< tree nodes in heap order, tree after tree
    const int* wanted;     ///< [n_blocks]: something must be found for a node of the block
    Nearness<Dim> near;
    // What decides.
    Significance<Dim> see;
    SearchMode mode;
    Layout layout;

    KOKKOS_INLINE_FUNCTION Box<Dim> box_in_leaf(Offset l, int k) const {
        const double* const x = leaf_x + l * leaf_stride + k;
        Box<Dim> box;
        box.set(x, leaf_size, x[Dim * leaf_size]);
        return box;
    }
    KOKKOS_INLINE_FUNCTION Box<Dim> box_of_slot(Offset i) const {
        Box<Dim> box;
        box.set(place + i * Dim, 1, see.reach2[i]);
        return box;
    }
};

}  // namespace connectivity::detail::device
