// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"
#include "map_work.hpp"
#include "view_structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

/// Hands the pin over to the registry, with whose map and generation it is.
template <class Pin>
void* hand_over(const conn_map& map, std::unique_ptr<Pin> pin) {
    pin->map_number = map.number;
    pin->generation = map.map->generation();
    Pin* const owner = Registry::instance().add(std::move(pin));
    note_acquired(map);
    return owner;
}

/// rows() may throw; the view is then as it was. `based` is where a copy of them may be kept.
template <class Rows>
void acquire_rows(const conn_map& map, std::int32_t space, conn_rows_view* view, BasedCopy& based,
                  const Rows& rows) {
    conn_rows_view out = read_view(view, conn_rows_view CONN_ROWS_VIEW_INIT);
    auto pin = std::make_unique<RowsPin>();
    pin->rows = rows();
    pin->rows.slots = based.of(pin->rows.slots, map.base, pin->rows.generation);
    pin->list_offset = map.map->layout().list_offset();
    pin->row_offset = map.map->layout().row_offset();
    out.n_rows = pin->rows.n_rows();
    out.n_entries = pin->rows.size();
    out.generation = pin->rows.generation;
    out.n_lists = pin->rows.n_lists;
    out.space = space;
    out.offsets = pin->rows.offsets.data();
    out.slots = pin->rows.slots.data();
    out.list_offset = pin->list_offset.data();
    out.row_offset = pin->row_offset.data();
    out.owner = hand_over(map, std::move(pin));
    write_struct(view, out, out.struct_size);
}

const conn_map& handle_of(const conn_map* map) {
    return Registry::instance().get<const conn_map>(map, "map");
}

/// The pairs as the host counts their nodes.
NodePairList::View<> based_pairs(conn_map& map, bool expand) {
    NodePairList& pairs = map.map->pairs();
    if (map.base.is_zero()) return expand ? pairs.expanded_view() : pairs.view();
    const NodePairList::View<> ours = pairs.view();
    NodePairList::View<> theirs = ours;
    theirs.j = map.based.pair_j.of(ours.j, map.base, ours.generation);
    theirs.slots = map.based.key_order.of(ours.slots, map.base, ours.generation);
    if (expand)
        theirs.i = map.based.pair_i.made(ours.size(), ours.generation,
                                         [&](Slot* i) { write_first_nodes(ours, map.base, i); });
    return theirs;
}

}  // namespace

void connectivity::capi::write_first_nodes(const NodePairList::View<>& pairs, IndexBase base,
                                           Slot* i) {
    const auto expand = [=](const Offset row) {
        const Slot node = base.out(pairs.node(row));
        for (Offset k = pairs.offsets(row); k < pairs.offsets(row + 1); ++k) i[k] = node;
    };
    Kokkos::parallel_for(
        "capi/pairs/i",
        Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, pairs.n_slots()), expand);
    HostExec().fence();
}

void connectivity::capi::check_space(std::int32_t space) {
    if (space == CONN_SPACE_HOST) return;
    if (space == CONN_SPACE_HOST_PINNED || space == CONN_SPACE_DEVICE ||
        space == CONN_SPACE_MANAGED)
        throw Error(Status::unsupported, "space = " + std::to_string(space) +
                                             ": lists of this build are in "
                                             "CONN_SPACE_HOST");
    throw Error(Status::argument,
                "space = " + std::to_string(space) + ", must be one of CONN_SPACE_*");
}

conn_status conn_map_rows_acquire(const conn_map* map, int32_t space, conn_rows_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& ours = handle_of(map);
        check_space(space);
        acquire_rows(ours, space, view, ours.based.rows, [&] { return ours.map->rows(); });
    });
}

conn_status conn_map_overlap_acquire(const conn_map* map, int32_t space, conn_rows_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& ours = handle_of(map);
        check_space(space);
        acquire_rows(ours, space, view, ours.based.overlap, [&] { return ours.map->overlap(); });
    });
}

conn_status conn_map_rows_release(conn_rows_view* view) {
    return guarded(__func__,
                   [&] { release_view<RowsPin>(view, conn_rows_view CONN_ROWS_VIEW_INIT); });
}

conn_status conn_map_pairs_acquire(conn_map* map, int32_t space, int32_t flags,
                                   conn_pairs_view* view) {
    return guarded_with_runtime(__func__, [&] {
        auto& handle = Registry::instance().get<conn_map>(map, "map");
        const SlotLayout& layout = handle.map->layout();
        check_space(space);
        if ((flags & ~CONN_PAIRS_EXPAND) != 0)
            throw Error(Status::argument,
                        "flags = " + std::to_string(flags) + ", must be 0 or CONN_PAIRS_EXPAND");
        conn_pairs_view out = read_view(view, conn_pairs_view CONN_PAIRS_VIEW_INIT);
        auto pin = std::make_unique<PairsPin>();
        pin->pairs = based_pairs(handle, flags != 0);
        pin->list_offset = layout.list_offset();
        out.n_pairs = pin->pairs.size();
        out.n_slots = pin->pairs.n_slots();
        out.generation = pin->pairs.generation;
        out.n_lists = layout.n_lists();
        out.space = space;
        out.offsets = pin->pairs.offsets.data();
        out.i = pin->pairs.i.data();
        out.j = pin->pairs.j.data();
        out.coupling = pin->pairs.coupling.data();
        out.slots = pin->pairs.slots.data();
        out.ranks = pin->pairs.ranks.data();
        out.list_offset = pin->list_offset.data();
        out.owner = hand_over(handle, std::move(pin));
        write_struct(view, out, out.struct_size);
    });
}

conn_status conn_map_pairs_release(conn_pairs_view* view) {
    return guarded(__func__,
                   [&] { release_view<PairsPin>(view, conn_pairs_view CONN_PAIRS_VIEW_INIT); });
}

conn_status conn_map_intersection_acquire(const conn_map* map, int32_t space,
                                          conn_intersection_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_map& ours = handle_of(map);
        check_space(space);
        conn_intersection_view out =
            read_view(view, conn_intersection_view CONN_INTERSECTION_VIEW_INIT);
        auto pin = std::make_unique<IntersectionPin>();
        pin->nodes = ours.map->intersection();
        pin->nodes.slots =
            ours.based.intersection.of(pin->nodes.slots, ours.base, pin->nodes.generation);
        out.n_pairs = pin->nodes.n_pairs();
        out.n_entries = pin->nodes.size();
        out.generation = pin->nodes.generation;
        out.in_segment = pin->nodes.in_segment ? 1 : 0;
        out.space = space;
        out.offsets = pin->nodes.offsets.data();
        out.slots = pin->nodes.slots.data();
        out.owner = hand_over(ours, std::move(pin));
        write_struct(view, out, out.struct_size);
    });
}

conn_status conn_map_intersection_release(conn_intersection_view* view) {
    return guarded(__func__, [&] {
        release_view<IntersectionPin>(view, conn_intersection_view CONN_INTERSECTION_VIEW_INIT);
    });
}
