// SPDX-License-Identifier: BSD-3-Clause
// Culling: which ghosts do internal nodes name? The others leave the map, the lists and the blocks.
#include <atomic>

#include <connectivity/boundary/boundaries.hpp>

#include "launch.hpp"
#include "state.hpp"

namespace connectivity {

namespace {

/// All rows belong to internal nodes, and so does one end of each pair.
void check_may_cull(const ConnectivityMap& map, const GhostLists& ghosts) {
    if (map.generation() == 0 || (!map.options().rows && !map.options().pairs))
        throw Error(Status::not_built, "cull: the map has neither rows nor pairs");
    if (map.options().stores_all_rows())
        throw Error(Status::argument,
                    "cull: the map holds rows of ghosts, or overlap, intersections or a key order "
                    "that need them");
    bool same = map.layout().list_offset() == ghosts.layout().list_offset();
    for (int list = 0; same && list < ghosts.n_lists(); ++list)
        same = map.n_internal()[static_cast<std::size_t>(list)] == ghosts.n_internal(list);
    if (!same)
        throw Error(Status::stale,
                    "cull: the map was not built from the nodes of these boundaries");
}

/// Several threads may name one ghost.
void name(Slot* keep, Slot slot) {
    const std::atomic_ref<Slot> flag(keep[slot]);
    if (flag.load(std::memory_order_relaxed) == 0) flag.store(1, std::memory_order_relaxed);
}

/// Ghosts that rows name: they stand at the end of each list's part.
void flag_in_rows(const ConnectivityMap& map, Slot* keep) {
    const RowsView<> rows = map.rows();
    std::vector<Slot> first_ghost;
    first_ghost.reserve(map.n_internal().size());
    for (int list = 0; list < rows.n_lists; ++list)
        first_ghost.push_back(
            static_cast<Slot>(map.layout().list_offset()[static_cast<std::size_t>(list)] +
                              map.n_internal()[static_cast<std::size_t>(list)]));
    const Slot* const first = first_ghost.data();
    detail::for_each_item("boundary/cull/named", rows.n_rows(), [=](const Offset r) {
        for (int list = 0; list < rows.n_lists; ++list) {
            const auto row = rows(r, list);
            for (const Slot* j = row.end(); j != row.begin() && j[-1] >= first[list]; --j)
                name(keep, j[-1]);
        }
    });
}

/// Ghosts that internal nodes name; what it says of internal nodes means nothing.
void flag_named(const ConnectivityMap& map, const View<Slot>& flags) {
    Slot* const keep = flags.data();
    std::fill_n(keep, map.layout().n_slots(), 0);
    if (map.options().rows) return flag_in_rows(map, keep);
    const auto pairs = map.pairs().view();
    detail::for_each_item("boundary/cull/named", pairs.n_slots(), [=](const Offset i) {
        for (Offset k = pairs.offsets(i); k < pairs.offsets(i + 1); ++k) name(keep, pairs.j(k));
        if (pairs.offsets(i) < pairs.offsets(i + 1)) name(keep, static_cast<Slot>(i));
    });
}

}  // namespace

Offset Boundaries::cull(ConnectivityMap& map, CullRule rule,
                        std::span<PairFieldBase* const> fields) {
    const Stopwatch culling;
    State& state = *state_;
    check_may_cull(map, state.ghosts);
    const auto n_slots = static_cast<std::size_t>(map.layout().n_slots());
    Offset removed = 0;
    detail::launch("cull", [&] {
        ensure_capacity(keep_, "boundary/keep", static_cast<Offset>(n_slots));
        ensure_capacity(old2new_, "boundary/old2new", static_cast<Offset>(n_slots));
        flag_named(map, keep_);
        state.ghosts.keep_needed(keep_, rule);
        removed = state.ghosts.renumber(keep_, old2new_);
        if (removed == 0) return;
        std::vector<NodeList> kept = state.lists_after(keep_.data());
        map.patch(std::span<const Slot>(keep_.data(), n_slots),
                  std::span<const Slot>(old2new_.data(), n_slots), fields);
        state.drop(keep_, old2new_, kept);
    });
    report_cull(removed, culling.ms());
    return removed;
}

void Boundaries::report_cull(Offset removed, double ms) {
    auto& entry = report_.entry("cull");
    entry.asked_by = "caller";
    entry.reason = "ghosts that no internal node needs";
    entry.built = true;
    entry.bytes = static_cast<Offset>((keep_.size() + old2new_.size()) * sizeof(Slot));
    entry.ms = ms;
    report_.counter("ghosts_culled") += removed;
}

}  // namespace connectivity
