// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Rows as the group search finds them, in any order, and their way into the final lists in slot
/// order.
///
/// Invariants: every slot is stored exactly once a sweep; a slot's row lies in the arena of the
/// worker that found it. Once the arenas outgrow what the sweep may keep, rows are only counted:
/// counts are exact all the same. Cost: 16 bytes a slot, and in the arenas 4 bytes for every entry
/// kept.

#include <atomic>
#include <vector>

#include <connectivity/base/parallel.hpp>

#include "products.hpp"
#include "row_arena.hpp"

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

/// Where a row lies in an arena, and what it holds.
struct ArenaRow {
    const Slot* first;  ///< nowhere while counting
    Slot length;        ///< entries
    Slot later;         ///< how many of them, at the end, belong to the half row
};

/// What a row store does with bits; see Kernels<Dim>.
struct BitKernels {
    int (*expand)(const std::uint64_t* bits, int n_words, const int* label, int* out);
    int (*count)(const std::uint64_t* bits, int place);
};

class RowStore {
public:
    /// What a sweep must find for a slot.
    enum class Wanted { nothing, later, all };

    /// Makes room. Throws Error{memory}.
    void begin(const SlotLayout& layout, bool rows, bool halves, BitKernels kernels);

    /// Starts a sweep that keeps at most `arena_bytes` of rows in arenas and only counts the
    /// others; 0: counts all.
    void begin_sweep(Offset arena_bytes, Offset expected_bytes);

    /// Ends the sweep: every row lies in its place. Cannot fail.
    void end_sweep();

    Wanted wanted(Slot slot) const;

    /// Asks early for the place where a slot's record will be written: records are visited at
    /// random, and a store that waits for its line holds up all that follow.
    void prefetch(Slot slot) const { __builtin_prefetch(row_.data() + slot, 1); }

    /// Called by worker `worker`. Throws Error{memory}.
    void store(int worker, const FoundRow& row);
    void store_nothing(Slot slot);

    /// Some rows were only counted: the counts are complete, the rows are not.
    bool only_counted() const { return only_counts_.load(std::memory_order_relaxed); }

    Counts counts() const;

    /// Moves all rows into the prepared lists. Cannot fail.
    void transfer(Products products) const;

    /// Entries counted for a slot, whatever was wanted.
    Offset entries(Slot slot) const { return row_(slot).length; }

    /// Gives the arenas back.
    void release();
    Offset bytes() const;

private:
    struct alignas(64) Worker {
        RowArena arena;
        std::vector<Slot> row;
    };

    Slot* room(Worker& worker, Offset n);
    void record(Slot slot, const Slot* first, int n, int later);
    int keep_stored(Slot* row, int n) const;
    void count_lists(Offset row, const Slot* slots, Offset n);
    void transfer_slots(Offset first, Offset last, const Products& products) const;

    const SlotLayout* layout_ = nullptr;
    bool rows_ = false, halves_ = false, past_caches_ = false;
    Offset arena_bytes_ = 0;
    Slot last_stored_ = -1;
    BitKernels kernels_{};
    std::atomic<bool> only_counts_{false};
    std::atomic<Offset> used_{0};
    std::vector<Worker> workers_;
    View<ArenaRow> row_;  // [n_slots]
    View<Slot> by_list_;  // [n_rows * n_lists], only for several lists
};

}  // namespace connectivity::detail
