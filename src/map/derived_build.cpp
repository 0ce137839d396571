// SPDX-License-Identifier: BSD-3-Clause
#include "derived_build.hpp"

#include "pair_filter.hpp"

namespace connectivity {

namespace {

using Nodes = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

LabelRows label_rows(const Csr& list) { return {list.offsets().data(), list.values().data()}; }

/// Do all nodes see equally far? Then who sees and who is seen are the same.
template <int Dim>
bool is_uniform(const SearchNodes<Dim>& nodes) {
    if (nodes.H.size() > 0) return false;
    Kokkos::MinMaxScalar<double> range{};
    const auto reach2 = nodes.reach2;
    Kokkos::parallel_reduce(
        "map/derived/is_uniform", Nodes(0, nodes.n),
        [=](const Offset i, Kokkos::MinMaxScalar<double>& r) {
            if (reach2(i) < r.min_val) r.min_val = reach2(i);
            if (reach2(i) > r.max_val) r.max_val = reach2(i);
        },
        Kokkos::MinMax<double>(range));
    return nodes.n == 0 || (range.min_val == range.max_val && range.max_val >= 0);
}

/// Are rows to be cut by list, or put in another order, after they were found?
bool relabels_rows(const MapOptions& options, const SlotLayout& layout) {
    return options.stores_all_rows() && (options.order == ListOrder::key || layout.n_lists() > 1);
}

void clear_unwanted(const MapOptions& options, MapLists lists) {
    if (!options.rows) lists.rows.clear();
    if (!options.wants_pairs()) lists.half_rows.clear();
    if (!options.overlap) lists.overlap.clear();
    if (options.intersection == IntersectionKind::none) lists.intersection.clear();
    if (options.order == ListOrder::slot) lists.key_order.clear();
}

void abandon(MapLists lists) {
    lists.rows.abandon();
    lists.half_rows.abandon();
    lists.overlap.abandon();
    lists.intersection.abandon();
}

/// What a list needs, whatever spare capacity it has.
Offset list_bytes(Offset n_values, Offset n_rows) {
    return n_values * Offset{sizeof(Slot)} + (n_rows + 1) * Offset{sizeof(Offset)};
}

/// Bytes of each product, or why they are too many.
struct Needs {
    Offset lists = 0, overlap = 0, intersection = 0;
    Offset total() const { return lists + overlap + intersection; }

    void check(const Budget& budget) const {
        if (budget.allows(total())) return;
        const auto part = [](const char* name, Offset bytes) {
            return std::string(name) + " " + std::to_string(bytes) + " bytes (" +
                   human_bytes(bytes) + ")";
        };
        throw Error(Status::budget, "the result needs " + std::to_string(total()) +
                                        " bytes: " + part("rows and pairs", lists) + ", " +
                                        part("overlap", overlap) + ", " +
                                        part("intersections", intersection) + "; allowed are " +
                                        std::to_string(budget.allowed()) + " bytes (" +
                                        human_bytes(budget.allowed()) + ")");
    }
};

}  // namespace

/// What the search is told: nodes by label, and where all have rows, in one list.
template <int Dim>
void DerivedBuild<Dim>::take_labels(const DerivedRequest<Dim>& request) {
    const Offset n = request.nodes.n;
    nodes_ = request.nodes;
    layout_ = request.layout;
    if (!request.options.stores_all_rows()) return;
    auto active = request.layout.active();
    if (request.options.order == ListOrder::key) {
        next_order_.build<Dim>(request.lists, request.nodes.positions, request.layout);
        gather_nodes(request.nodes);
        if (active.size() > 0) active = in_order<std::uint8_t>(active, 1, active_);
    }
    layout_ = SlotLayout({{n, n}}, true, active);
}

/// The nodes by rank, copied.
template <int Dim>
void DerivedBuild<Dim>::gather_nodes(const SearchNodes<Dim>& nodes) {
    nodes_.positions = in_order<double>(nodes.positions, Dim, positions_);
    nodes_.reach2 = in_order<double>(nodes.reach2, 1, reach2_);
    if (nodes.H.size() > 0) nodes_.H = in_order<double>(nodes.H, n_symmetric(Dim), H_);
}

template <int Dim>
template <class T>
ConstView<T> DerivedBuild<Dim>::in_order(const ConstView<T>& in, int n_components,
                                         View<T>& storage) const {
    const Offset n = next_order_.size();
    ensure_capacity(storage, "map/derived/by_rank", n * n_components);
    const T* const from = in.data();
    T* const to = storage.data();
    const Slot* const slots = next_order_.slots();
    Kokkos::parallel_for("map/derived/gather", Nodes(0, n), [=](const Offset k) {
        for (int c = 0; c < n_components; ++c)
            to[k * n_components + c] = from[Offset{slots[k]} * n_components + c];
    });
    HostExec().fence();
    return Kokkos::subview(storage, std::pair<std::size_t, std::size_t>(0, n * n_components));
}

template <int Dim>
void DerivedBuild<Dim>::leave_out(const PairFilter& filter, const Labels& labels, Csr& list,
                                  int n_segments) {
    if (!filter.any()) return;
    filter.apply(list, spare_, labels, [&](Offset row) {
        return n_segments > 0 ? layout_.slot_of_row(row / n_segments) : row;
    });
}

template <int Dim>
void DerivedBuild<Dim>::search_rows(const DerivedRequest<Dim>& request, const Labels& labels,
                                    Search<Dim>& search, Report& report) {
    const MapOptions& options = request.options;
    const PairFilter filter(request.layout, options);
    const bool intersects = options.intersection != IntersectionKind::none;
    uniform_ = options.overlap && is_uniform(nodes_);
    const SearchRequest wanted{options.rows || intersects || uniform_,
                               options.wants_pairs(),
                               options.mode,
                               options.method,
                               options.budget,
                               near_order_.size() > 0};
    const bool searches = wanted.rows || wanted.half_rows;
    if (searches) search.run(nodes_, layout_, wanted, rows_, half_rows_, report);
    if (wanted.rows) leave_out(filter, labels, rows_, layout_.n_lists());
    if (wanted.half_rows) leave_out(filter, labels, half_rows_, 0);
    if (options.overlap && !uniform_)
        search_one_sided(request, labels, wanted.ordered || searches, search, report);
}

/// Who is seen by a node and who sees it. ordered: the search has just ordered these nodes.
template <int Dim>
void DerivedBuild<Dim>::search_one_sided(const DerivedRequest<Dim>& request, const Labels& labels,
                                         bool ordered, Search<Dim>& search, Report& report) {
    const PairFilter filter(request.layout, request.options);
    const Stopwatch watch;
    Csr none("map/derived/none");
    Report own;
    bool keeps_order = ordered;
    for (auto [mode, list] :
         {std::pair{SearchMode::gather, &gather_}, std::pair{SearchMode::scatter, &scatter_}}) {
        const SearchRequest wanted{
            true, false, mode, request.options.method, request.options.budget, keeps_order};
        search.run(nodes_, layout_, wanted, *list, none, own);
        leave_out(filter, labels, *list, 1);
        keeps_order = true;
    }
    for (const char* held : {"order", "scratch"}) {
        if (!ordered) report.entry(held) = own.entry(held);
        report.entry(held).bytes = own.entry(held).bytes;
    }
    report.entry("derived").ms += watch.ms();
}

/// Counts what the rows become in the hands of the map.
template <int Dim>
void DerivedBuild<Dim>::count_relabelled(const DerivedRequest<Dim>& request, const Labels& labels,
                                         MapLists lists) {
    const Offset n_lists = request.layout.n_lists(), n = nodes_.n;
    if (request.options.order == ListOrder::key && request.options.wants_pairs()) {
        const Offset* const offsets = half_rows_.offsets().data();
        lists.half_rows.prepare(n, [=](Offset k) { return offsets[k + 1] - offsets[k]; });
    }
    if (!request.options.rows || !relabels_rows(request.options, request.layout)) return;
    ensure_capacity(by_list_, "map/derived/by_list", n * n_lists);
    const Offset* const offsets = rows_.offsets().data();
    const Slot *const values = rows_.values().data(), *const by_list = by_list_.data();
    Kokkos::parallel_for("map/derived/count_lists", Nodes(0, n), [&](const Offset label) {
        Slot* const counts = by_list_.data() + labels.slot(static_cast<Slot>(label)) * n_lists;
        std::fill_n(counts, n_lists, 0);
        labels.count_lists(values + offsets[label], offsets[label + 1] - offsets[label], counts);
    });
    HostExec().fence();
    lists.rows.prepare(n * n_lists, [=](Offset k) { return by_list[k]; });
}

/// Counts everything, then takes the room for it.
template <int Dim>
void DerivedBuild<Dim>::prepare(const DerivedRequest<Dim>& request, const Labels& labels,
                                MapLists lists, Report& report) {
    const MapOptions& options = request.options;
    count_relabelled(request, labels, lists);
    Needs needs;
    if (options.rows)
        needs.lists +=
            list_bytes(rows_.n_values(), request.layout.n_rows() * request.layout.n_lists());
    if (options.wants_pairs())
        needs.lists += list_bytes(half_rows_.n_values(), half_rows_.n_rows());
    if (options.overlap) {
        const Stopwatch watch;
        const Csr &gather = uniform_ ? rows_ : gather_, &scatter = uniform_ ? rows_ : scatter_;
        if (!overlap_) overlap_.emplace();
        needs.overlap = overlap_->prepare(
            {label_rows(gather), label_rows(scatter), labels, near_order_.data()}, lists.overlap);
        report.entry("overlap").ms += watch.ms();
    }
    if (options.intersection != IntersectionKind::none) {
        const Stopwatch watch;
        if (!intersection_) intersection_.emplace();
        needs.intersection = intersection_->prepare(
            {label_rows(rows_), label_rows(half_rows_), nodes_.positions.data(), nodes_.periods,
             options.intersection == IntersectionKind::in_segment, labels, near_order_.data()},
            lists.intersection);
        report.entry("intersection").ms += watch.ms();
    }
    needs.check(options.budget);
    if (relabels_rows(options, request.layout) && options.rows) lists.rows.reserve();
    if (options.order == ListOrder::key && options.wants_pairs()) lists.half_rows.reserve();
    if (options.overlap) lists.overlap.reserve();
    if (options.intersection != IntersectionKind::none) lists.intersection.reserve();
}

/// Cannot fail.
template <int Dim>
void DerivedBuild<Dim>::commit(const DerivedRequest<Dim>& request, const Labels& labels,
                               MapLists lists, Report& report) {
    const MapOptions& options = request.options;
    if (options.overlap) {
        const Stopwatch watch;
        overlap_->commit(lists.overlap);
        report.entry("overlap").ms += watch.ms();
    }
    if (options.intersection != IntersectionKind::none) {
        const Stopwatch watch;
        intersection_->commit(lists.intersection);
        report.entry("intersection").ms += watch.ms();
    }
    commit_rows(request, labels, lists);
    clear_unwanted(options, lists);
    if (options.order == ListOrder::key) std::swap(lists.key_order, next_order_);
}

template <int Dim>
void DerivedBuild<Dim>::commit_rows(const DerivedRequest<Dim>& request, const Labels& labels,
                                    MapLists lists) {
    const MapOptions& options = request.options;
    if (options.order == ListOrder::key && options.wants_pairs()) {
        const Slot* const found = half_rows_.values().data();
        lists.half_rows.commit([=](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset k = offsets[first]; k < offsets[last]; ++k)
                values[k] = labels.slot(found[k]);
        });
    } else {
        std::swap(lists.half_rows, half_rows_);
    }
    if (!options.rows) return;
    if (!relabels_rows(options, request.layout)) return std::swap(lists.rows, rows_);
    const Offset n_lists = request.layout.n_lists();
    const Offset* const found = rows_.offsets().data();
    const Slot* const row = rows_.values().data();
    lists.rows.commit(
        [=](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset slot = first / n_lists; slot < last / n_lists; ++slot) {
                const Slot label = labels.label(static_cast<Slot>(slot));
                labels.write(row + found[label], found[label + 1] - found[label],
                             values + offsets[slot * n_lists]);
            }
        },
        64 * n_lists);
}

template <int Dim>
void DerivedBuild<Dim>::run(const DerivedRequest<Dim>& request, Search<Dim>& search, MapLists lists,
                            ConstView<Slot>& order, Report& report) {
    const MapOptions& options = request.options;
    const Stopwatch ordering;
    take_labels(request);
    const bool by_key = options.order == ListOrder::key;
    const Labels labels{request.layout, by_key ? next_order_.slots() : nullptr,
                        by_key ? next_order_.ranks() : nullptr};
    report.entry("key_order").ms = by_key ? ordering.ms() : 0;
    // Ranks are close where nodes are; slots need not be.
    near_order_ = {};
    const bool walks = options.overlap || options.intersection != IntersectionKind::none;
    if (options.spatial_order || (walks && !by_key))
        near_order_ = search.spatial_order(nodes_, report);
    if (near_order_.size() > 0 && !options.spatial_order)
        report.entry("order").asked_by = "overlap and intersections";
    try {
        search_rows(request, labels, search, report);
        prepare(request, labels, lists, report);
    } catch (...) {
        abandon(lists);
        forget(options);
        throw;
    }
    if (options.spatial_order) order = as_slots(labels);
    commit(request, labels, lists, report);
    forget(options);
}

/// Lets go of the caller's nodes, and of scratch memory for what was not asked for. Cannot fail.
template <int Dim>
void DerivedBuild<Dim>::forget(const MapOptions& options) {
    nodes_ = {};
    near_order_ = {};
    if (!options.overlap) overlap_.reset();
    if (!options.overlap || uniform_) gather_.clear(), scatter_.clear();
    if (options.intersection == IntersectionKind::none) intersection_.reset();
    if (options.interactions.empty() && options.exclude == nullptr) spare_.clear();
    if (options.order == ListOrder::key) return;
    next_order_.clear();
    positions_ = reach2_ = H_ = {};
    active_ = {};
}

/// The order of the search, by slot.
template <int Dim>
ConstView<Slot> DerivedBuild<Dim>::as_slots(const Labels& labels) {
    const View<Slot> slots = std::exchange(near_order_, {});
    for (std::size_t k = 0; k < slots.size(); ++k) slots(k) = labels.slot(slots(k));
    return slots;
}

template <int Dim>
Offset DerivedBuild<Dim>::bytes() const {
    Offset sum = (overlap_ ? overlap_->bytes() : 0) + (intersection_ ? intersection_->bytes() : 0) +
                 next_order_.bytes();
    for (const Csr* list : {&rows_, &half_rows_, &gather_, &scatter_, &spare_})
        sum += list->bytes();
    return sum +
           static_cast<Offset>((positions_.size() + reach2_.size() + H_.size()) * sizeof(double) +
                               by_list_.size() * sizeof(Slot) + active_.size());
}

template class DerivedBuild<1>;
template class DerivedBuild<2>;
template class DerivedBuild<3>;

}  // namespace connectivity
