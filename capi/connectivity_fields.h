/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_fields.h
 * Values of pairs, their sums at the nodes, and nodes and pairs that are dropped without a rebuild.
 * See connectivity.h.
 */
#ifndef CONNECTIVITY_FIELDS_H
#define CONNECTIVITY_FIELDS_H

#include "connectivity_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Coupling: how strongly the two nodes of a pair act on each other
 * A factor in [0, 1] for each pair, which views of the pairs show. A rebuild forgets it, a patch
 * carries that of the pairs that stay. CONN_E_ARGUMENT names the first pair with a value outside
 * [0, 1]; the old values then stay. */
/**@{*/
/** values [n_pairs], in the order of the pair list; NULL and 0: back to 1 for all, without storage.
 */
CONN_API conn_status conn_map_set_coupling(conn_map* map, const double* values, int64_t n_pairs);

/** A value of a pair of slots, i before j in the order in force. Called from several threads at
 * once. What it tells conn_set_error is dropped. */
typedef double (*conn_pair_function)(void* user_data, int32_t slot_i, int32_t slot_j);
/** The coupling of every pair from a function, which is called during the call only. */
CONN_API conn_status conn_map_set_coupling_function(conn_map* map, conn_pair_function function,
                                                    void* user_data);
/**@}*/

/** @name Pair fields: float64 values of the pairs of one map
 * A field belongs to one generation: after a rebuild, or a patch it was not handed to, it is stale
 * (CONN_E_STALE) until it is reset. */
/**@{*/
typedef struct conn_pair_field conn_pair_field;

/** n_components zeros for every pair; 1 to 256. CONN_E_NOT_BUILT without pairs. */
CONN_API conn_status conn_pair_field_create(const conn_map* map, int32_t n_components,
                                            conn_pair_field** field);
/** Ends it; *field becomes NULL. NULL is fine, and so is *field NULL. */
CONN_API conn_status conn_pair_field_destroy(conn_pair_field** field);
/** Begins anew for the present pairs of a map, with zeros, in the memory it has if that suffices.
 */
CONN_API conn_status conn_pair_field_reset(conn_pair_field* field, const conn_map* map);
/** The values [n_pairs][n_components], to read and to write, in the order of the pair list. Any
 * output may be NULL. *data is valid until the field is reset, patched or destroyed; NULL if there
 * are no pairs. CONN_E_STALE if the field belongs to another map or an older generation. */
CONN_API conn_status conn_pair_field_data(conn_pair_field* field, const conn_map* map,
                                          double** data, int64_t* n_pairs, int32_t* n_components);

enum { /* What a pair with the values v adds to its first and to its second node. */
       CONN_ANTISYMMETRIC = 1, /**< v and -v, as forces do */
       CONN_SYMMETRIC = 2,     /**< v and v */
       CONN_TWO_SIDED = 3      /**< the first half of v, and the second */
};
enum {
    CONN_SUM_DETERMINISTIC = 0, /**< along rows: same bits for any number of threads. Needs rows;
                                   the map keeps 4 bytes a row entry for it. Only stored, active
                                   nodes get a sum, the others 0 */
    CONN_SUM_ATOMIC = 1         /**< over pairs: bits may differ from run to run; nodes without rows
                                     get the sum over the pairs there are */
};
/** out [n_slots][n]: at every node the sum of what its pairs add, n being the components of the
 * field, or half of them for CONN_TWO_SIDED. What was in out is overwritten. CONN_E_BUFFER if
 * capacity, the values out has room for, is less than n_slots * n. CONN_E_STALE as
 * conn_pair_field_data. */
CONN_API conn_status conn_pair_field_sum(const conn_pair_field* field, conn_map* map,
                                         int32_t symmetry, int32_t how, double* out,
                                         int64_t capacity);
/**@}*/

/** @name Patch: the lists without some nodes or pairs, without a search
 * The generation goes on. Coupling and fields[n_fields], which must be current, keep the values of
 * the pairs that stay; other fields go stale. n_fields at most 65536; NULL with 0. */
/**@{*/
/** Drops and renumbers nodes, as after culling ghosts: every list becomes what a rebuild on the
 * nodes that stay would give; but overlap does not forget what dropped nodes witnessed, and key
 * order keeps its keys. keep [n_slots]: 0 or 1. old2new [n_slots]: the new node id within the list,
 * in each list a permutation of the nodes that stay with internal ones first; not read where keep
 * is 0. CONN_E_ARGUMENT names list, node and value. With a skin conn_map_needs_rebuild then says 1.
 */
CONN_API conn_status conn_map_patch(conn_map* map, const int32_t* keep, const int32_t* old2new,
                                    int64_t n_slots, conn_pair_field* const* fields,
                                    int32_t n_fields);
/** Leaves pairs out of rows and pairs now, as conn_map_set_exclusion does in rebuilds; predicate
 * is called during the call only. CONN_E_ARGUMENT if overlap or intersections were built. */
CONN_API conn_status conn_map_remove_pairs(conn_map* map, conn_pair_predicate predicate,
                                           void* user_data, conn_pair_field* const* fields,
                                           int32_t n_fields);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
