// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/estimate.hpp>

#include <cmath>

#include "build_bytes.hpp"
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
    Slot uncounted = -1;  // searched for the scratch memory it takes, but not in the sample
};

/// The node that reaches furthest may take most of the memory of a search.
void search_widest(Sample& sample) {
    Slot widest = -1;
    for (Slot slot = 0; slot < sample.layout.n_slots(); ++slot)
        if (sample.layout.is_stored(slot) &&
            (widest < 0 || sample.reach(slot) > sample.reach(widest)))
            widest = slot;
    if (widest < 0 || sample.active(widest) != 0) return;
    sample.active(widest) = 1;
    sample.uncounted = widest;
}

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
    search_widest(sample);
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
    Moments entries, pairs;              // of the lists
    Moments found_entries, found_pairs;  // with pairs that are to be left out
    Moments later_halves;                // found pairs whose first node has no row

    void add(const RowMoments& other) {
        entries.add(other.entries), pairs.add(other.pairs);
        found_entries.add(other.found_entries), found_pairs.add(other.found_pairs);
        later_halves.add(other.later_halves);
    }
};

/// Adds up rows as a traversal hands them over, and leaves out pairs itself.
class Counter {
public:
    Counter(const Sample& sample, const MapOptions& options)
        : sample_(sample),
          filter_(sample.layout, options),
          is_symmetric_(options.mode == SearchMode::gather_scatter),
          by_key_(options.order == ListOrder::key),
          sums_(n_workers()) {}

    void operator()(int worker, Slot i, std::span<const Slot> neighbours) {
        if (sample_.active(i) == 0 || i == sample_.uncounted) return;
        Twice kept, found;
        Offset later = 0;
        for (const Slot j : neighbours) {
            const Twice share = share_of(i, j);
            found += share;
            if (!filter_.any() || filter_.keeps(i, j)) kept += share;
            // Who is first by key is not known here.
            if (!sample_.layout.is_stored(j) && (by_key_ || j < i)) later += 2;
        }
        RowMoments& sums = sums_[static_cast<std::size_t>(worker)];
        sums.entries.add(kept.entries), sums.pairs.add(kept.pairs);
        sums.found_entries.add(found.entries), sums.found_pairs.add(found.pairs);
        sums.later_halves.add(later);
    }

    RowMoments total() const {
        RowMoments all;
        for (const RowMoments& sums : sums_) all.add(sums);
        return all;
    }

private:
    struct Twice {
        Offset entries = 0, pairs = 0;
        void operator+=(const Twice& other) { entries += other.entries, pairs += other.pairs; }
    };

    /// Twice what an entry of row i adds.
    Twice share_of(Slot i, Slot j) const {
        if (!is_symmetric_ || !sample_.layout.is_stored(j)) return {2, 2};
        const double mine = sample_.reach(i), other = sample_.reach(j);
        const int share = mine < other ? 2 : mine == other ? 1 : 0;
        return {2 * share, share};
    }

    const Sample& sample_;
    PairFilter filter_;
    bool is_symmetric_, by_key_;
    std::vector<RowMoments> sums_;  // [n_workers]
};

/// The search of a rebuild, for the rows of the sample alone, with all pairs.
MapOptions sampling(const MapOptions& options, const Sample& sample) {
    MapOptions rows = options;
    rows.ghost_rows = options.stores_all_rows();
    rows.overlap = rows.spatial_order = rows.pairs = false;
    rows.intersection = IntersectionKind::none;
    rows.order = ListOrder::slot;
    rows.active = sample.active;
    rows.interactions.clear();
    rows.exclude.reset();
    return rows;
}

Offset bytes_of(const Report& report, const char* product) {
    const ReportEntry* const entry = report.find(product);
    return entry != nullptr ? entry->bytes : 0;
}

/// The lists by the sample, the rest as the traversal left it.
BuildSizes sizes_of(const RowMoments& all, const Sample& sample, const Report& report) {
    BuildSizes sizes;
    sizes.kept = {all.entries.total(sample), all.pairs.total(sample)};
    sizes.found = {all.found_entries.total(sample), all.found_pairs.total(sample)};
    sizes.later_halves = all.later_halves.total(sample);
    sizes.nodes = bytes_of(report, "nodes");
    sizes.order = bytes_of(report, "order");
    sizes.scratch = bytes_of(report, "scratch");
    return sizes;
}

/// Three standard errors more, so that chance does not make the peak too low.
BuildSizes widened(BuildSizes sizes, const RowMoments& all, const Sample& sample) {
    const double entries = 1 + 3 * all.found_entries.relative_error(sample),
                 pairs = 1 + 3 * all.found_pairs.relative_error(sample);
    const auto widen = [](Offset& n, double by) { n = std::llround(static_cast<double>(n) * by); };
    for (ListSizes* const lists : {&sizes.kept, &sizes.found})
        widen(lists->entries, entries), widen(lists->pairs, pairs);
    widen(sizes.later_halves, entries);
    return sizes;
}

}  // namespace

MapEstimate estimate(std::span<const NodeList> lists, const MapOptions& options,
                     const EstimateLimits& limits) {
    check_request("estimate", lists, options);
    MapEstimate found;
    run_kernels("estimate", [&] {
        const Sample sample = choose(lists, options, limits);
        Counter counter(sample, options);
        ConnectivityMap map;
        map.for_each_row(lists, sampling(options, sample), counter);
        const RowMoments all = counter.total();
        const BuildSizes sizes = sizes_of(all, sample, map.report()),
                         most = widened(sizes, all, sample);
        found.n_sampled = sample.n_sampled;
        if (options.rows) found.n_entries = sizes.kept.entries;
        if (options.wants_pairs()) found.n_pairs = sizes.kept.pairs;
        found.relative_error =
            std::max(options.rows ? all.entries.relative_error(sample) : 0,
                     options.wants_pairs() ? all.pairs.relative_error(sample) : 0);
        found.bytes = list_bytes(sizes, options, sample.layout);
        found.peak_bytes = list_bytes(most, options, sample.layout) +
                           spare_bytes(most, lists, options, sample.layout);
        found.is_lower_bound = options.overlap || options.intersection != IntersectionKind::none;
    });
    return found;
}

}  // namespace connectivity
