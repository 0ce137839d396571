/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_traverse.h
 * Traversal: every row or half row to a callback, and nothing stored. See connectivity.h.
 */
#ifndef CONNECTIVITY_TRAVERSE_H
#define CONNECTIVITY_TRAVERSE_H

#include "connectivity_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Traversal: every row or half row once, and no list is stored */
/**@{*/
enum {
    CONN_ROWS = 1, /**< all neighbours of every stored node */
    CONN_PAIRS = 2 /**< the partners of every slot after it, j > i: each pair once */
};

/** Receives a block of n_rows rows: the neighbours of node slots[r] are
 * neighbours[offsets[r] .. offsets[r+1]), ascending; offsets[0] is 0; neighbours may be NULL where
 * no row has any. The arrays are the library's, valid during the call only. worker, at least 0 and
 * less than conn_context_threads(), tells calls apart that run at the same time: memory per worker
 * needs no lock. A result other than 0 stops the traversal. */
typedef int32_t (*conn_rows_callback)(void* user_data, int32_t worker, int64_t n_rows,
                                      const int32_t* slots, const int64_t* offsets,
                                      const int32_t* neighbours);

/** Finds all neighbours of lists[n_lists] with the map's options, as conn_map_rebuild does, and
 * hands them to the callback instead of storing them: what is CONN_ROWS or CONN_PAIRS, with the
 * content that rows and pairs of a rebuild would have. The callback is called from several threads
 * at once, with blocks of at most 4096 neighbours or one longer row; each stored node (CONN_ROWS)
 * or each slot (CONN_PAIRS) comes in exactly one block, also without neighbours, in any order. The
 * options rows, pairs, spatial_order and budget_bytes do not count; neighbours ascend by slot, and
 * partners are those with a higher slot, also with CONN_ORDER_KEY. Slots are numbered as in a
 * rebuild. The map's lists, views and generation stay as they are; its report gains an entry
 * "traversal".
 * CONN_E_CALLBACK if the callback returned other than 0: the last error then has that number and
 * the text of conn_set_error, and no block was begun afterwards but on other threads at that
 * moment. CONN_E_ARGUMENT for CONN_PAIRS with another mode than CONN_GATHER_SCATTER. */
CONN_API conn_status conn_map_traverse(conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                                       int32_t what, conn_rows_callback callback, void* user_data);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
