// SPDX-License-Identifier: BSD-3-Clause
#include "groups.hpp"

#include <exception>
#include <mutex>

namespace connectivity::detail {

namespace {

int bits_for(Offset n) {
    int bits = 1;
    while ((Offset{1} << bits) < n) ++bits;
    return bits;
}

/// The first exception of a parallel loop, thrown again after it.
class FirstException {
public:
    void keep() noexcept {
        const std::lock_guard lock(mutex_);
        if (!exception_) exception_ = std::current_exception();
        any_ = true;
    }
    bool any() const { return any_.load(std::memory_order_relaxed); }
    void rethrow() const {
        if (!exception_) return;
        try {
            std::rethrow_exception(exception_);
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, "the search ran out of memory for its candidate lists");
        }
    }

private:
    std::mutex mutex_;
    std::exception_ptr exception_;
    std::atomic<bool> any_{false};
};

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
    report.entry("order") = {"order", "search", why, true, !fresh && !worn, order_.bytes() + boxes_.bytes(), watch.ms()};
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
            workers_[worker].process(shared, worker, order_.block_leaf[b], order_.block_leaf[b + 1]);
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
    store_.begin_sweep(true);
    sweep(shared, stride);
    Offset entries = 0, sampled = 0;
    for (Offset b = 0; b < order_.n_blocks(); b += stride)
        for (Offset p = order_.block_leaf[b] * leaf_size; p < order_.block_leaf[b + 1] * leaf_size; ++p)
            if (const Slot slot = order_.slot(p); slot >= 0) entries += store_.entries(slot), ++sampled;
    return sampled > 0 ? static_cast<Offset>(static_cast<double>(entries) / static_cast<double>(sampled) *
                                             static_cast<double>(order_.n))
                       : 0;
}

template <int Dim>
void GroupSearch<Dim>::run(const SearchNodes<Dim>& nodes, const SlotLayout& layout, const SearchRequest& request,
                           Products products, Report& report) {
    update_order(nodes, report);
    const Kernels<Dim>& table = kernels<Dim>();
    if (workers_.size() < static_cast<std::size_t>(n_workers())) workers_ = std::vector<GroupWorker<Dim>>(n_workers());
    for (auto& worker : workers_) worker.counters = {};
    const Offset allowed = request.budget.allowed();
    store_.begin(layout, request.rows, request.half_rows, allowed, {table.expand, table.count});
    const GroupSweep<Dim> shared{nodes, order_, boxes_, table, request.mode, bits_for(nodes.n), store_};

    // Rows are counted before any are kept where keeping them might not fit.
    const Offset expected = entries_before_ >= 0 ? entries_before_ : estimate_entries(shared);
    const bool might_not_fit = expected > allowed / static_cast<Offset>(4 * sizeof(Slot));
    if (might_not_fit) {
        store_.begin_sweep(true);
        sweep(shared, 1);
        products.prepare(store_.counts(), layout, request.budget);
    }
    store_.begin_sweep(false);
    sweep(shared, 1);
    try {
        products.prepare(store_.counts(), layout, request.budget);
    } catch (...) {
        store_.release();
        throw;
    }
    if (store_.over_budget()) {
        store_.release();
        throw Error(Status::budget, "the search needs more than " + human_bytes(allowed) + " while it runs");
    }
    store_.transfer(products);
    entries_before_ = std::max(request.rows ? products.rows.n_values() : 0,
                               request.half_rows ? products.halves.n_values() : 0);
    report_costs(report);
}

template <int Dim>
void GroupSearch<Dim>::report_costs(Report& report) const {
    Offset candidates = 0, doubts = 0, exact = 0, scratch = store_.bytes();
    for (const auto& worker : workers_) {
        candidates += worker.counters.candidates;
        doubts += worker.counters.doubts;
        exact += worker.counters.exact_nodes;
        scratch += worker.bytes();
    }
    report.counter("candidates") = candidates;
    report.counter("doubtful_words") = doubts;
    report.counter("nodes_tested_in_double") = exact;
    report.counter("blocks") = order_.n_blocks();
    report.entry("scratch") = {"scratch", "search", "rows wait here until all are counted", true, true, scratch, 0};
}

template <int Dim>
View<Slot> GroupSearch<Dim>::spatial_order(const SearchNodes<Dim>& nodes) {
    Report ignored;
    update_order(nodes, ignored);
    auto slots = allocate<Slot>("search/spatial_order", nodes.n);
    Offset at = 0;
    for (std::size_t p = 0; p < order_.slot.size(); ++p)
        if (order_.slot(p) >= 0) slots(at++) = order_.slot(p);
    return slots;
}

template <int Dim>
Offset GroupSearch<Dim>::bytes() const {
    Offset sum = order_.bytes() + boxes_.bytes() + store_.bytes();
    for (const auto& worker : workers_) sum += worker.bytes();
    return sum;
}

template class GroupSearch<1>;
template class GroupSearch<2>;
template class GroupSearch<3>;

}  // namespace connectivity::detail
