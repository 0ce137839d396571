// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The one builder of compressed sparse rows: count, scan, fill.
///
/// Invariants: offsets[0] = 0, offsets non-decreasing, offsets[n_rows] = number of values. Offsets
/// and counts are 64 bits, values 32. Until `commit` nothing a reader can see changes; `commit`
/// cannot fail. Views handed out stay valid and unchanged: storage that somebody else holds is left
/// to them and new storage is taken. Cost: 8 bytes a row and 4 a value, and as much again for
/// offsets while both generations are alive.

#include <string>
#include <utility>

#include <connectivity/base/parallel.hpp>
#include <connectivity/base/spaces.hpp>

namespace connectivity {

class Csr {
public:
    explicit Csr(std::string label = "csr") : label_(std::move(label)) {}

    Offset n_rows() const { return n_rows_; }
    Offset n_values() const { return n_values_; }

    /// [n_rows + 1], host; empty before the first commit and after `clear`.
    ConstView<Offset> offsets() const;
    /// [n_values], host.
    ConstView<Slot> values() const { return Kokkos::subview(values_, range(n_values_)); }

    /// The same without a count of holders, for look-ups that a counted handle would slow down.
    /// Valid until the next change.
    const Offset* offset_data() const { return offsets_.data(); }  ///< null before the first commit
    const Slot* value_data() const { return values_.data(); }

    /// Bytes held, spare capacity included.
    Offset bytes() const;

    /// First step. count(i) is the length of row i; called once for every row, in parallel.
    /// Returns the bytes that a commit would have to hold. Throws Error{memory}; nothing visible
    /// changes.
    template <class Count>
    Offset prepare(Offset n_rows, const Count& count);

    /// First step where counting finds sums only: whoever fills then writes every offset, too, all
    /// but the last one. Returns bytes and throws as `prepare` does.
    Offset prepare_sizes(Offset n_rows, Offset n_values);
    Offset* offsets_to_fill() { return spare_.data(); }

    /// Second step: takes the storage that the prepared rows need. Throws Error{memory}; nothing
    /// visible changes.
    void reserve();

    /// Third step: fill(first_row, last_row, offsets, values) writes rows [first_row, last_row) and
    /// is called in parallel over chunks of rows. It must not throw.
    template <class Fill>
    void commit(const Fill& fill, Offset rows_per_chunk = 64);

    /// The third step in other hands: what was prepared, to be filled before `publish`.
    const Offset* prepared_offsets() const { return spare_.data(); }  ///< [n_rows + 1]
    Slot* prepared_values() const { return grown_.size() > 0 ? grown_.data() : values_.data(); }
    Offset n_prepared() const { return pending_values_; }  ///< values

    /// Makes the prepared rows the list. Cannot fail.
    void publish();

    /// Forgets what was prepared and gives its memory back; the list stays.
    void abandon();

    /// Empties the list and gives its memory back (views held elsewhere keep theirs).
    void clear();

private:
    static std::pair<std::size_t, std::size_t> range(Offset n) {
        return {std::size_t{0}, static_cast<std::size_t>(n)};
    }
    void take_spare(Offset n_rows);
    Offset set_total(Offset n_rows, Offset total);

    std::string label_;
    View<Offset> offsets_, spare_;
    View<Slot> values_, grown_;  // grown_ is empty when values_ can be reused
    Offset n_rows_ = 0, n_values_ = 0, pending_rows_ = 0, pending_values_ = 0;
};

template <class Count>
Offset Csr::prepare(Offset n_rows, const Count& count) {
    take_spare(n_rows);
    Offset* const offsets = spare_.data();
    Offset total = 0;
    if (n_rows <= few_items) {
        for (Offset i = 0; i < n_rows; ++i)
            offsets[i] = std::exchange(total, total + static_cast<Offset>(count(i)));
        return set_total(n_rows, total);
    }
    const Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>> rows(0, n_rows);
    Kokkos::parallel_for(label_ + "/count", rows,
                         [=](const Offset i) { offsets[i] = static_cast<Offset>(count(i)); });
    Kokkos::parallel_scan(
        label_ + "/scan", rows,
        [=](const Offset i, Offset& sum, const bool final) {
            const Offset length = offsets[i];
            if (final) offsets[i] = sum;
            sum += length;
        },
        total);
    HostExec().fence();
    return set_total(n_rows, total);
}

template <class Fill>
void Csr::commit(const Fill& fill, Offset rows_per_chunk) {
    const Offset n = pending_rows_, chunks = (n + rows_per_chunk - 1) / rows_per_chunk;
    const Offset* const offsets = spare_.data();
    Slot* const values = prepared_values();
    Kokkos::parallel_for(
        label_ + "/fill",
        Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>, Kokkos::Schedule<Kokkos::Dynamic>>(
            0, chunks),
        [=](const Offset c) {
            const Offset first = c * rows_per_chunk,
                         last = first + rows_per_chunk < n ? first + rows_per_chunk : n;
            fill(first, last, offsets, values);
        });
    HostExec().fence();
    publish();
}

}  // namespace connectivity
