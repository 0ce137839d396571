/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_views.h
 * Views: rows, pairs, overlap and intersections, without a copy. See connectivity.h.
 */
#ifndef CONNECTIVITY_VIEWS_H
#define CONNECTIVITY_VIEWS_H

#include "connectivity_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Views: the lists themselves, without a copy
 * A view is pinned: its arrays stay valid and unchanged until it is released, through rebuilds,
 * patches and the end of the map. A rebuild while a view is held takes new memory; release first to
 * reuse it. Slots count from the map's index_base, all else from 0. A view is current while its
 * generation is that of the map. Arrays of length 0 may be NULL. */
/**@{*/
typedef struct conn_rows_view {
    size_t struct_size;
    int64_t n_rows;
    int64_t n_entries;
    uint64_t generation;
    int32_t n_lists;
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int64_t* offsets;     /**< [n_rows*n_lists + 1]; the neighbours of row r in list l are
                                     slots[offsets[r*n_lists+l] .. offsets[r*n_lists+l+1]) */
    const int32_t* slots;       /**< [n_entries] ascending within a row, in key order by rank
                                     within a row and list; never the node itself */
    const int64_t* list_offset; /**< [n_lists + 1] */
    const int64_t* row_offset;  /**< [n_lists + 1] */
    void* owner;                /**< private */
} conn_rows_view;
#define CONN_ROWS_VIEW_INIT \
    { sizeof(conn_rows_view), 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL }

typedef struct conn_pairs_view {
    size_t struct_size;
    int64_t n_pairs;
    int64_t n_slots;
    uint64_t generation;
    int32_t n_lists;
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int64_t* offsets;     /**< [n_slots + 1]; the pairs whose first node is r are
                                     [offsets[r] .. offsets[r+1]). r is a slot, less the index_base;
                                     in key order a rank, that of the node slots[r] */
    const int32_t* i;           /**< [n_pairs] slots, or NULL unless CONN_PAIRS_EXPAND was asked
                                     for */
    const int32_t* j;           /**< [n_pairs] slots, i < j, pairs sorted by (i, j); in key order
                                     the same of their ranks */
    const double* coupling;     /**< [n_pairs] in [0, 1]; NULL: 1 for all pairs */
    const int64_t* list_offset; /**< [n_lists + 1] */
    void* owner;                /**< private */
    const int32_t* slots;       /**< [n_slots] slot by rank, of key order; NULL in slot order */
    const int32_t* ranks;       /**< [n_slots] rank by slot less the index_base, of key order;
                                     NULL in slot order */
} conn_pairs_view;
#define CONN_PAIRS_VIEW_INIT \
    { sizeof(conn_pairs_view), 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

typedef struct conn_intersection_view {
    size_t struct_size;
    int64_t n_pairs;
    int64_t n_entries;
    uint64_t generation;
    int32_t in_segment; /**< 1: only those between the two nodes */
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int64_t* offsets; /**< [n_pairs + 1]; the nodes of pair k of the pair list are
                                 slots[offsets[k] .. offsets[k+1]) */
    const int32_t* slots;   /**< [n_entries] common neighbours of the two and both themselves,
                                 ascending, in key order by rank */
    void* owner;            /**< private */
} conn_intersection_view;
#define CONN_INTERSECTION_VIEW_INIT \
    { sizeof(conn_intersection_view), 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL }

enum { CONN_PAIRS_EXPAND = 1 /**< also the array i: 4 bytes a pair, made once a generation */ };

/** Pins the rows in the given space. view must be initialised and not hold another view.
 * CONN_E_NOT_BUILT if the last rebuild had no rows. */
CONN_API conn_status conn_map_rows_acquire(const conn_map* map, int32_t space,
                                           conn_rows_view* view);
/** Lets go of the rows; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_map_rows_release(conn_rows_view* view);
/** Pins the pairs; flags: 0 or CONN_PAIRS_EXPAND. CONN_E_NOT_BUILT if there are none. */
CONN_API conn_status conn_map_pairs_acquire(conn_map* map, int32_t space, int32_t flags,
                                            conn_pairs_view* view);
/** Lets go of the pairs, as conn_map_rows_release of rows. */
CONN_API conn_status conn_map_pairs_release(conn_pairs_view* view);
/** Pins the rows of overlap: of every node, ghosts too, the nodes that see a common node with it,
 * each node being in its own sight, so that a row holds all neighbours. Only nodes are witnesses:
 * supports that overlap where no node is do not count. Released by conn_map_rows_release.
 * CONN_E_NOT_BUILT unless the last rebuild had overlap. */
CONN_API conn_status conn_map_overlap_acquire(const conn_map* map, int32_t space,
                                              conn_rows_view* view);
/** Pins the intersections. CONN_E_NOT_BUILT unless the last rebuild had them. */
CONN_API conn_status conn_map_intersection_acquire(const conn_map* map, int32_t space,
                                                   conn_intersection_view* view);
/** Lets go of the intersections, as conn_map_rows_release of rows. */
CONN_API conn_status conn_map_intersection_release(conn_intersection_view* view);
/**@}*/

/** @name Copies into arrays of the host
 * A NULL array is not written. The sizes are always set; CONN_E_BUFFER, before anything is written,
 * if an array that is not NULL has less room. CONN_E_NOT_BUILT as for views. */
/**@{*/
/** offsets [n_rows*n_lists + 1] and slots [n_entries], as in conn_rows_view. */
CONN_API conn_status conn_map_rows_copy(const conn_map* map, int64_t* offsets,
                                        int64_t offsets_capacity, int64_t* n_offsets,
                                        int32_t* slots, int64_t slots_capacity, int64_t* n_slots);
/** i, j and coupling [n_pairs]; coupling is 1 where none was set. */
CONN_API conn_status conn_map_pairs_copy(const conn_map* map, int32_t* i, int32_t* j,
                                         double* coupling, int64_t capacity, int64_t* n_pairs);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
