// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The list of interacting pairs: unordered {i, j}, each once, i before j, sorted by (i, j).
///
/// Storage is half rows: per slot i the sorted partners after it, 4 bytes a pair and 8 a slot. The
/// i of a pair is found by binary search, or read from an array that is expanded only for callers
/// who want a flat list. A stamp, unique in the process, tells this list from all others and from
/// its own older generations: what belongs to it remembers the stamp.

#include <string>

#include <connectivity/base/csr.hpp>
#include <connectivity/map/node_coupling.hpp>

namespace connectivity {

/// Identity of the content of a pair list.
using Stamp = std::uint64_t;

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
        Stamp stamp = 0;
        /// [n_pairs], in [0, 1]; empty means 1 for all pairs
        ConstView<double, Space> coupling = {};

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
    /// Of all pair lists of the process, only copies of this one have the same stamp. 0: not built.
    Stamp stamp() const { return stamp_; }
    Offset bytes() const;  ///< coupling included

    /// Host view; holds the storage, so it stays valid and unchanged through rebuilds.
    View<> view() const;

    /// Number of the pair {a, b}, in either orientation; -1 if there is none. In loops, ask a view.
    Offset find(Slot a, Slot b) const { return view().find(a, b); }

    /// Host view with i expanded: 4 more bytes a pair, made once per generation. Throws
    /// Error{memory}.
    View<> expanded_view();

    /// Coupling of pair k of [0, size()): 1 unless set. A rebuild forgets all coupling, a patch
    /// carries that of surviving pairs.
    double coupling(Offset k) const { return coupling_[k]; }
    bool has_coupling() const { return coupling_.exists(); }

    /// Coupling of every pair from f(slot i, slot j), i before j, called in parallel. Throws
    /// Error{argument} for the first pair with a value outside [0, 1], Error{not_built},
    /// Error{memory}, and what f throws; the old coupling then stays.
    void set_coupling(NodeCoupling f);
    /// Coupling of pair k alone. Throws Error{argument}, Error{not_built}, Error{memory}.
    void set_coupling(Offset k, double value);
    /// Back to 1 for all pairs, without storage.
    void clear_coupling() { coupling_.clear(); }

private:
    friend class ConnectivityMap;
    /// After half_rows_ changed: a new stamp (0 if nothing was built), no coupling.
    void start_generation(Generation generation, bool built) noexcept;
    /// After half_rows_ was patched and coupling_.prepare_remap called: a new stamp.
    void continue_generation(Generation generation) noexcept;
    void require_built(const char* call) const;

    Csr half_rows_;
    PairCoupling coupling_;
    Stamp stamp_ = 0;
    connectivity::View<Slot> first_;   // storage of expanded i
    Generation first_generation_ = 0;  // the generation it holds
    Generation generation_ = 0;
};

}  // namespace connectivity
