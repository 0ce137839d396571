/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_query.h
 * EXPERIMENTAL: checks of a map, and questions about single nodes and places that need no lists.
 *
 * Not part of connectivity.h and of its promise: until hosts have used them, these functions may
 * change or go in any version. Hosts that want them include this header; errors, handles and
 * threads are as connectivity.h says.
 */
#ifndef CONNECTIVITY_QUERY_H
#define CONNECTIVITY_QUERY_H

#include "connectivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Checks */
/**@{*/
/** Runs every check that applies to what the map holds against lists[n_lists], the nodes that it
 * was built from, or what a patch left of them: for tests, and to find out what a host did wrong.
 * *n_failed receives the number of laws that do not hold; a law that fails is a result, no error.
 * text: a line for each, "ok NAME" or "FAILED NAME: where", where is the first place. *length
 * (length may be NULL) receives its bytes without the final NUL. With text NULL only the numbers
 * are set; CONN_E_BUFFER, which sets them too, if capacity is not larger than *length. Every call
 * runs all checks again; they cost some rebuilds. CONN_E_NOT_BUILT before the first rebuild;
 * CONN_E_ARGUMENT for lists of other sizes; for bad nodes what a rebuild returns. */
CONN_API conn_status conn_map_validate(const conn_map* map, conn_nodes* const* lists,
                                       int32_t n_lists, int32_t* n_failed, char* text,
                                       int64_t capacity, int64_t* length);
/**@}*/

/** @name Queries
 * A query holds a copy of the nodes in a tree; nothing of a map. Slots are numbered as in a
 * rebuild, results ascend and ghosts count. Supports count with the largest kernel extent of all
 * lists, as in a map. mode is CONN_GATHER, CONN_SCATTER or CONN_GATHER_SCATTER. With slots NULL
 * only *count is set; CONN_E_BUFFER sets it, too. CONN_E_NOT_BUILT before the first update. */
/**@{*/
typedef struct conn_query conn_query;

/** Without nodes. */
CONN_API conn_status conn_query_create(conn_context* context, conn_query** query);
/** Ends it; *query becomes NULL. NULL is fine, and so is *query NULL. */
CONN_API conn_status conn_query_destroy(conn_query** query);
/** Takes the nodes of lists[n_lists], at least one, all of one dimension dim. Of domain only
 * periodic, box_lo, box_hi and index_base are read; NULL: open on all axes, slots from 0. Fails as
 * conn_map_rebuild does, and what was taken before then stays. */
CONN_API conn_status conn_query_update(conn_query* query, conn_nodes* const* lists, int32_t n_lists,
                                       const conn_map_options* domain);
/** Exactly the nodes that this node sees, that see it, or either, by mode; never the node itself,
 * but a node at the same place. */
CONN_API conn_status conn_query_neighbours(const conn_query* query, int32_t node_slot, int32_t mode,
                                           int32_t* slots, int64_t capacity, int64_t* count);
/** The same of a place x [dim] that is no node, with support h, or tensor [dim*(dim+1)/2], packed
 * as H of a node, if that is not NULL; h is not read then. h = 0 sees nobody. Errors: values that
 * no node could have, CONN_E_HALF_BOX. */
CONN_API conn_status conn_query_neighbours_at(const conn_query* query, const double* x, double h,
                                              const double* tensor, int32_t mode, int32_t* slots,
                                              int64_t capacity, int64_t* count);

enum {
    CONN_CANDIDATES_MASTER = 1, /**< the group of close nodes around this one, itself included */
    CONN_CANDIDATES_COARSE = 2, /**< holds all neighbours of all of MASTER, and REFINE */
    CONN_CANDIDATES_REFINE = 3  /**< holds all neighbours of this node, and itself */
};
/** Candidates for a node: which is one of CONN_CANDIDATES_*. */
CONN_API conn_status conn_query_candidates(const conn_query* query, int32_t node_slot, int32_t mode,
                                           int32_t which, int32_t* slots, int64_t capacity,
                                           int64_t* count);

/** Nodes in the closed box from lo [dim] to hi [dim] (CONN_GATHER), nodes whose support's bounding
 * box meets it (CONN_SCATTER), or either. On periodic axes images count, and the box is at most
 * half a period wide. CONN_E_ARGUMENT if lo > hi or a value is not finite. */
CONN_API conn_status conn_query_near_box(const conn_query* query, const double* lo,
                                         const double* hi, int32_t mode, int32_t* slots,
                                         int64_t capacity, int64_t* count);
/** Nodes at most distance from a plane through point [dim] with normal [dim] of any length, on both
 * sides (CONN_GATHER), nodes whose support reaches it (CONN_SCATTER), or either. Periodic images do
 * not count. CONN_E_ARGUMENT for a normal of length 0, distance < 0 and values that are not finite.
 */
CONN_API conn_status conn_query_near_plane(const conn_query* query, const double* point,
                                           const double* normal, double distance, int32_t mode,
                                           int32_t* slots, int64_t capacity, int64_t* count);
/** By how many periods the nearest image of node j is shifted on each axis, seen from node i:
 * x_j + shift * length is the place where i sees j. Whole numbers, 0 on open axes and beyond dim.
 */
CONN_API conn_status conn_query_periodic_shift(const conn_query* query, int32_t i, int32_t j,
                                               double shift[3]);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
