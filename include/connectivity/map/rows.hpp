// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Neighbour rows as kernels read them.

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Rows of the stored nodes: a counted handle, captured by value in kernels. Row r is node a of
/// list k with r = row_offset[k] + a; its neighbours in list l are slots(r, l), ascending; never
/// the node itself.
template <class Space = HostMemory>
struct RowsView {
    ConstView<Offset, Space> offsets;  ///< [n_rows * n_lists + 1]
    ConstView<Slot, Space> slots;      ///< [n_entries]
    int n_lists = 0;
    Generation generation = 0;

    KOKKOS_INLINE_FUNCTION Offset n_rows() const {
        return n_lists > 0 ? (static_cast<Offset>(offsets.extent(0)) - 1) / n_lists : 0;
    }
    KOKKOS_INLINE_FUNCTION Offset size() const { return static_cast<Offset>(slots.extent(0)); }
    KOKKOS_INLINE_FUNCTION const Slot* data() const { return slots.data(); }

    struct Range {
        const Slot *first, *last;
        KOKKOS_INLINE_FUNCTION const Slot* begin() const { return first; }
        KOKKOS_INLINE_FUNCTION const Slot* end() const { return last; }
        KOKKOS_INLINE_FUNCTION Offset size() const { return last - first; }
    };
    /// All neighbours of row r, lists one after the other: ascending slots.
    KOKKOS_INLINE_FUNCTION Range operator[](Offset r) const {
        return range(r * n_lists, (r + 1) * n_lists);
    }
    /// Neighbours of row r in list l.
    KOKKOS_INLINE_FUNCTION Range operator()(Offset r, int l) const {
        return range(r * n_lists + l, r * n_lists + l + 1);
    }

private:
    KOKKOS_INLINE_FUNCTION Range range(Offset first, Offset last) const {
        return {slots.data() + offsets(first), slots.data() + offsets(last)};
    }
};

/// For every pair the nodes that are neighbours of both, and the two themselves.
template <class Space = HostMemory>
struct IntersectionView {
    ConstView<Offset, Space> offsets;  ///< [n_pairs + 1]
    ConstView<Slot, Space> slots;      ///< [n_entries]
    bool in_segment = false;           ///< only those between the two
    Generation generation = 0;

    KOKKOS_INLINE_FUNCTION Offset n_pairs() const {
        return offsets.extent(0) > 0 ? static_cast<Offset>(offsets.extent(0)) - 1 : 0;
    }
    KOKKOS_INLINE_FUNCTION Offset size() const { return static_cast<Offset>(slots.extent(0)); }
    KOKKOS_INLINE_FUNCTION const Slot* data() const { return slots.data(); }
    KOKKOS_INLINE_FUNCTION typename RowsView<Space>::Range operator[](Offset pair) const {
        return {slots.data() + offsets(pair), slots.data() + offsets(pair + 1)};
    }
};

}  // namespace connectivity
