// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// For every entry of the rows, the number of the pair that it is one half of: what a node needs to
/// gather values of its pairs.
///
/// Invariant: an entry of row a naming b has the number of the pair {a, b}. Made for one generation
/// of one map, whose lists it does not hold. Cost: 4 bytes a row entry, 4 a row and 8 a slot (key
/// order: for each list); passes over the pairs, one of which every thread makes to share out what
/// goes to its own rows.

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity {

class RowPairs {
public:
    /// With the lists it was made for; captured by value in kernels.
    template <class Space = HostMemory>
    struct View {
        RowsView<Space> rows;
        NodePairList::View<Space> pairs;
        ConstView<std::uint32_t, Space> pair;  ///< [n_entries], beside rows.slots
        ConstView<Slot, Space> slot;           ///< [n_rows], whose row it is

        KOKKOS_INLINE_FUNCTION Offset size() const { return static_cast<Offset>(pair.extent(0)); }
        KOKKOS_INLINE_FUNCTION const std::uint32_t* data() const { return pair.data(); }
        KOKKOS_INLINE_FUNCTION Offset operator[](Offset entry) const { return pair(entry); }
    };

    RowPairs() = default;
    /// Throws Error{not_built} unless the map has rows and pairs, Error{too_many} for 2^32 pairs
    /// and more, Error{memory}.
    explicit RowPairs(const ConnectivityMap& map) { rebuild(map); }

    /// The same in the memory it has, where that suffices. If it throws, nothing changes but that
    /// it may be empty after Error{memory}.
    void rebuild(const ConnectivityMap& map);

    bool is_current(const ConnectivityMap& map) const;
    /// Throws Error{stale} unless made for this generation of this map, Error{not_built}.
    View<> view(const ConnectivityMap& map) const;

    Offset bytes() const;

private:
    connectivity::View<std::uint32_t> pair_;
    connectivity::View<Slot> slot_;
    connectivity::View<Offset> cursor_;  // of each slot, while pairs are numbered
    Stamp stamp_ = 0;
};

}  // namespace connectivity
