// SPDX-License-Identifier: BSD-3-Clause
#include "row_store.hpp"

#include <algorithm>

#include "stream_writer.hpp"

namespace connectivity::detail {

void RowStore::begin(const SlotLayout& layout, bool rows, bool halves, BitKernels kernels) {
    want(layout, rows, halves);
    kernels_ = kernels;
    if (workers_.size() < static_cast<std::size_t>(n_workers()))
        workers_ = std::vector<Worker>(n_workers());
    ensure_capacity(row_, "search/groups/row", layout.n_slots());
    records_ = reinterpret_cast<const char*>(row_.data());
    record_bytes_ = sizeof(ArenaRow);
    const bool by_list = rows && layout.n_lists() > 1;
    if (by_list)
        ensure_capacity(by_list_, "search/groups/by_list", layout.n_rows() * layout.n_lists());
    by_list_row_ = by_list ? by_list_.data() : nullptr;
    // Rows of nodes that are not active are never recorded.
    if (by_list && layout.active().size() > 0) Kokkos::deep_copy(by_list_, 0);
}

void RowStore::begin_sweep(Offset arena_bytes, Offset expected_bytes) {
    constexpr Offset cached = Offset{8} << 20;
    arena_bytes_ = arena_bytes;
    only_counts_ = arena_bytes == 0;
    used_ = 0;
    past_caches_ = expected_bytes > cached;
    const Offset block = choose_ranges(expected_bytes);
    for (Worker& worker : workers_) worker.arena.reset(static_cast<std::size_t>(n_ranges()), block);
}

/// Rows of one range shall stay in the cache of one core while they are put in order. Returns how
/// many entries a block shall hold: every worker starts one for every range.
Offset RowStore::choose_ranges(Offset expected_bytes) {
    constexpr Offset range_bytes = Offset{1} << 18, most_ranges = 512, smallest_block = 1 << 10,
                     largest_block = 1 << 13;
    const Offset wanted =
        past_caches_ ? std::min(expected_bytes / range_bytes, most_ranges) : Offset{1};
    range_bits_ = 9;
    while ((layout_->n_slots() >> range_bits_) > wanted) ++range_bits_;
    const Offset share = expected_bytes / Offset{sizeof(Slot)} / n_ranges() / n_workers();
    return std::clamp(share / 4, smallest_block, largest_block);
}

void RowStore::store_nothing(int, Slot slot) {
    record(slot, nullptr, 0, 0);
    if (const Offset row = layout_->row_of_slot(slot); rows_ && row >= 0)
        count_lists(row, nullptr, 0);
}

/// Memory for n entries: in the arena, or in passing while rows are only counted.
Slot* RowStore::room(Worker& worker, Slot slot, Offset n) {
    if (!only_counted()) {
        Slot* const row = worker.arena.begin_row(range_of(slot), n, used_);
        if (used_.load(std::memory_order_relaxed) > arena_bytes_)
            only_counts_.store(true, std::memory_order_relaxed);
        return row;
    }
    if (static_cast<Offset>(worker.row.size()) < n + list_slack) worker.row.resize(n + list_slack);
    return worker.row.data();
}

/// How many of the ascending slots are below `end`: without a branch that guesses, where few.
Slot count_below(const Slot* slots, Offset n, Offset end) {
    constexpr Offset few = 256;
    if (n > few) return static_cast<Slot>(std::lower_bound(slots, slots + n, end) - slots);
    const Slot below = static_cast<Slot>(end);
    Slot count = 0;
    for (Offset k = 0; k < n; ++k) count += slots[k] < below ? 1 : 0;
    return count;
}

void RowStore::count_lists(Offset row, const Slot* slots, Offset n) {
    const int n_lists = layout_->n_lists();
    if (n_lists == 1) return;
    Slot* const counts = &by_list_(row * n_lists);
    Slot before = 0;
    for (int l = 0; l + 1 < n_lists; ++l) {
        const Slot upto = count_below(slots, n, layout_->list_offset()[l + 1]);
        counts[l] = upto - before;
        before = upto;
    }
    counts[n_lists - 1] = static_cast<Slot>(n) - before;
}

void RowStore::store(int worker_number, const FoundRow& found) {
    Worker& worker = workers_[worker_number];
    const Offset row = layout_->row_of_slot(found.slot);
    const bool whole = rows_ && row >= 0;
    const int first = whole ? 0 : found.place / word_size,
              most = (found.n_words - first) * word_size;
    const int before = whole ? kernels_.count(found.bits, found.place) : 0;
    // Only the number matters while counting, unless entries must be told apart.
    if (only_counted() && row >= 0 && (!whole || layout_->n_lists() == 1)) {
        const int n = kernels_.count(found.bits + first, most);
        record(found.slot, nullptr, whole ? n : 0, n - before);
        return;
    }
    Slot* const out = room(worker, found.slot, most);
    int n = kernels_.expand(found.bits + first, found.n_words - first,
                            found.label + first * word_size, out);
    if (row < 0) n = keep_stored(out, n);
    if (whole) count_lists(row, out, n);
    if (out != worker.row.data()) worker.arena.end_row(range_of(found.slot), n);
    if (whole)
        record(found.slot, out, n, n - before);
    else
        record(found.slot, out + n, 0, n);
}

void RowStore::record(Slot slot, const Slot* first, int n, int later) {
    row_(slot) = {first, n, later};
}

Counts RowStore::counts() const {
    constexpr int stride = sizeof(ArenaRow) / sizeof(Slot);
    if (row_.size() == 0) return {rows_, halves_, {nullptr, 1}, {nullptr, 1}};
    const ArenaRow* const first = row_.data();
    Counts counts{rows_, halves_, {&first->length, stride}, {&first->later, stride}};
    if (layout_->n_lists() > 1) counts.rows = {by_list_.data(), 1};
    return counts;
}

/// Copies the rows of slots [first, last) into both lists; rows of consecutive slots lie side by
/// side there.
void RowStore::transfer_slots(Offset first, Offset last, const Products& products) const {
    StreamWriter rows(past_caches_), halves(past_caches_);
    if (halves_)
        halves.start(products.halves.prepared_values() + products.halves.prepared_offsets()[first]);
    for (Offset slot = first; slot < last; ++slot) {
        const ArenaRow& found = row_(slot);
        const Offset row = rows_ ? layout_->row_of_slot(slot) : -1;
        if (row >= 0) {
            if (!rows.started())
                rows.start(products.rows.prepared_values() +
                           products.rows.prepared_offsets()[row * layout_->n_lists()]);
            rows.append(found.first, found.length);
        }
        if (halves_) halves.append(found.first + found.length - found.later, found.later);
    }
    rows.finish();
    halves.finish();
}

/// Asks for all rows of a range, in the sequence of their memory.
void RowStore::prefetch_range(std::size_t range) const {
    for (const Worker& worker : workers_)
        worker.arena.for_each_block(range, [](const Slot* first, const Slot* last) {
            constexpr int second_level = 2;
            for (; first < last; first += slots_per_line)
                __builtin_prefetch(first, 0, second_level);
        });
}

void RowStore::transfer(Products products) const {
    constexpr int few_slots = 9;
    const int bits = past_caches_ ? range_bits_ : few_slots;
    const Offset n = layout_->n_slots();
    for_each_dynamic("search/groups/transfer", (n >> bits) + 1, [&](int, Offset chunk) {
        if (past_caches_) prefetch_range(static_cast<std::size_t>(chunk));
        transfer_slots(chunk << bits, std::min((chunk + 1) << bits, n), products);
    });
    if (rows_) products.rows.publish();
    if (halves_) products.halves.publish();
}

void RowStore::release() {
    for (Worker& worker : workers_) worker.arena.clear(), worker.row = {};
}

Offset RowStore::bytes() const {
    Offset sum =
        static_cast<Offset>(row_.size() * sizeof(ArenaRow) + by_list_.size() * sizeof(Slot));
    for (const Worker& worker : workers_) sum += worker.arena.bytes();
    return sum;
}

}  // namespace connectivity::detail
