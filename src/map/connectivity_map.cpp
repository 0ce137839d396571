// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/connectivity_map.hpp>

#include <cmath>
#include <limits>
#include <tuple>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>

#include "drift.hpp"
#include "prepare.hpp"

namespace connectivity {

/// What survives from build to build: joined inputs, one searcher for each dimension in use, and
/// with a skin the state to measure drift from.
struct ConnectivityMap::Impl {
    PreparedStorage storage;
    DriftReference reference;
    std::tuple<Search<1>, Search<2>, Search<3>> searches;

    template <int Dim>
    Search<Dim>& search() {
        return std::get<Dim - 1>(searches);
    }
};

ConnectivityMap::ConnectivityMap() : impl_(std::make_unique<Impl>()) {}
ConnectivityMap::~ConnectivityMap() = default;
ConnectivityMap::ConnectivityMap(ConnectivityMap&&) noexcept = default;
ConnectivityMap& ConnectivityMap::operator=(ConnectivityMap&&) noexcept = default;

namespace {

/// `call` is the function whose arguments these are, for messages.
void check_request(const std::string& call, std::span<const NodeList> lists,
                   const MapOptions& options) {
    if (lists.empty()) throw Error(Status::argument, call + ": 0 node lists, must be at least 1");
    Offset n = 0;
    for (std::size_t l = 0; l < lists.size(); ++l) {
        if (lists[l].dim() != lists[0].dim())
            throw Error(Status::argument,
                        call + ": node list " + std::to_string(l) + " (\"" + lists[l].name() +
                            "\") has dim = " + std::to_string(lists[l].dim()) +
                            ", the first list has " + std::to_string(lists[0].dim()));
        n += lists[l].n();
    }
    if (n > max_slots)
        throw Error(Status::too_many, call + ": " + std::to_string(n) + " nodes, must be at most " +
                                          std::to_string(max_slots));
    if (options.pairs && options.mode != SearchMode::gather_scatter)
        throw Error(Status::argument,
                    call + ": pairs exist only for gather_scatter; ask for rows alone");
    if (options.budget.bytes < 0)
        throw Error(Status::argument, call + ": budget of " + std::to_string(options.budget.bytes) +
                                          " bytes, must be >= 0");
    if (options.skin != 0 && !(options.skin >= 1e-100 && options.skin <= 1e100))
        throw Error(Status::argument, call + ": skin = " + number(options.skin) +
                                          ", must be 0 or in [1e-100, 1e100]");
    options.domain.check(lists[0].dim());
}

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

SlotLayout layout_of(std::span<const NodeList> lists, bool ghost_rows) {
    std::vector<ListSize> sizes;
    for (const NodeList& list : lists) sizes.push_back({list.n(), list.n_internal()});
    return SlotLayout(sizes, ghost_rows);
}

}  // namespace

/// Runs body() where Kokkos may launch kernels, also for a caller inside an OpenMP region. Throws
/// Error{callback} inside a traversal of this map, which uses the threads.
template <class Body>
void ConnectivityMap::launch(const char* what, const Body& body) const {
    if (traversing_)
        throw Error(Status::callback,
                    std::string(what) + ": called from the function of a traversal of this map");
    shim::outside_parallel_region([&] {
        start_runtime();
        try {
            body();
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, std::string(what) + ": out of memory");
        }
    });
}

void ConnectivityMap::rebuild(std::span<const NodeList> lists, const MapOptions& options) {
    check_request("rebuild", lists, options);
    launch("rebuild", [&] {
        switch (lists[0].dim()) {
            case 1: return rebuild_in<1>(lists, options);
            case 2: return rebuild_in<2>(lists, options);
            default: return rebuild_in<3>(lists, options);
        }
    });
}

template <int Dim>
void ConnectivityMap::rebuild_in(std::span<const NodeList> lists, const MapOptions& options) {
    const shim::ProfilingRegion region("map/rebuild");
    Report report;
    SlotLayout layout = layout_of(lists, options.ghost_rows);
    std::vector<std::string> names;
    std::vector<Offset> n_internal;
    for (const NodeList& list : lists)
        names.push_back(list.name()), n_internal.push_back(list.n_internal());

    const Stopwatch preparing;
    const SearchNodes<Dim> nodes =
        prepare_nodes<Dim>(lists, options.domain, impl_->storage, options.skin);
    auto& prepared = report.entry("nodes");
    prepared = {"nodes",
                "search",
                lists.size() == 1 ? "checked where they lie" : "checked and laid end to end",
                true,
                false,
                impl_->storage.bytes(),
                preparing.ms()};

    const SearchRequest request{options.rows,   options.pairs,  options.mode,
                                options.method, options.budget, options.spatial_order};
    auto& search = impl_->search<Dim>();
    ConstView<Slot> order;
    if (options.spatial_order) order = search.spatial_order(nodes, report);
    reserve_reference(lists, options, report);
    search.run(nodes, layout, request, rows_, pairs_.half_rows_, report);

    // Nothing below can fail: this is where the new lists become the map's.
    layout_ = std::move(layout);
    list_names_.swap(names);
    n_internal_.swap(n_internal);
    dim_ = Dim;
    options_ = options;
    order_ = order;
    keep_reference(lists, report);
    std::swap(report_, report);
    if (!options.pairs) pairs_.first_ = {};
    pairs_.start_generation(++generation_, options.pairs);
    report_.entry("pairs").bytes = pairs_.bytes();
}

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
    const SlotLayout layout = layout_of(lists, options.ghost_rows);
    const SearchNodes<Dim> nodes =
        prepare_nodes<Dim>(lists, options.domain, impl_->storage, options.skin);
    report.entry("nodes").bytes = impl_->storage.bytes();
    const double prepared_ms = preparing.ms();
    const SearchRequest request{options.rows, options.pairs, options.mode, options.method, {}};
    impl_->search<Dim>().visit(nodes, layout, request, f, report);
    report.entry("traversal").ms += prepared_ms;
    std::swap(report_, report);
}

/// All that may fail; the lists are still the old ones.
void ConnectivityMap::reserve_reference(std::span<const NodeList> lists, const MapOptions& options,
                                        Report& report) {
    auto& entry = report.entry("skin");
    if (options.skin == 0) return;
    count_reuse(report);
    entry.asked_by = "caller";
    entry.reason = "positions and supports to measure drift from";
    entry.built = true;
    const Stopwatch reserving;
    const Offset held = impl_->reference.bytes();
    impl_->reference.reserve(lists);
    entry.reused = held > 0 && impl_->reference.bytes() == held;
    entry.ms = reserving.ms();
}

void ConnectivityMap::keep_reference(std::span<const NodeList> lists, Report& report) {
    const Stopwatch keeping;
    auto& entry = report.entry("skin");
    if (options_.skin > 0) {
        impl_->reference.keep(lists, options_.domain);
        entry.bytes = impl_->reference.bytes();
        entry.ms += keeping.ms();
    } else {
        impl_->reference.clear();
    }
    ++reuse_.rebuilds;
    if (options_.skin > 0) count_reuse(report);
}

/// Counters are whole numbers: the drift goes in as millionths of the skin.
void ConnectivityMap::count_reuse(Report& report) const {
    report.counter("rebuilds") = reuse_.rebuilds;
    report.counter("reuses") = reuse_.reuses;
    report.counter("max_drift_ppm") =
        options_.skin > 0 ? std::llround(std::min(1e6 * (reuse_.max_drift / options_.skin), 1e18))
                          : 0;
}

double ConnectivityMap::drift(std::span<const NodeList> lists) const {
    if (generation_ == 0 || options_.skin == 0) return std::numeric_limits<double>::infinity();
    double drift = 0;
    launch("drift", [&] { drift = impl_->reference.drift(lists); });
    return drift;
}

bool ConnectivityMap::needs_rebuild(std::span<const NodeList> lists, double* drift) {
    const double now = this->drift(lists);
    if (drift != nullptr) *drift = now;
    if (!(now <= options_.skin)) return true;
    ++reuse_.reuses;
    reuse_.max_drift = std::max(reuse_.max_drift, now);
    count_reuse(report_);
    return false;
}

RowsView<> ConnectivityMap::rows() const {
    if (generation_ == 0 || !options_.rows)
        throw Error(Status::not_built, "rows: the last rebuild was not asked for them");
    return {rows_.offsets(), rows_.values(), layout_.n_lists(), generation_};
}

const NodePairList& ConnectivityMap::pairs() const {
    if (generation_ == 0 || !options_.pairs)
        throw Error(Status::not_built, "pairs: the last rebuild was not asked for them");
    return pairs_;
}

NodePairList& ConnectivityMap::pairs() {
    return const_cast<NodePairList&>(std::as_const(*this).pairs());
}

ConstView<Slot> ConnectivityMap::spatial_order() const {
    if (generation_ == 0 || !options_.spatial_order)
        throw Error(Status::not_built, "spatial_order: the last rebuild was not asked for it");
    return order_;
}

View<Slot> ConnectivityMap::spatial_order(int list) const {
    const ConstView<Slot> all = spatial_order();
    if (list < 0 || list >= layout_.n_lists())
        throw Error(Status::argument, "spatial_order: list " + std::to_string(list) +
                                          ", must be in [0, " + std::to_string(layout_.n_lists()) +
                                          ")");
    const Offset first = layout_.list_offset()[list], last = layout_.list_offset()[list + 1];
    auto ids = allocate<Slot>("map/spatial_order", last - first);
    // Internal nodes keep the front of the list: two passes in the common order.
    const Offset n_internal = n_internal_[list];
    Offset internal = 0, ghost = n_internal;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all(k) >= first && all(k) < last) {
            const Offset id = all(k) - first;
            ids(id < n_internal ? internal++ : ghost++) = static_cast<Slot>(id);
        }
    return ids;
}

}  // namespace connectivity
