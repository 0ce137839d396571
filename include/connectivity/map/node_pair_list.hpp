// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The list of interacting pairs: unordered {i, j}, each once, i before j, sorted by (i, j).
///
/// Storage is half rows: per slot i the sorted partners after it, 4 bytes a pair and 8 a slot. The
/// i of a pair is found by binary search, or read from an array that is expanded only for callers
/// who want a flat list.

#include <string>

#include <connectivity/base/csr.hpp>

namespace connectivity {

class NodePairList {
public:
    /// Trivially copyable; captured by value in kernels.
    template <class Space = HostMemory>
    struct View {
        ConstView<Offset, Space>
            offsets;  ///< [n_slots + 1]: pairs whose first slot is i are [offsets(i), offsets(i+1))
        ConstView<Slot, Space> j;  ///< [n_pairs]
        ConstView<Slot, Space> i;  ///< [n_pairs], empty unless expanded
        Generation generation = 0;

        KOKKOS_INLINE_FUNCTION Offset size() const { return static_cast<Offset>(j.extent(0)); }
        KOKKOS_INLINE_FUNCTION Offset n_slots() const {
            return static_cast<Offset>(offsets.extent(0)) - 1;
        }
        KOKKOS_INLINE_FUNCTION const Slot* data() const { return j.data(); }

        struct Pair {
            Slot i, j;
        };
        /// Pair k. Costs a binary search over slots unless i is expanded: loop over slots instead
        /// where you can.
        KOKKOS_INLINE_FUNCTION Pair operator[](Offset k) const { return {first(k), j(k)}; }

        /// Number of the pair {a, b}, in either orientation; -1 if there is none. Binary search in
        /// a half row.
        KOKKOS_INLINE_FUNCTION Offset find(Slot a, Slot b) const {
            const Slot lo = a < b ? a : b, hi = a < b ? b : a;
            if (lo < 0 || hi >= n_slots()) return -1;
            Offset begin = offsets(lo), end = offsets(lo + 1);
            while (begin < end) {
                const Offset middle = begin + (end - begin) / 2;
                if (j(middle) < hi)
                    begin = middle + 1;
                else
                    end = middle;
            }
            return begin < offsets(lo + 1) && j(begin) == hi ? begin : -1;
        }

    private:
        KOKKOS_INLINE_FUNCTION Slot first(Offset k) const {
            if (i.extent(0) > 0) return i(k);
            Offset begin = 0, end = n_slots();  // the last slot whose offset is <= k
            while (end - begin > 1) {
                const Offset middle = begin + (end - begin) / 2;
                if (offsets(middle) <= k)
                    begin = middle;
                else
                    end = middle;
            }
            return static_cast<Slot>(begin);
        }
    };

    NodePairList() : half_rows_("map/pairs") {}

    Offset size() const { return half_rows_.n_values(); }
    Generation generation() const { return generation_; }
    Offset bytes() const;

    /// Host view; holds the storage, so it stays valid and unchanged through rebuilds.
    View<> view() const { return {half_rows_.offsets(), half_rows_.values(), {}, generation_}; }

    /// Host view with i expanded: 4 more bytes a pair, made once per generation. Throws
    /// Error{memory}.
    View<> expanded_view();

private:
    friend class ConnectivityMap;
    Csr half_rows_;
    connectivity::View<Slot> first_;   // storage of expanded i
    Generation first_generation_ = 0;  // the generation it holds
    Generation generation_ = 0;
};

}  // namespace connectivity
