// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The list of interacting pairs: unordered {i, j}, each once, i before j, sorted by (i, j).
///
/// "Before" means the lower slot, in key order the lower rank. Storage is half rows: half row r
/// holds the partners after the node with slot (rank) r, ascending, 4 bytes a pair and 8 a slot.
/// The i of a pair is found by binary search, or read from an array that is expanded only for
/// callers who want a flat list. A stamp, unique in the process, tells this list from all others
/// and from its own older generations: what belongs to it remembers the stamp.

#include <string>

#include <connectivity/base/csr.hpp>
#include <connectivity/map/node_coupling.hpp>

namespace connectivity {

/// Identity of the content of a pair list.
using Stamp = std::uint64_t;

class NodePairList {
    /// Pairs by their nodes, on raw pointers.
    struct Lookup {
        const Offset* offsets;
        const Slot* j;
        const Slot* ranks;  ///< null in slot order
        Offset n_slots;

        KOKKOS_INLINE_FUNCTION Slot half_row(Slot slot) const {
            return ranks != nullptr ? ranks[slot] : slot;
        }
        /// Number of the pair {a, b}, -1 if there is none.
        KOKKOS_INLINE_FUNCTION Offset operator()(Slot a, Slot b) const {
            if (a < 0 || b < 0 || a >= n_slots || b >= n_slots) return -1;
            const Slot row_a = half_row(a), row_b = half_row(b);
            const Slot lo = row_a < row_b ? row_a : row_b, hi = row_a < row_b ? row_b : row_a;
            Offset begin = offsets[lo], end = offsets[lo + 1];
            while (begin < end) {
                const Offset middle = begin + (end - begin) / 2;
                if (half_row(j[middle]) < hi)
                    begin = middle + 1;
                else
                    end = middle;
            }
            return begin < offsets[lo + 1] && half_row(j[begin]) == hi ? begin : -1;
        }
    };

public:
    /// Trivially copyable; captured by value in kernels.
    template <class Space = HostMemory>
    struct View {
        ConstView<Offset, Space>
            offsets;  ///< [n_slots + 1]: pairs of half row r are [offsets(r), offsets(r + 1))
        ConstView<Slot, Space> j;  ///< [n_pairs]
        ConstView<Slot, Space> i;  ///< [n_pairs], empty unless expanded
        Generation generation = 0;
        Stamp stamp = 0;
        /// [n_pairs], in [0, 1]; empty means 1 for all pairs
        ConstView<double, Space> coupling = {};
        /// [n_slots], only in key order: slot by rank and rank by slot; empty in slot order
        ConstView<Slot, Space> slots = {}, ranks = {};

        KOKKOS_INLINE_FUNCTION Offset size() const { return static_cast<Offset>(j.extent(0)); }
        KOKKOS_INLINE_FUNCTION Offset n_slots() const {
            return static_cast<Offset>(offsets.extent(0)) - 1;
        }
        KOKKOS_INLINE_FUNCTION const Slot* data() const { return j.data(); }

        /// The node that half row r belongs to.
        KOKKOS_INLINE_FUNCTION Slot node(Offset r) const {
            return slots.extent(0) > 0 ? slots(r) : static_cast<Slot>(r);
        }
        /// The half row of a node.
        KOKKOS_INLINE_FUNCTION Slot half_row(Slot slot) const {
            return ranks.extent(0) > 0 ? ranks(slot) : slot;
        }

        struct Pair {
            Slot i, j;
        };
        /// Pair k. Costs a binary search over half rows unless i is expanded: loop over half rows
        /// instead where you can.
        KOKKOS_INLINE_FUNCTION Pair operator[](Offset k) const { return {first(k), j(k)}; }

        /// Number of the pair {a, b}, in either orientation; -1 if there is none. Binary search in
        /// a half row.
        KOKKOS_INLINE_FUNCTION Offset find(Slot a, Slot b) const {
            return Lookup{offsets.data(), j.data(), ranks.extent(0) > 0 ? ranks.data() : nullptr,
                          n_slots()}(a, b);
        }

    private:
        KOKKOS_INLINE_FUNCTION Slot first(Offset k) const {
            if (i.extent(0) > 0) return i(k);
            Offset begin = 0, end = n_slots();  // the last half row whose offset is <= k
            while (end - begin > 1) {
                const Offset middle = begin + (end - begin) / 2;
                if (offsets(middle) <= k)
                    begin = middle;
                else
                    end = middle;
            }
            return node(begin);
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

    /// Number of the pair {a, b}, in either orientation; -1 if there is none.
    Offset find(Slot a, Slot b) const {
        return Lookup{half_rows_.offset_data(), half_rows_.value_data(), ranks_.data(),
                      half_rows_.n_rows()}(a, b);
    }

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
    /// The same from values [size()], in the order of this list. Throws Error{argument} for another
    /// number of them, too.
    void set_coupling(std::span<const double> values);
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
    ConstView<Slot> slots_, ranks_;  // of key order
    PairCoupling coupling_;
    Stamp stamp_ = 0;
    connectivity::View<Slot> first_;   // storage of expanded i
    Generation first_generation_ = 0;  // the generation it holds
    Generation generation_ = 0;
};

}  // namespace connectivity
