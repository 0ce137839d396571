// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/estimate.hpp>

#include <cmath>

#include "map_impl.hpp"

namespace connectivity {

namespace {

/// Chooses nodes by their number alone.
std::uint64_t scrambled(std::uint64_t slot) {
    std::uint64_t z = slot * 0x9E3779B97F4A7C15u + 0x632BE59BD9B4E019u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// What orders nodes by their support: larger where it reaches further.
double reach(const NodeList& list, Offset node) {
    if (!list.has_tensor()) return list.h()(node);
    const int dim = list.dim(), n = n_symmetric(dim);
    double trace = 0;
    for (int d = 0, at = 0; d < dim; at += dim - d, ++d) trace += list.H()(node * n + at);
    return dim / trace;
}

/// Which stored nodes are counted, and what tells the two ends of a pair apart.
struct Sample {
    SlotLayout layout;
    View<std::uint8_t> active;  // [n_slots]
    View<double> reach;         // [n_slots]
    Offset n_stored = 0, n_sampled = 0;
};

Sample choose(std::span<const NodeList> lists, const MapOptions& options,
              const EstimateLimits& limits) {
    Sample sample{layout_of(lists, options), {}, {}, 0, 0};
    const Offset n = sample.layout.n_slots();
    sample.active = allocate_zeroed<std::uint8_t>("map/estimate/active", n);
    sample.reach = allocate<double>("map/estimate/reach", n);
    Offset slot = 0;
    for (const NodeList& list : lists)
        for (Offset node = 0; node < list.n(); ++node, ++slot) {
            sample.reach(slot) = reach(list, node);
            sample.n_stored += sample.layout.is_stored(slot) ? 1 : 0;
        }
    const double share =
        sample.n_stored > limits.exact_rows
            ? static_cast<double>(limits.n_sampled) / static_cast<double>(sample.n_stored)
            : 1;
    for (slot = 0; slot < n; ++slot) {
        if (!sample.layout.is_stored(slot)) continue;
        const double lot =
            static_cast<double>(scrambled(static_cast<std::uint64_t>(slot)) >> 11) * 0x1p-53;
        sample.active(slot) = lot < share ? 1 : 0;
        sample.n_sampled += sample.active(slot);
    }
    return sample;
}

/// Sums over sampled rows of twice what a row adds, and of its square.
struct Moments {
    Offset sum = 0;
    double squares = 0;

    void add(Offset twice) {
        sum += twice;
        squares += static_cast<double>(twice) * static_cast<double>(twice);
    }
    void add(const Moments& other) { sum += other.sum, squares += other.squares; }

    Offset total(const Sample& sample) const {
        if (sample.n_sampled == sample.n_stored) return sum / 2;
        return std::llround(0.5 * static_cast<double>(sum) * static_cast<double>(sample.n_stored) /
                            static_cast<double>(sample.n_sampled));
    }
    double relative_error(const Sample& sample) const {
        if (sample.n_sampled == sample.n_stored || sum == 0) return 0;
        const auto m = static_cast<double>(sample.n_sampled);
        const double mean = static_cast<double>(sum) / m,
                     variance = std::max(0.0, squares / m - mean * mean) * m / (m - 1),
                     missing = 1 - m / static_cast<double>(sample.n_stored);
        return std::sqrt(variance * missing / m) / mean;
    }
};

struct alignas(64) RowMoments {
    Moments entries, pairs;
};

/// Adds up rows as a traversal hands them over.
class Counter {
public:
    Counter(const Sample& sample, bool is_symmetric)
        : sample_(sample), is_symmetric_(is_symmetric), sums_(n_workers()) {}

    void operator()(int worker, Slot i, std::span<const Slot> neighbours) {
        if (sample_.active(i) == 0) return;
        Offset entries = 0, pairs = 0;  // twice
        for (const Slot j : neighbours) {
            if (!is_symmetric_ || !sample_.layout.is_stored(j)) {
                entries += 2, pairs += 2;
                continue;
            }
            const double mine = sample_.reach(i), other = sample_.reach(j);
            const int share = mine < other ? 2 : mine == other ? 1 : 0;
            entries += 2 * share, pairs += share;
        }
        sums_[static_cast<std::size_t>(worker)].entries.add(entries);
        sums_[static_cast<std::size_t>(worker)].pairs.add(pairs);
    }

    RowMoments total() const {
        RowMoments all;
        for (const RowMoments& sums : sums_)
            all.entries.add(sums.entries), all.pairs.add(sums.pairs);
        return all;
    }

private:
    const Sample& sample_;
    bool is_symmetric_;
    std::vector<RowMoments> sums_;  // [n_workers]
};

/// The search of a rebuild, for the rows of the sample alone.
MapOptions sampling(const MapOptions& options, const Sample& sample) {
    MapOptions rows = options;
    rows.ghost_rows = options.stores_all_rows();
    rows.overlap = rows.spatial_order = rows.pairs = false;
    rows.intersection = IntersectionKind::none;
    rows.order = ListOrder::slot;
    rows.active = sample.active;
    return rows;
}

Offset list_bytes(const MapEstimate& found, const MapOptions& options, const SlotLayout& layout) {
    constexpr Offset offset = sizeof(Offset), slot = sizeof(Slot), key = sizeof(std::uint64_t);
    Offset bytes = 0;
    if (options.rows)
        bytes += offset * (layout.n_rows() * layout.n_lists() + 1) + slot * found.n_entries;
    if (options.wants_pairs()) bytes += offset * (layout.n_slots() + 1) + slot * found.n_pairs;
    if (options.order == ListOrder::key) bytes += (2 * slot + key) * layout.n_slots();
    if (options.spatial_order) bytes += slot * layout.n_slots();
    return bytes;
}

/// What a search holds beside the lists: `held` are nodes and order, as a traversal left them.
Offset search_bytes(Offset held, const RowMoments& all, const Sample& sample,
                    const MapOptions& options) {
    constexpr Offset record = 16, worker = Offset{4} << 20, spare = 3;
    const Offset n_found =
        options.rows || options.is_derived() ? all.entries.total(sample) : all.pairs.total(sample);
    const Offset rows = spare * Offset{sizeof(Slot)} * n_found + n_workers() * worker,
                 by_list =
                     sample.layout.n_lists() > 1
                         ? Offset{sizeof(Slot)} * sample.layout.n_rows() * sample.layout.n_lists()
                         : 0;
    const Offset again = options.is_derived() ? Offset{sizeof(Slot)} * n_found : 0;
    return held + record * sample.layout.n_slots() + rows + by_list + again;
}

Offset bytes_of(const Report& report, const char* product) {
    const ReportEntry* const entry = report.find(product);
    return entry != nullptr ? entry->bytes : 0;
}

}  // namespace

MapEstimate estimate(std::span<const NodeList> lists, const MapOptions& options,
                     const EstimateLimits& limits) {
    check_request("estimate", lists, options);
    MapEstimate found;
    run_kernels("estimate", [&] {
        const Sample sample = choose(lists, options, limits);
        Counter counter(sample, options.mode == SearchMode::gather_scatter);
        ConnectivityMap map;
        map.for_each_row(lists, sampling(options, sample), counter);
        const RowMoments all = counter.total();
        found.n_sampled = sample.n_sampled;
        if (options.rows) found.n_entries = all.entries.total(sample);
        if (options.wants_pairs()) found.n_pairs = all.pairs.total(sample);
        found.relative_error =
            std::max(options.rows ? all.entries.relative_error(sample) : 0,
                     options.wants_pairs() ? all.pairs.relative_error(sample) : 0);
        found.bytes = list_bytes(found, options, sample.layout);
        const Offset held = bytes_of(map.report(), "nodes") + bytes_of(map.report(), "order");
        found.peak_bytes = found.bytes + search_bytes(held, all, sample, options);
    });
    return found;
}

}  // namespace connectivity
