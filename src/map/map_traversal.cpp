// SPDX-License-Identifier: BSD-3-Clause
#include "map_impl.hpp"

namespace connectivity {

namespace {

/// True while it lives.
class Traversing {
public:
    explicit Traversing(bool& flag) : flag_(flag) { flag_ = true; }
    ~Traversing() { flag_ = false; }
    Traversing(const Traversing&) = delete;
    Traversing& operator=(const Traversing&) = delete;

private:
    bool& flag_;
};

/// A host's function behind a filter of pairs.
class Filtered {
public:
    Filtered(const PairFilter& filter, RowFunction f)
        : filter_(filter), f_(f), row_(static_cast<std::size_t>(n_workers())) {}

    void operator()(int worker, Slot slot, std::span<const Slot> neighbours) {
        std::vector<Slot>& row = row_[static_cast<std::size_t>(worker)].slots;
        row.clear();
        for (const Slot j : neighbours)
            if (filter_.keeps(slot, j)) row.push_back(j);
        f_(worker, slot, row);
    }

private:
    struct alignas(64) Row {
        std::vector<Slot> slots;
    };
    const PairFilter& filter_;
    RowFunction f_;
    std::vector<Row> row_;  // [n_workers]
};

}  // namespace

void ConnectivityMap::for_each_row(std::span<const NodeList> lists, const MapOptions& options,
                                   RowFunction f) {
    MapOptions rows_only = options;
    rows_only.rows = true, rows_only.pairs = false;
    traverse("for_each_row", lists, rows_only, f);
}

void ConnectivityMap::for_each_half_row(std::span<const NodeList> lists, const MapOptions& options,
                                        RowFunction f) {
    MapOptions halves_only = options;
    halves_only.rows = false, halves_only.pairs = true;
    traverse("for_each_half_row", lists, halves_only, f);
}

void ConnectivityMap::traverse(const char* call, std::span<const NodeList> lists,
                               const MapOptions& options, RowFunction f) {
    check_request(call, lists, options);
    try {
        launch(call, [&] {
            const shim::ProfilingRegion region("map/traverse");
            const Traversing traversing(traversing_);
            switch (lists[0].dim()) {
                case 1: return traverse_in<1>(lists, options, f);
                case 2: return traverse_in<2>(lists, options, f);
                default: return traverse_in<3>(lists, options, f);
            }
        });
    } catch (const HostException& e) {
        std::rethrow_exception(e.cause);
    }
}

template <int Dim>
void ConnectivityMap::traverse_in(std::span<const NodeList> lists, const MapOptions& options,
                                  RowFunction f) {
    const Stopwatch preparing;
    Report report = report_;
    const SlotLayout layout = layout_of(lists, options);
    const SearchNodes<Dim> nodes =
        prepare_nodes<Dim>(lists, options.domain, impl_->storage, options.skin);
    report.entry("nodes").bytes = impl_->storage.bytes();
    const double prepared_ms = preparing.ms();
    const SearchRequest request{options.rows, options.pairs, options.mode, options.method, {}};
    const PairFilter filter(layout, options);
    if (filter.any()) {
        Filtered filtered(filter, f);
        impl_->search<Dim>().visit(nodes, layout, request, filtered, report);
    } else {
        impl_->search<Dim>().visit(nodes, layout, request, f, report);
    }
    report.entry("traversal").ms += prepared_ms;
    std::swap(report_, report);
    order_bytes_ = report_.entry("order").bytes;
}

}  // namespace connectivity
