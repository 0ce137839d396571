// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Last stage: the exact predicate on every node and every entry of its leaf's list, counted and
/// then written to its final place, ascending.
///
/// Invariants: each hit is decided in double by the one predicate. A float test before it would
/// spare little here: lists are narrowed to the leaf, so a seventh of the entries are hits in 3D,
/// and doubles cost a data-centre GPU twice a float; where a device is measured, that may change.
/// Every entry has its place before it is written, so lanes write side by side. Cost: two tests an
/// entry and pass.

#include "../products.hpp"
#include "leaf_lists.hpp"

namespace connectivity::detail::device {

template <class Exec, int Dim>
class Rows {
public:
    /// Makes room for counts, all zero. Throws Error{memory}.
    void begin(const Problem<Dim>& problem, const SlotLayout& layout);
    /// Counts for the nodes of the leaves [first, last), whose lists were filled last.
    void count(const Problem<Dim>& problem, const LeafLists<Exec, Dim>& lists, Offset first,
               Offset last);
    /// All counts, on the host.
    Counts counts();

    /// Where the prepared lists are to be written. Throws Error{memory}.
    void reserve(const Products& products);
    /// Writes the entries of the nodes of the leaves [first, last), whose lists were filled last.
    void fill(const Problem<Dim>& problem, const LeafLists<Exec, Dim>& lists, Offset first,
              Offset last);
    /// Brings everything written into the prepared lists.
    void finish(const Products& products);

    Offset bytes() const;

private:
    /// A list as kernels write it: its own memory on a host, else a copy.
    struct Output {
        Uploaded<Offset, Exec> upload;
        Array<Slot, Exec> copy;
        const Offset* offsets = nullptr;
        Slot* values = nullptr;

        void reserve(const char* label, const Csr& list, Offset n_rows);
        void finish(const Csr& list) const;
        Offset bytes() const { return upload.bytes() + bytes_of(copy); }
    };

    bool has_rows_ = false, has_halves_ = false;
    Offset n_row_counts_ = 0, n_slots_ = 0;
    Downloaded<Slot, Exec> row_counts_, half_counts_;
    Slot *row_count_ = nullptr, *half_count_ = nullptr;
    Output rows_, halves_;
};

}  // namespace connectivity::detail::device
