// SPDX-License-Identifier: BSD-3-Clause
#include "build_bytes.hpp"

#include <connectivity/base/parallel.hpp>

namespace connectivity {

namespace {

constexpr Offset mib = Offset{1} << 20;

Offset slots(Offset n) { return n * Offset{sizeof(Slot)}; }
Offset offsets(Offset n_rows) { return (n_rows + 1) * Offset{sizeof(Offset)}; }
Offset doubles(Offset n) { return n * Offset{sizeof(double)}; }

bool has_filter(const MapOptions& options) {
    return !options.interactions.empty() || options.exclude != nullptr;
}

/// Each worker has started a block of 32 KiB for every range of slots, of which there are up to 512
/// where rows outgrow the caches, and chunks of blocks that double up to 64 MiB: see
/// search/row_store.hpp and search/row_arena.hpp.
Offset arena_bytes(Offset n_entries) {
    const Offset workers = n_workers(),
                 ranges = std::min(slots(n_entries) / (mib / 4), Offset{512}),
                 used = slots(n_entries) + workers * (ranges + 2) * (mib / 32);
    return std::min(2 * used + workers * mib, used + workers * 64 * mib);
}

/// Rows wait in arenas, with a record of every slot and, in several lists, counts by list.
Offset search_bytes(const BuildSizes& sizes, const MapOptions& options, const SlotLayout& layout) {
    constexpr Offset record = 16, worker = 4 * mib;
    Offset in_arenas = options.rows ? sizes.found.entries : 0;
    if (options.wants_pairs()) in_arenas += options.rows ? sizes.later_halves : sizes.found.pairs;
    const bool by_list = options.rows && layout.n_lists() > 1;
    return arena_bytes(in_arenas) + record * layout.n_slots() +
           (by_list ? slots(layout.n_rows() * layout.n_lists()) : 0) +
           std::max(2 * sizes.scratch, n_workers() * worker);
}

/// Lists before pairs were left out: the half rows then lie where the rows did.
Offset unfiltered_bytes(const BuildSizes& sizes, const MapOptions& options,
                        const SlotLayout& layout) {
    if (!has_filter(options)) return 0;
    Offset bytes = 0;
    if (options.rows)
        bytes += offsets(std::max(layout.n_rows() * layout.n_lists(), layout.n_slots())) +
                 slots(sizes.found.entries);
    if (options.wants_pairs()) bytes += offsets(layout.n_slots()) + slots(sizes.found.pairs);
    if (options.rows && options.wants_pairs()) bytes -= slots(sizes.kept.pairs);
    return bytes;
}

/// Lists by label, and counts of what they become.
Offset relabelled_bytes(const BuildSizes& sizes, const MapOptions& options,
                        const SlotLayout& layout) {
    const bool by_key = options.order == ListOrder::key,
               cut = options.stores_all_rows() && layout.n_lists() > 1;
    const Offset n = layout.n_slots();
    Offset bytes = 0;
    if (options.rows && (by_key || cut))
        bytes += offsets(n) + slots(sizes.kept.entries) + slots(n * layout.n_lists());
    if (options.wants_pairs() && by_key) bytes += offsets(n) + slots(sizes.kept.pairs);
    return bytes;
}

/// The nodes by rank, and what sorted them.
Offset ranked_bytes(std::span<const NodeList> lists, const MapOptions& options,
                    const SlotLayout& layout) {
    if (options.order != ListOrder::key) return 0;
    constexpr Offset sort = 32;
    const int dim = lists[0].dim();
    const bool tensors = std::any_of(lists.begin(), lists.end(),
                                     [](const NodeList& list) { return list.has_tensor(); });
    return layout.n_slots() * (sort + doubles(dim + 1 + (tensors ? n_symmetric(dim) : 0))) +
           static_cast<Offset>(options.active.size());
}

/// Positions and supports to measure drift from.
Offset reference_bytes(std::span<const NodeList> lists, const MapOptions& options) {
    if (options.skin == 0) return 0;
    Offset n = 0;
    for (const NodeList& list : lists)
        n += list.n() * (list.dim() + (list.has_tensor() ? n_symmetric(list.dim()) : 1));
    return doubles(n);
}

}  // namespace

Offset list_bytes(const BuildSizes& sizes, const MapOptions& options, const SlotLayout& layout) {
    const Offset n = layout.n_slots();
    Offset bytes = 0;
    if (options.rows)
        bytes += offsets(layout.n_rows() * layout.n_lists()) + slots(sizes.kept.entries);
    if (options.wants_pairs()) bytes += offsets(n) + slots(sizes.kept.pairs);
    if (options.order == ListOrder::key) bytes += slots(2 * n) + n * Offset{sizeof(std::uint64_t)};
    if (options.spatial_order) bytes += slots(n);
    return bytes;
}

Offset spare_bytes(const BuildSizes& sizes, std::span<const NodeList> lists,
                   const MapOptions& options, const SlotLayout& layout) {
    const Offset derived = options.is_derived() ? unfiltered_bytes(sizes, options, layout) +
                                                      relabelled_bytes(sizes, options, layout)
                                                : 0;
    return sizes.nodes + static_cast<Offset>(options.active.size()) + sizes.order +
           search_bytes(sizes, options, layout) + derived + ranked_bytes(lists, options, layout) +
           reference_bytes(lists, options);
}

}  // namespace connectivity
