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
#include "row_sink.hpp"

namespace connectivity::detail {

/// Where a row lies in an arena, and what it holds.
struct ArenaRow {
    const Slot* first;  ///< of no meaning while counting
    Slot length;        ///< entries of the row; 0 where it is not wanted
    Slot later;         ///< entries of the half row: it ends where the row ends
};

class RowStore final : public RowSink {
public:
    /// Makes room. Throws Error{memory}.
    void begin(const SlotLayout& layout, bool rows, bool halves, BitKernels kernels);

    /// Starts a sweep that keeps at most `arena_bytes` of rows in arenas and only counts the
    /// others; 0: counts all. What is expected to outgrow the caches is written past them.
    void begin_sweep(Offset arena_bytes, Offset expected_bytes);

    /// Called by worker `worker`. Throws Error{memory}.
    void store(int worker, const FoundRow& row) override;
    void store_nothing(int worker, Slot slot) override;

    /// Some rows were only counted: the counts are complete, the rows are not.
    bool only_counted() const { return only_counts_.load(std::memory_order_relaxed); }

    Counts counts() const;

    /// Moves all rows into the prepared lists. Cannot fail.
    void transfer(Products products) const;

    /// Entries counted for a slot, whatever was wanted.
    Offset entries(Slot slot) const { return std::max(row_(slot).length, row_(slot).later); }

    /// Gives the arenas back.
    void release();
    Offset bytes() const;

private:
    struct alignas(64) Worker {
        RowArena arena;
        std::vector<Slot> row;
    };

    std::size_t range_of(Slot slot) const { return static_cast<std::size_t>(slot >> range_bits_); }
    Offset n_ranges() const { return (layout_->n_slots() >> range_bits_) + 1; }
    Offset choose_ranges(Offset expected_bytes);
    void prefetch_range(std::size_t range) const;
    Slot* room(Worker& worker, Slot slot, Offset n);
    void record(Slot slot, const Slot* first, int n, int later);
    void count_lists(Offset row, const Slot* slots, Offset n);
    void transfer_slots(Offset first, Offset last, const Products& products) const;

    bool past_caches_ = false;
    int range_bits_ = 9;  // slots of one range differ in these bits only
    Offset arena_bytes_ = 0;
    BitKernels kernels_{};
    std::atomic<bool> only_counts_{false};
    std::atomic<Offset> used_{0};
    std::vector<Worker> workers_;
    View<ArenaRow> row_;  // [n_slots]
    View<Slot> by_list_;  // [n_rows * n_lists], only for several lists
};

}  // namespace connectivity::detail
