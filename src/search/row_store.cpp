// SPDX-License-Identifier: BSD-3-Clause
#include "row_store.hpp"

#include <algorithm>

#include "stream_writer.hpp"

namespace connectivity::detail {

void RowStore::begin(const SlotLayout& layout, bool rows, bool halves, BitKernels kernels) {
    layout_ = &layout;
    rows_ = rows;
    halves_ = halves;
    kernels_ = kernels;
    last_stored_ = -1;
    for (int l = 0; l < layout.n_lists(); ++l) {
        const Offset n_stored = layout.row_offset()[l + 1] - layout.row_offset()[l];
        if (n_stored > 0) last_stored_ = static_cast<Slot>(layout.list_offset()[l] + n_stored - 1);
    }
    if (workers_.size() < static_cast<std::size_t>(n_workers()))
        workers_ = std::vector<Worker>(n_workers());
    ensure_capacity(row_, "search/groups/row", layout.n_slots());
    ensure_capacity(length_, "search/groups/length", layout.n_slots());
    ensure_capacity(later_, "search/groups/later", layout.n_slots());
    if (rows && layout.n_lists() > 1)
        ensure_capacity(by_list_, "search/groups/by_list", layout.n_rows() * layout.n_lists());
}

void RowStore::begin_sweep(Offset arena_bytes) {
    arena_bytes_ = arena_bytes;
    only_counts_ = arena_bytes == 0;
    used_ = 0;
    for (Worker& worker : workers_) worker.arena.reset();
}

RowStore::Wanted RowStore::wanted(Slot slot) const {
    if (rows_ && layout_->is_stored(slot)) return Wanted::all;
    return halves_ && slot <= last_stored_ ? Wanted::later : Wanted::nothing;
}

void RowStore::store_nothing(Slot slot) {
    record(slot, nullptr, 0, 0);
    if (const Offset row = layout_->row_of_slot(slot); rows_ && row >= 0)
        count_lists(row, nullptr, 0);
}

/// Memory for n entries: in the arena, or in passing while rows are only counted.
Slot* RowStore::room(Worker& worker, Offset n) {
    if (!only_counted()) {
        Slot* const row = worker.arena.begin_row(n, used_);
        if (used_.load(std::memory_order_relaxed) > arena_bytes_)
            only_counts_.store(true, std::memory_order_relaxed);
        return row;
    }
    if (static_cast<Offset>(worker.row.size()) < n + list_slack) worker.row.resize(n + list_slack);
    return worker.row.data();
}

/// Drops slots that have no row; returns how many are left.
int RowStore::keep_stored(Slot* row, int n) const {
    return static_cast<int>(
        std::remove_if(row, row + n, [this](Slot s) { return !layout_->is_stored(s); }) - row);
}

void RowStore::count_lists(Offset row, const Slot* slots, Offset n) {
    const int n_lists = layout_->n_lists();
    if (n_lists == 1) return;
    const Slot* from = slots;
    for (int l = 0; l < n_lists; ++l) {
        const Slot* const to = std::lower_bound(from, slots + n, layout_->list_offset()[l + 1]);
        by_list_(row * n_lists + l) = static_cast<Slot>(to - from);
        from = to;
    }
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
        record(found.slot, nullptr, n, n - before);
        return;
    }
    Slot* const out = room(worker, most);
    int n = kernels_.expand(found.bits + first, found.n_words - first,
                            found.label + first * word_size, out);
    if (row < 0) n = keep_stored(out, n);
    if (whole) count_lists(row, out, n);
    if (out != worker.row.data()) worker.arena.end_row(n);
    record(found.slot, out, n, n - before);
}

void RowStore::record(Slot slot, const Slot* first, int n, int later) {
    row_(slot) = {first};
    length_(slot) = n;
    later_(slot) = later;
}

Counts RowStore::counts() const {
    const bool several = layout_->n_lists() > 1;
    return {rows_, halves_, several ? by_list_.data() : length_.data(), later_.data()};
}

/// Copies the ends of arena rows, in slot order, into consecutive values.
template <class SlotOf, class LengthOf>
void copy_rows(const View<ArenaRow>& rows, const View<Slot>& lengths, Offset first, Offset last,
               Slot* to, const SlotOf& slot_of, const LengthOf& length_of) {
    constexpr Offset ahead = 24;  // rows lie anywhere in the arenas: ask for them early
    StreamWriter out(to);
    for (Offset r = first; r < last; ++r) {
        if (r + ahead < last) {
            const Offset next = slot_of(r + ahead);
            const Slot* const begin = rows(next).first;
            const Slot n = std::min<Slot>(lengths(next), 512);
            for (Slot k = 0; k < n + 16; k += 16) __builtin_prefetch(begin + k);
        }
        const Offset slot = slot_of(r), n = length_of(slot);
        if (n > 0) out.append(rows(slot).first + lengths(slot) - n, n);
    }
    out.finish();
}

void RowStore::fill_rows(Csr& rows) const {
    const Offset n_lists = layout_->n_lists();
    rows.commit(
        [this, n_lists](Offset first, Offset last, const Offset* offsets, Slot* values) {
            copy_rows(
                row_, length_, first / n_lists, last / n_lists, values + offsets[first],
                [this](Offset row) { return layout_->slot_of_row(row); },
                [this](Offset slot) { return static_cast<Offset>(length_(slot)); });
        },
        256 * n_lists);
}

void RowStore::fill_halves(Csr& halves) const {
    halves.commit(
        [this](Offset first, Offset last, const Offset* offsets, Slot* values) {
            copy_rows(
                row_, length_, first, last, values + offsets[first],
                [](Offset slot) { return slot; },
                [this](Offset slot) { return static_cast<Offset>(later_(slot)); });
        },
        256);
}

void RowStore::transfer(Products products) const {
    if (rows_) fill_rows(products.rows);
    if (halves_) fill_halves(products.halves);
}

void RowStore::release() {
    for (Worker& worker : workers_) worker.arena.clear(), worker.row = {};
}

Offset RowStore::bytes() const {
    Offset sum =
        static_cast<Offset>(row_.size() * sizeof(ArenaRow) +
                            (length_.size() + later_.size() + by_list_.size()) * sizeof(Slot));
    for (const Worker& worker : workers_) sum += worker.arena.bytes();
    return sum;
}

}  // namespace connectivity::detail
