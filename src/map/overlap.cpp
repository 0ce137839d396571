// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.hpp"

#include "base/first_exception.hpp"
#include "search/kernels.hpp"
#include "search/stream_writer.hpp"

namespace connectivity {

using detail::OverlapRows;
using detail::OverlapSource;

namespace {
constexpr Offset labels_per_chunk = 512;
}

const OverlapRows* OverlapBuild::count_chunk(const OverlapSource& source, Worker& worker,
                                             Offset first, Offset last) {
    const OverlapRows* head = nullptr;
    OverlapRows* tail = nullptr;
    while (first < last) {
        worker.block.begin();
        for (Offset added = 1; added > 0 && first < last && !worker.block.is_full(); first += added)
            added = worker.block.add(source, first, last);
        OverlapRows* const rows = worker.block.store(source, worker.arena, counts_.data());
        (tail != nullptr ? tail->next : head) = rows;
        tail = rows;
    }
    return head;
}

LabelRows OverlapBuild::by_place(LabelRows rows, const OverlapInput& input, Csr& copy) const {
    const Slot *const order = input.order, *const place_of = place_of_.data();
    copy.prepare(input.labels.layout.n_slots(), [=](Offset k) { return rows.size(order[k]); });
    copy.reserve();
    copy.commit([=](Offset first, Offset last, const Offset* offsets, Slot* values) {
        constexpr Offset ahead = 8;
        for (Offset k = first; k < last; ++k) {
            if (k + ahead < last) rows.prefetch(order[k + ahead]);
            Slot* out = values + offsets[k];
            for (const Slot label : rows[order[k]]) *out++ = place_of[label];
        }
    });
    return {copy.offsets().data(), copy.values().data()};
}

OverlapSource OverlapBuild::in_places(const OverlapInput& input) {
    if (input.order == nullptr) return {input.gather, input.scatter, input.labels};
    const Offset n = input.labels.layout.n_slots();
    ensure_capacity(place_of_, "map/overlap/place_of", n);
    Slot* const place_of = place_of_.data();
    const Slot* const order = input.order;
    Kokkos::parallel_for("map/overlap/place_of",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=](const Offset k) { place_of[order[k]] = static_cast<Slot>(k); });
    HostExec().fence();
    const LabelRows gather = by_place(input.gather, input, gather_);
    const bool same = input.gather.values == input.scatter.values &&
                      input.gather.offsets == input.scatter.offsets;
    return {gather, same ? gather : by_place(input.scatter, input, scatter_), input.labels, order};
}

Offset OverlapBuild::prepare(const OverlapInput& input, Csr& out) {
    const Offset n = input.labels.layout.n_slots(),
                 n_chunks = (n + labels_per_chunk - 1) / labels_per_chunk;
    n_lists_ = input.labels.layout.n_lists();
    if (workers_.size() < static_cast<std::size_t>(n_workers())) workers_.resize(n_workers());
    for (Worker& worker : workers_) worker.arena.reset();
    chunks_.resize(static_cast<std::size_t>(n_chunks));
    ensure_capacity(counts_, "map/overlap/counts", n * n_lists_);
    const OverlapSource source = in_places(input);
    detail::FirstException failure;
    for_each_dynamic("map/overlap/count", n_chunks, [&](int worker, Offset chunk) {
        if (failure.any()) return;
        try {
            const Offset first = chunk * labels_per_chunk;
            chunks_[static_cast<std::size_t>(chunk)] =
                count_chunk(source, workers_[static_cast<std::size_t>(worker)], first,
                            std::min(first + labels_per_chunk, n));
        } catch (...) {
            failure.keep();
        }
    });
    failure.rethrow();
    std::size_t longest = 0;
    for (const OverlapRows* rows : chunks_)
        for (; rows != nullptr; rows = rows->next)
            longest = std::max(longest, static_cast<std::size_t>(rows->n_universe));
    for (Worker& worker : workers_)
        if (worker.row.size() < longest + detail::list_slack)
            worker.row.resize(longest + detail::list_slack);
    const Slot* const counts = counts_.data();
    return out.prepare(n * n_lists_, [=](Offset k) { return counts[k]; });
}

void OverlapBuild::write(const OverlapRows& rows, Slot* row, Csr& out, bool past_caches) const {
    const auto expand = detail::kernels<3>().expand;
    for (int m = 0; m < rows.n_members; ++m) {
        const int n = expand(rows.bits + m * rows.stride, detail::n_words(rows.n_universe),
                             rows.universe, row);
        Slot* const to =
            out.prepared_values() + out.prepared_offsets()[Offset{rows.members[m]} * n_lists_];
        if (past_caches)
            detail::stream_copy(to, row, n);
        else
            std::copy_n(row, n, to);
    }
}

void OverlapBuild::commit(Csr& out) {
    constexpr Offset cached = Offset{2} << 20;  // entries
    const bool past_caches = out.n_prepared() > cached;
    for_each_dynamic("map/overlap/fill", static_cast<Offset>(chunks_.size()),
                     [&](int worker, Offset chunk) {
                         const auto* rows = chunks_[static_cast<std::size_t>(chunk)];
                         for (; rows != nullptr; rows = rows->next)
                             write(*rows, workers_[static_cast<std::size_t>(worker)].row.data(),
                                   out, past_caches);
                         std::atomic_thread_fence(std::memory_order_seq_cst);
                     });
    out.publish();
}

Offset OverlapBuild::bytes() const {
    Offset sum = static_cast<Offset>(chunks_.capacity() * sizeof(void*) +
                                     (counts_.size() + place_of_.size()) * sizeof(Slot));
    sum += gather_.bytes() + scatter_.bytes();
    for (const Worker& worker : workers_)
        sum += worker.block.bytes() + worker.arena.bytes() +
               static_cast<Offset>(worker.row.capacity() * sizeof(Slot));
    return sum;
}

}  // namespace connectivity
