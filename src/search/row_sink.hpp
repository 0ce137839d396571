// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where the group search hands its rows: a store that makes lists of them, or a visitor that
/// passes them on.
///
/// Invariant: every slot is handed over exactly once a sweep. Cost: one virtual call a row; what is
/// wanted of a slot is answered without one.

#include <cstdint>

#include <connectivity/search/layout.hpp>

namespace connectivity::detail {

/// Bits of one node over a sorted list of labels.
struct FoundRow {
    Slot slot;
    const std::uint64_t* bits;
    const int* label;
    int n_words;
    int place;  ///< of the node's own label in the list; its bit is off, and all below if only
                ///< later entries are wanted
};

/// What a sink does with bits; see Kernels<Dim>.
struct BitKernels {
    int (*expand)(const std::uint64_t* bits, int n_words, const int* label, int* out);
    int (*count)(const std::uint64_t* bits, int place);
};

class RowSink {
public:
    /// What a sweep must find for a slot.
    enum class Wanted { nothing, later, all };

    Wanted wanted(Slot slot) const {
        if (rows_ && layout_->is_stored(slot)) return Wanted::all;
        return halves_ && slot <= last_stored_ ? Wanted::later : Wanted::nothing;
    }

    /// Asks early for the place where a slot's record will be written: records are visited at
    /// random, and a store that waits for its line holds up all that follow.
    void prefetch(Slot slot) const {
        if (records_ != nullptr) __builtin_prefetch(records_ + slot * record_bytes_, 1);
        if (by_list_row_ != nullptr)
            __builtin_prefetch(by_list_row_ + layout_->row_of_slot(slot) * layout_->n_lists(), 1);
    }

    /// Called by worker `worker`. Throws what the sink does.
    virtual void store(int worker, const FoundRow& row) = 0;
    virtual void store_nothing(int worker, Slot slot) = 0;

protected:
    RowSink() = default;
    ~RowSink() = default;
    RowSink(const RowSink&) = delete;
    RowSink& operator=(const RowSink&) = delete;

    /// Which rows a sweep is for.
    void want(const SlotLayout& layout, bool rows, bool halves);

    /// Drops slots that have no row; returns how many are left.
    int keep_stored(Slot* row, int n) const;

    const SlotLayout* layout_ = nullptr;
    bool rows_ = false, halves_ = false;
    Slot last_stored_ = -1;
    const char* records_ = nullptr;  // none unless the sink writes one for each slot
    Offset record_bytes_ = 0;
    const Slot* by_list_row_ = nullptr;  // of row 0; none unless entries are counted by list
};

}  // namespace connectivity::detail
