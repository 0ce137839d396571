// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How counted rows become lists: offsets, budget, storage, fill. Every search method ends here.
///
/// Invariant: everything that can fail happens in `prepare`, before the first value of an old list
/// is overwritten.

#include <connectivity/base/budget.hpp>
#include <connectivity/base/csr.hpp>
#include <connectivity/search/layout.hpp>
#include <connectivity/search/search.hpp>

namespace connectivity::detail {

/// What a search counted: entries by row and target list, and partners after each slot.
struct Counts {
    bool has_rows,
        has_halves;      ///< what was asked for; of zero nodes even a null pointer tells all counts
    const Slot* rows;    ///< [n_rows * n_lists]
    const Slot* halves;  ///< [n_slots]
};

/// The two lists that a search fills.
struct Products {
    Csr& rows;
    Csr& halves;

    /// Offsets, budget check, storage. Throws Error{budget | memory}; the lists are as before.
    void prepare(const Counts& counts, const SlotLayout& layout, const Budget& budget);

    /// Bytes of the values prepared.
    Offset prepared_bytes() const {
        return (rows.prepared_values() + halves.prepared_values()) *
               static_cast<Offset>(sizeof(Slot));
    }
};

/// Throws Error{budget}: bytes needed and allowed, number of entries, and the node with most
/// neighbours.
[[noreturn]] void throw_over_budget(const Counts& counts, const SlotLayout& layout, Offset needed,
                                    Offset allowed);

}  // namespace connectivity::detail
