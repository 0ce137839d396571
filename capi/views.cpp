// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"
#include "objects.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

void check_space(std::int32_t space) {
    if (space == CONN_SPACE_HOST) return;
    if (space == CONN_SPACE_HOST_PINNED || space == CONN_SPACE_DEVICE ||
        space == CONN_SPACE_MANAGED)
        throw Error(Status::unsupported, "space = " + std::to_string(space) +
                                             ": lists of this build are in "
                                             "CONN_SPACE_HOST");
    throw Error(Status::argument,
                "space = " + std::to_string(space) + ", must be one of CONN_SPACE_*");
}

/// The host's struct, ready to be filled. Throws Error{argument} if it pins something already.
template <class T>
T read_view(const T* view, const T& empty) {
    const T given = read_struct(view, empty, "view");
    if (given.owner != nullptr)
        throw Error(
            Status::argument,
            "view->owner is set: the view was not initialised, or still holds another view");
    T ours = empty;
    ours.struct_size = given.struct_size;
    return ours;
}

template <class Pin, class T>
void release(T* view, const T& empty) {
    if (view == nullptr) return;
    T given = read_struct(view, empty, "view");
    auto* pin = static_cast<Pin*>(given.owner);
    Registry::instance().destroy(&pin, "view->owner");
    write_struct(view, empty, given.struct_size);
}

const ConnectivityMap& map_of(const conn_map* handle) {
    return *Registry::instance().get<const conn_map>(handle, "map").map;
}

/// rows() may throw; the view is then as it was.
template <class Rows>
void acquire_rows(const ConnectivityMap& map, std::int32_t space, conn_rows_view* view,
                  const Rows& rows) {
    conn_rows_view out = read_view(view, conn_rows_view CONN_ROWS_VIEW_INIT);
    auto pin = std::make_unique<RowsPin>();
    pin->rows = rows();
    pin->list_offset = map.layout().list_offset();
    pin->row_offset = map.layout().row_offset();
    out.n_rows = pin->rows.n_rows();
    out.n_entries = pin->rows.size();
    out.generation = pin->rows.generation;
    out.n_lists = pin->rows.n_lists;
    out.space = space;
    out.offsets = pin->rows.offsets.data();
    out.slots = pin->rows.slots.data();
    out.list_offset = pin->list_offset.data();
    out.row_offset = pin->row_offset.data();
    out.owner = Registry::instance().add(std::move(pin));
    write_struct(view, out, out.struct_size);
}

}  // namespace

conn_status conn_map_rows_acquire(const conn_map* map, int32_t space, conn_rows_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const ConnectivityMap& ours = map_of(map);
        check_space(space);
        acquire_rows(ours, space, view, [&] { return ours.rows(); });
    });
}

conn_status conn_map_overlap_acquire(const conn_map* map, int32_t space, conn_rows_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const ConnectivityMap& ours = map_of(map);
        check_space(space);
        acquire_rows(ours, space, view, [&] { return ours.overlap(); });
    });
}

conn_status conn_map_rows_release(conn_rows_view* view) {
    return guarded(__func__, [&] { release<RowsPin>(view, conn_rows_view CONN_ROWS_VIEW_INIT); });
}

conn_status conn_map_pairs_acquire(conn_map* map, int32_t space, int32_t flags,
                                   conn_pairs_view* view) {
    return guarded_with_runtime(__func__, [&] {
        ConnectivityMap& ours = *Registry::instance().get<conn_map>(map, "map").map;
        check_space(space);
        if ((flags & ~CONN_PAIRS_EXPAND) != 0)
            throw Error(Status::argument,
                        "flags = " + std::to_string(flags) + ", must be 0 or CONN_PAIRS_EXPAND");
        conn_pairs_view out = read_view(view, conn_pairs_view CONN_PAIRS_VIEW_INIT);
        auto pin = std::make_unique<PairsPin>();
        pin->pairs = flags != 0 ? ours.pairs().expanded_view() : ours.pairs().view();
        pin->list_offset = ours.layout().list_offset();
        out.n_pairs = pin->pairs.size();
        out.n_slots = pin->pairs.n_slots();
        out.generation = pin->pairs.generation;
        out.n_lists = ours.layout().n_lists();
        out.space = space;
        out.offsets = pin->pairs.offsets.data();
        out.i = pin->pairs.i.data();
        out.j = pin->pairs.j.data();
        out.coupling = pin->pairs.coupling.data();
        out.slots = pin->pairs.slots.data();
        out.ranks = pin->pairs.ranks.data();
        out.list_offset = pin->list_offset.data();
        out.owner = Registry::instance().add(std::move(pin));
        write_struct(view, out, out.struct_size);
    });
}

conn_status conn_map_pairs_release(conn_pairs_view* view) {
    return guarded(__func__,
                   [&] { release<PairsPin>(view, conn_pairs_view CONN_PAIRS_VIEW_INIT); });
}

conn_status conn_map_intersection_acquire(const conn_map* map, int32_t space,
                                          conn_intersection_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const ConnectivityMap& ours = map_of(map);
        check_space(space);
        conn_intersection_view out =
            read_view(view, conn_intersection_view CONN_INTERSECTION_VIEW_INIT);
        auto pin = std::make_unique<IntersectionPin>();
        pin->nodes = ours.intersection();
        out.n_pairs = pin->nodes.n_pairs();
        out.n_entries = pin->nodes.size();
        out.generation = pin->nodes.generation;
        out.in_segment = pin->nodes.in_segment ? 1 : 0;
        out.space = space;
        out.offsets = pin->nodes.offsets.data();
        out.slots = pin->nodes.slots.data();
        out.owner = Registry::instance().add(std::move(pin));
        write_struct(view, out, out.struct_size);
    });
}

conn_status conn_map_intersection_release(conn_intersection_view* view) {
    return guarded(__func__, [&] {
        release<IntersectionPin>(view, conn_intersection_view CONN_INTERSECTION_VIEW_INIT);
    });
}
