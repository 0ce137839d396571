/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_boundary.h
 * EXPERIMENTAL: ghosts behind reflecting and periodic planes, made, placed and culled by the
 * library.
 *
 * Not part of connectivity.h and of its promise: until hosts have used them, these functions may
 * change or go in any version. Hosts that want them include this header; errors, handles and
 * threads are as connectivity.h says.
 */
#ifndef CONNECTIVITY_BOUNDARY_H
#define CONNECTIVITY_BOUNDARY_H

#include "connectivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Boundaries
 * They keep copies of the host's node lists and ghosts behind them, a contiguous tail of each list.
 * In a step a host calls conn_boundaries_update, then conn_boundaries_fill_ghosts for its own
 * fields; slots of the map are then those of the nodes that conn_boundaries_get_nodes shows. */
/**@{*/
typedef struct conn_boundaries conn_boundaries;

/** Without boundaries. dim: 1, 2 or 3. */
CONN_API conn_status conn_boundaries_create(conn_context* context, int32_t dim,
                                            conn_boundaries** boundaries);
/** Ends them; *boundaries becomes NULL. The map keeps its lists. NULL is fine, and so is
 * *boundaries NULL. */
CONN_API conn_status conn_boundaries_destroy(conn_boundaries** boundaries);

enum {
    CONN_BOUNDARY_REFLECTING = 1, /**< one plane; ghosts are mirror images */
    CONN_BOUNDARY_PERIODIC = 2    /**< two planes that face each other; nodes close to one are
                                       copied to beyond the other */
};
/** Takes effect with the next update. planes: of each plane a point [dim] and a normal [dim] of any
 * length, pointing into the domain; so 2*dim or 4*dim numbers. The order counts: later boundaries
 * make ghosts of the ghosts of earlier ones; corners are complete where planes meet at right
 * angles. may_cull 0: no ghost of this boundary is ever culled. name: 1 to 255 bytes.
 * CONN_E_ARGUMENT for values that are not finite, a normal of length 0, periodic planes that do not
 * face each other, and a plane parallel to an earlier one that faces the same way, or faces it from
 * outside. */
CONN_API conn_status conn_boundaries_add(conn_boundaries* boundaries, int32_t kind,
                                         const char* name, const double* planes, int32_t may_cull);

enum {
    CONN_GHOSTS_KEEP = 0,      /**< new ghosts, none culled */
    CONN_GHOSTS_CULL = 1,      /**< new ghosts; those go that no internal row names, but for the
                                    ones that other ghosts were made of */
    CONN_GHOSTS_CULL_MOST = 2, /**< as before; of those that others were made of only the ones stay
                                    whose ghosts stay */
    CONN_GHOSTS_REFRESH = 3    /**< the ghosts there are, placed anew: nodes moved or their supports
                                    changed, and the lists of the map are to stay */
};
/** Takes the internal nodes of lists[n_lists] (ghosts in them are ignored), makes ghosts wherever a
 * support reaches across a boundary, with overlap two supports deep, and rebuilds the map with its
 * options from all of them. Nothing is culled where rows of ghosts are stored, or the map has a
 * skin, or neither rows nor pairs. With CONN_GHOSTS_REFRESH map is NULL, and the number of lists,
 * their internal nodes and kind of support must be those of the last update. Fails as
 * conn_map_rebuild does; with CONN_E_ARGUMENT for another dimension, a node outside the domain, or
 * the option active, which cannot know the ghosts; with CONN_E_HALF_BOX for a support that reaches
 * from plane to facing plane. Ghosts and map are then as before; only if culling alone lacks
 * memory (CONN_E_MEMORY) they are those of this call, none culled. */
CONN_API conn_status conn_boundaries_update(conn_boundaries* boundaries, conn_map* map,
                                            conn_nodes* const* lists, int32_t n_lists, int32_t how);

typedef struct conn_boundary_nodes {
    size_t struct_size;
    int64_t n;                /**< nodes, ghosts included */
    int64_t n_internal;       /**< nodes before the first ghost */
    const double* x;          /**< [n][dim] */
    const double* h;          /**< [n], NULL for tensors */
    const double* H;          /**< [n][dim*(dim+1)/2], NULL for scalars */
    const int32_t* owner;     /**< [n - n_internal] the internal node, counted from 0, that each
                                   ghost is finally an image of; NULL without ghosts */
    const int64_t* global_id; /**< [n] ghosts have that of their owner; NULL if none were set */
} conn_boundary_nodes;
#define CONN_BOUNDARY_NODES_INIT \
    { sizeof(conn_boundary_nodes), 0, 0, NULL, NULL, NULL, NULL, NULL }
/** The nodes of a list of the last update. The arrays are the library's, valid until the next
 * update or the end of the boundaries. */
CONN_API conn_status conn_boundaries_get_nodes(const conn_boundaries* boundaries, int32_t list,
                                               conn_boundary_nodes* nodes);

enum {                        /* How a value behaves under a mirror. */
       CONN_FIELD_SCALAR = 0, /**< copied, any number of components */
       CONN_FIELD_VECTOR = 1, /**< dim components */
       CONN_FIELD_TENSOR = 2  /**< dim*(dim+1)/2 components, packed as H */
};
/** Writes the ghosts' part of a field of the host, values [n][n_components], from its internal
 * part; n must be all nodes of the list. */
CONN_API conn_status conn_boundaries_fill_ghosts(const conn_boundaries* boundaries, int32_t list,
                                                 int32_t kind, double* values, int64_t n,
                                                 int32_t n_components);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
