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
        has_halves;  ///< what was asked for; of zero nodes even a null pointer tells all counts
    struct Numbers {
        const Slot* first;
        int stride;
        Offset operator[](Offset k) const { return first[k * stride]; }
    };
    Numbers rows;    ///< [n_rows * n_lists]
    Numbers halves;  ///< [n_slots]
};

/// The two lists that a search fills.
struct Products {
    Csr& rows;
    Csr& halves;

    /// Offsets, budget check, storage; returns the bytes that the lists take. Throws
    /// Error{budget | memory}; the lists are as before.
    Offset prepare(const Counts& counts, const SlotLayout& layout, const Budget& budget);

    /// After a failure: gives back what was prepared.
    void abandon();
};

/// Throws Error{budget}: bytes needed and allowed, number of entries, and the node with most
/// neighbours.
[[noreturn]] void throw_over_budget(const Counts& counts, const SlotLayout& layout, Offset needed,
                                    Offset allowed);

}  // namespace connectivity::detail
