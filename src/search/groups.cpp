// SPDX-License-Identifier: BSD-3-Clause
#include "groups.hpp"

#include "base/first_exception.hpp"

namespace connectivity::detail {

namespace {

int bits_for(Offset n) {
    int bits = 1;
    while ((Offset{1} << bits) < n) ++bits;
    return bits;
}

}  // namespace

template <int Dim>
void GroupSearch<Dim>::update_order(const SearchNodes<Dim>& nodes, Report& report) {
    constexpr double worth_a_new_order = 1.5;
    const Stopwatch watch;
    const char* why = "kept: nodes moved little since it was made";
    const bool fresh = order_.n != nodes.n || order_.slot.size() == 0;
    if (!fresh) boxes_.gather(nodes, order_);
    const bool worn = !fresh && boxes_.spread() > worth_a_new_order * spread_when_ordered_;
    if (fresh || worn) {
        order_ = GroupOrder();
        order_ = order_groups(nodes);
        boxes_.gather(nodes, order_);
        spread_when_ordered_ = boxes_.spread();
        why = fresh ? "new: number of nodes changed" : "new: blocks had spread by half";
    }
    report.entry("order") = {"order",         "search",      why,       true,
                             !fresh && !worn, order_bytes(), watch.ms()};
}

/// Every stride-th block, the ones with the largest supports first.
template <int Dim>
void GroupSearch<Dim>::sweep(const GroupSweep<Dim>& shared, Offset stride) {
    FirstException first;
    const Offset n = (order_.n_blocks() + stride - 1) / stride;
    for_each_dynamic("search/groups/rows", n, [&](int worker, Offset item) {
        if (first.any()) return;
        const Offset b = item * stride;
        try {
            workers_[worker].process(shared, worker, order_.block_leaf[b],
                                     order_.block_leaf[b + 1]);
        } catch (...) {
            first.keep();
        }
    });
    first.rethrow();
}

/// Entries that the arenas would hold, from a sixty-fourth of the blocks.
template <int Dim>
Offset GroupSearch<Dim>::estimate_entries(const GroupSweep<Dim>& shared) {
    constexpr Offset stride = 64;
    store_.begin_sweep(0, 0);
    sweep(shared, stride);
    Offset entries = 0, sampled = 0;
    for (Offset b = 0; b < order_.n_blocks(); b += stride)
        for (Offset p = order_.block_leaf[b] * leaf_size; p < order_.block_leaf[b + 1] * leaf_size;
             ++p)
            if (const Slot slot = order_.slot(p); slot >= 0)
                entries += store_.entries(slot), ++sampled;
    return sampled > 0
               ? static_cast<Offset>(static_cast<double>(entries) / static_cast<double>(sampled) *
                                     static_cast<double>(order_.n))
               : 0;
}

template <int Dim>
void GroupSearch<Dim>::reserve_workers() {
    if (workers_.size() < static_cast<std::size_t>(n_workers()))
        workers_ = std::vector<GroupWorker<Dim>>(n_workers());
    for (auto& worker : workers_) worker.counters = {};
}

template <int Dim>
void GroupSearch<Dim>::visit(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
                             const SearchRequest& request, RowFunction f) {
    const Kernels<Dim>& table = kernels<Dim>();
    reserve_workers();
    const BitKernels bits{table.expand, table.count};
    RowVisitor visitor(layout, !request.rows, bits, f);
    sweep({nodes, order_, boxes_, table, request.mode, bits_for(nodes.n), visitor}, 1);
}

template <int Dim>
void GroupSearch<Dim>::run(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
                           const SearchRequest& request, Products products, Report& report) {
    const Kernels<Dim>& table = kernels<Dim>();
    reserve_workers();
    const BitKernels bits{table.expand, table.count};  // nvcc takes no braces below
    store_.begin(layout, request.rows, request.half_rows, bits);
    const GroupSweep<Dim> shared{nodes, order_, boxes_, table, request.mode, bits_for(nodes.n),
                                 store_};
    find_rows(shared, layout, request, products);
    count_work(report);
    store_.transfer(products);
    if (request.rows || request.half_rows)
        entries_before_ = std::max(request.rows ? products.rows.n_values() : 0,
                                   request.half_rows ? products.halves.n_values() : 0);
}

/// One sweep where the rows are about as many as expected. Where they are more, or might not fit
/// the budget, they are counted before any more memory is taken, and found again once they are
/// known to fit.
template <int Dim>
void GroupSearch<Dim>::find_rows(const GroupSweep<Dim>& shared, const SlotLayout& layout,
                                 const SearchRequest& request, Products products) {
    constexpr Offset slack = Offset{16} << 20;
    const Offset expected =
        (entries_before_ >= 0 ? entries_before_ : estimate_entries(shared)) * Offset{sizeof(Slot)};
    const bool surely_fits = expected < slack / 4 || request.budget.allows(4 * expected);
    // Chunks double: each worker may hold twice its rows and the first chunk.
    const Offset room = 3 * expected + slack + n_workers() * RowArena::smallest_bytes;
    try {
        store_.begin_sweep(surely_fits ? room : 0, expected);
        sweep(shared, 1);
        const Offset result = products.prepare(store_.counts(), layout, request.budget);
        if (!store_.only_counted()) return;
        const Offset free = Budget().allowed();
        store_.begin_sweep(free, result);
        sweep(shared, 1);
        if (store_.only_counted())
            throw Error(Status::budget, "the search needs more than " + human_bytes(free) +
                                            " while it runs, the memory that is free, beside the " +
                                            human_bytes(result) + " of its result");
    } catch (...) {
        products.abandon();
        store_.release();
        throw;
    }
}

template <int Dim>
void GroupSearch<Dim>::count_work(Report& report) const {
    Offset candidates = 0, doubts = 0, exact = 0;
    for (const auto& worker : workers_) {
        candidates += worker.counters.candidates;
        doubts += worker.counters.doubts;
        exact += worker.counters.exact_nodes;
    }
    report.counter("candidates") = candidates;
    report.counter("doubtful_words") = doubts;
    report.counter("nodes_tested_in_double") = exact;
    report.counter("blocks") = order_.n_blocks();
}

template <int Dim>
View<Slot> GroupSearch<Dim>::spatial_order() const {
    auto slots = allocate<Slot>("search/spatial_order", order_.n);
    Offset at = 0;
    for (std::size_t p = 0; p < order_.slot.size(); ++p)
        if (order_.slot(p) >= 0) slots(at++) = order_.slot(p);
    return slots;
}

template <int Dim>
Offset GroupSearch<Dim>::scratch_bytes() const {
    Offset sum = store_.bytes();
    for (const auto& worker : workers_) sum += worker.bytes();
    return sum;
}

template class GroupSearch<1>;
template class GroupSearch<2>;
template class GroupSearch<3>;

}  // namespace connectivity::detail
