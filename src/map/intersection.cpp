// SPDX-License-Identifier: BSD-3-Clause
#include "intersection.hpp"

#include "base/first_exception.hpp"
#include "search/kernels.hpp"
#include "search/stream_writer.hpp"

namespace connectivity {

namespace {

constexpr Offset labels_per_chunk = 256;

/// Expands all pairs of a node, one after the other.
const Slot* expanded(const detail::PairRows& rows, Slot* out) {
    if (rows.bits == nullptr) return rows.slots;
    const auto expand = detail::kernels<3>().expand;
    Slot* end = out;
    for (Offset p = 0; p < rows.n_pairs; ++p)
        end += expand(rows.bits + p * rows.n_words, rows.n_words, rows.slots, end);
    return out;
}

}  // namespace

template <int Dim>
detail::IntersectionSource<Dim> IntersectionBuild<Dim>::with_places(
    const IntersectionInput<Dim>& input) {
    if (input.order == nullptr) return {input, nullptr};
    const Offset n = input.labels.layout.n_slots();
    ensure_capacity(place_of_, "map/intersection/place_of", n);
    Slot* const place_of = place_of_.data();
    const Slot* const order = input.order;
    Kokkos::parallel_for("map/intersection/place_of",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=](const Offset k) { place_of[order[k]] = static_cast<Slot>(k); });
    HostExec().fence();
    return {input, place_of};
}

/// The fill must not take memory: room for the longest rows of a node.
template <int Dim>
void IntersectionBuild<Dim>::take_row_memory() {
    Offset longest = 0;
    for (const detail::PairRows* rows : chunks_)
        for (; rows != nullptr; rows = rows->next) longest = std::max(longest, rows->n_entries);
    const auto needed = static_cast<std::size_t>(longest + detail::list_slack);
    for (Worker& worker : workers_)
        if (worker.row.size() < needed) worker.row.resize(needed);
}

template <int Dim>
Offset IntersectionBuild<Dim>::prepare(const IntersectionInput<Dim>& input, Csr& out) {
    const Offset n = input.labels.layout.n_slots(),
                 n_pairs = n > 0 ? input.half_rows.offsets[n] : 0,
                 n_chunks = (n + labels_per_chunk - 1) / labels_per_chunk;
    if (workers_.size() < static_cast<std::size_t>(n_workers())) workers_.resize(n_workers());
    for (Worker& worker : workers_) worker.arena.reset();
    chunks_.resize(static_cast<std::size_t>(n_chunks));
    ensure_capacity(counts_, "map/intersection/counts", n_pairs);
    const detail::IntersectionSource<Dim> source = with_places(input);
    detail::FirstException failure;
    for_each_dynamic("map/intersection/count", n_chunks, [&](int w, Offset chunk) {
        if (failure.any()) return;
        try {
            Worker& worker = workers_[static_cast<std::size_t>(w)];
            const Offset first = chunk * labels_per_chunk;
            chunks_[static_cast<std::size_t>(chunk)] = worker.block.store(
                source, first, std::min(first + labels_per_chunk, n), worker.arena, counts_.data());
        } catch (...) {
            failure.keep();
        }
    });
    failure.rethrow();
    take_row_memory();
    const Slot* const counts = counts_.data();
    return out.prepare(n_pairs, [=](Offset p) { return counts[p]; });
}

template <int Dim>
void IntersectionBuild<Dim>::commit(Csr& out) {
    constexpr Offset cached = Offset{2} << 20;  // entries
    const bool past_caches = out.n_prepared() > cached;
    for_each_dynamic(
        "map/intersection/fill", static_cast<Offset>(chunks_.size()), [&](int worker, Offset c) {
            Slot* const memory = workers_[static_cast<std::size_t>(worker)].row.data();
            const detail::PairRows* rows = chunks_[static_cast<std::size_t>(c)];
            for (; rows != nullptr; rows = rows->next) {
                const Slot* const from = expanded(*rows, memory);
                Slot* const to = out.prepared_values() + out.prepared_offsets()[rows->first_pair];
                if (past_caches)
                    detail::stream_copy(to, from, rows->n_entries);
                else
                    std::copy_n(from, rows->n_entries, to);
            }
            std::atomic_thread_fence(std::memory_order_seq_cst);  // streamed stores
        });
    out.publish();
}

template <int Dim>
Offset IntersectionBuild<Dim>::bytes() const {
    Offset sum = static_cast<Offset>(chunks_.capacity() * sizeof(void*) +
                                     (counts_.size() + place_of_.size()) * sizeof(Slot));
    for (const Worker& worker : workers_)
        sum += worker.block.bytes() + worker.arena.bytes() +
               static_cast<Offset>(worker.row.capacity() * sizeof(Slot));
    return sum;
}

template class IntersectionBuild<1>;
template class IntersectionBuild<2>;
template class IntersectionBuild<3>;

}  // namespace connectivity
