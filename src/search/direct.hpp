// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Rows by testing each node against a superset of its neighbours, one node at a time.
///
/// `Candidates::visit(i, f)` calls f(j) for every j that may interact with i, each once, i itself
/// included or not. Cost: every pair is tested twice a pass, in two passes (count, fill); a row is
/// sorted after it is filled.

#include <algorithm>

#include "base/first_exception.hpp"
#include "products.hpp"
#include "row_visitor.hpp"

namespace connectivity::detail {

template <int Dim, class Candidates>
class DirectBuild {
public:
    DirectBuild(const Candidates& candidates, const SearchNodes<Dim>& nodes,
                const SlotLayout& layout, const SearchRequest& request)
        : candidates_(candidates), see_(significance(nodes)), layout_(layout), request_(request) {}

    void run(Products products) {
        count();
        products.prepare(
            {request_.rows, request_.half_rows, {row_counts_.data(), 1}, {half_counts_.data(), 1}},
            layout_, request_.budget);
        if (request_.rows) fill_rows(products.rows);
        if (request_.half_rows) fill_halves(products.halves);
    }

    /// Hands every row, or every half row, to f and stores none. Throws what f throws as
    /// HostException, Error{memory}.
    void visit(const RowFunction& f) const {
        constexpr Offset slots_per_chunk = 64;
        const Offset n = layout_.n_slots();
        std::vector<std::vector<Slot>> row(static_cast<std::size_t>(n_workers()));
        FirstException first;
        for_each_dynamic("search/direct/visit", (n + slots_per_chunk - 1) / slots_per_chunk,
                         [&](int worker, Offset chunk) {
                             if (first.any()) return;
                             const Offset begin = chunk * slots_per_chunk;
                             try {
                                 for (Offset i = begin; i < std::min(begin + slots_per_chunk, n);
                                      ++i)
                                     visit_slot(worker, i, row[worker], f);
                             } catch (...) {
                                 first.keep();
                             }
                         });
        first.rethrow();
    }

private:
    using Slots =
        Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>, Kokkos::Schedule<Kokkos::Dynamic>>;

    /// f(j) for every significant j != i.
    template <class F>
    void neighbours(Offset i, const F& f) const {
        candidates_.visit(i, [&](Offset j) {
            if (j != i && see_(i, j, request_.mode)) f(j);
        });
    }

    /// Does the pair {i, j}, j after i, stand in the half row of i?
    bool is_partner(Offset i, Offset j, bool stored) const {
        return j > i && (stored || layout_.is_stored(j));
    }

    void visit_slot(int worker, Offset i, std::vector<Slot>& row, const RowFunction& f) const {
        const bool stored = layout_.is_stored(i);
        if (request_.rows && !stored) return;
        row.clear();
        neighbours(i, [&](Offset j) {
            if (request_.rows || is_partner(i, j, stored)) row.push_back(static_cast<Slot>(j));
        });
        std::sort(row.begin(), row.end());
        call_host(f, worker, static_cast<Slot>(i), row);
    }

    void count() {
        const int n_lists = layout_.n_lists();
        if (request_.rows)
            row_counts_ =
                allocate_zeroed<Slot>("search/direct/row_counts", layout_.n_rows() * n_lists);
        if (request_.half_rows)
            half_counts_ = allocate_zeroed<Slot>("search/direct/half_counts", layout_.n_slots());
        Kokkos::parallel_for(
            "search/direct/count", Slots(0, layout_.n_slots()), [this, n_lists](const Offset i) {
                const Offset row = layout_.row_of_slot(i);
                Slot* const by_list =
                    request_.rows && row >= 0 ? row_counts_.data() + row * n_lists : nullptr;
                Slot partners = 0;
                neighbours(i, [&](Offset j) {
                    if (by_list != nullptr) ++by_list[layout_.list_of_slot(j)];
                    partners += is_partner(i, j, row >= 0);
                });
                if (request_.half_rows) half_counts_(i) = partners;
            });
        HostExec().fence();
    }

    void fill_rows(Csr& rows) const {
        const Offset n_lists = layout_.n_lists();
        rows.commit(
            [this, n_lists](Offset first, Offset last, const Offset* offsets, Slot* values) {
                for (Offset row = first / n_lists; row < last / n_lists; ++row) {
                    if (offsets[row * n_lists] == offsets[(row + 1) * n_lists]) continue;
                    Slot* end = values + offsets[row * n_lists];
                    neighbours(layout_.slot_of_row(row),
                               [&](Offset j) { *end++ = static_cast<Slot>(j); });
                    std::sort(values + offsets[row * n_lists], end);
                }
            },
            64 * n_lists);
    }

    void fill_halves(Csr& halves) const {
        halves.commit([this](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset i = first; i < last; ++i) {
                if (offsets[i] == offsets[i + 1]) continue;
                Slot* end = values + offsets[i];
                const bool stored = layout_.is_stored(i);
                neighbours(i, [&](Offset j) {
                    if (is_partner(i, j, stored)) *end++ = static_cast<Slot>(j);
                });
                std::sort(values + offsets[i], end);
            }
        });
    }

    const Candidates& candidates_;
    Significance<Dim> see_;
    const SlotLayout& layout_;
    const SearchRequest& request_;
    View<Slot> row_counts_, half_counts_;
};

/// Every node is a candidate of every node.
struct AllNodes {
    Offset n;
    template <class F>
    void visit(Offset, const F& f) const {
        for (Offset j = 0; j < n; ++j) f(j);
    }
};

}  // namespace connectivity::detail
