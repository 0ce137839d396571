/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_map.h
 * The map: who interacts with whom. Options, rebuilds, sizes and orders. See connectivity.h.
 */
#ifndef CONNECTIVITY_MAP_H
#define CONNECTIVITY_MAP_H

#include "connectivity_nodes.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Map: who interacts with whom */
/**@{*/
typedef struct conn_map conn_map;

enum {
    CONN_GATHER = 1,        /**< i sees j */
    CONN_SCATTER = 2,       /**< j sees i */
    CONN_GATHER_SCATTER = 3 /**< either; the only mode that has pairs */
};
enum { /* All methods give the same lists. */
       CONN_METHOD_AUTOMATIC = 0,
       CONN_METHOD_BRUTE = 1,
       CONN_METHOD_CELLS = 2,
       CONN_METHOD_GROUPS = 3,
       CONN_METHOD_DEVICE = 4 /**< kernels of the library's Kokkos: on a GPU where it has one */
};
enum {
    CONN_INTERSECTION_NONE = 0,
    CONN_INTERSECTION_ALL = 1,       /**< all common neighbours of a pair */
    CONN_INTERSECTION_IN_SEGMENT = 2 /**< those whose perpendicular foot on the line between the
                                          two nodes lies between them */
};
enum {                      /* The order of rows, pairs and traversals. */
       CONN_ORDER_SLOT = 0, /**< ascending (list, node) */
       CONN_ORDER_KEY = 1   /**< ascending (Morton key, position, list, global id or else node):
                                 does not depend on how nodes are stored, nor on which are ghosts */
};

typedef struct conn_map_options {
    size_t struct_size;    /**< sizeof(conn_map_options) of the host */
    int32_t rows;          /**< 1: build neighbour rows */
    int32_t pairs;         /**< 1: build the pair list */
    int32_t ghost_rows;    /**< 1: rows for ghosts too, and pairs between ghosts */
    int32_t spatial_order; /**< 1: keep the order that puts neighbours close in memory */
    int32_t mode;          /**< CONN_GATHER_SCATTER, ... */
    int32_t method;        /**< CONN_METHOD_AUTOMATIC, ... */
    int32_t periodic[3];   /**< 1: this axis is periodic, from box_lo to box_hi */
    int32_t reserved;      /**< 0 */
    double box_lo[3], box_hi[3];
    int64_t budget_bytes;  /**< memory that a rebuild may take; 0: the context's budget */
    double skin;           /**< length by which supports are widened, see conn_map_needs_rebuild;
                                0: not at all, or in [1e-100, 1e100] */
    int32_t overlap;       /**< 1: build the rows of conn_map_overlap_acquire */
    int32_t intersection;  /**< CONN_INTERSECTION_NONE, ...; others than that build pairs, too */
    int32_t order;         /**< CONN_ORDER_SLOT, ...; overlap, intersection and CONN_ORDER_KEY need
                                and store rows of ghosts */
    int32_t reserved_2;    /**< 0 */
    const uint8_t* active; /**< [n_active], 0 or 1 by slot: only active nodes have neighbours
                                in their rows, and every pair has an active node. Rows keep
                                their numbers. NULL: all are active */
    int64_t n_active;      /**< nodes of all lists of the rebuild, also where these are 0; 0
                                  with NULL */
    const uint8_t* interactions; /**< [n_lists][n_lists] symmetric, 0 or 1: which lists see each
                                      other. NULL: all do */
    int64_t n_interactions;      /**< n_lists * n_lists of the rebuild; 0 with NULL */
    int32_t index_base;          /**< 0 or 1, the number of the first node: nodes and slots that go
                                      in or out count from it, and a slot is list_offset[list] +
                                      node. Positions count from 0: offsets, ranks, rows, pairs,
                                      lists; numbers in texts, too, and owners of ghosts, which
                                      belong to lists of nodes and not to a map. With 1, views are
                                      copies that the map keeps. Chosen by conn_map_create for
                                      good */
    int32_t reserved_3;          /**< 0 */
} conn_map_options;
#define CONN_MAP_OPTIONS_INIT                                                             \
    {                                                                                     \
        sizeof(conn_map_options), 1, 1, 0, 0, CONN_GATHER_SCATTER, CONN_METHOD_AUTOMATIC, \
            {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, 0, 0, 0, NULL, 0, NULL, 0, 0, 0  \
    }

/** Sets the defaults; size is sizeof *options. */
CONN_API conn_status conn_map_options_init(conn_map_options* options, size_t size);
/** An empty map. options NULL means the defaults. */
CONN_API conn_status conn_map_create(conn_context* context, const conn_map_options* options,
                                     conn_map** map);
/** Ends it; *map becomes NULL. Views of it stay valid until they are released. NULL is fine, and so
 * is *map NULL. */
CONN_API conn_status conn_map_destroy(conn_map** map);
/** Options of the next rebuilds; the present lists stay. The arrays active and interactions are
 * copied here: a host with other active nodes in every step sets its options in every step.
 * NULL: the defaults. CONN_E_ARGUMENT for active together with overlap or intersection, which need
 * all nodes, for these and pairs with another mode than CONN_GATHER_SCATTER, and for another
 * index_base than the map's. */
CONN_API conn_status conn_map_set_options(conn_map* map, const conn_map_options* options);
/** Whether a pair of slots, slot_i < slot_j, is left out: 0 keeps it. Called from several threads
 * at once and more than once for a pair: the answer must depend on the two slots alone. What it
 * tells conn_set_error is dropped. */
typedef int32_t (*conn_pair_predicate)(void* user_data, int32_t slot_i, int32_t slot_j);
/** Pairs that the next rebuilds leave out of everything; predicate NULL: none. Predicate and
 * user_data are kept until others are set, conn_map_set_options does not change them. */
CONN_API conn_status conn_map_set_exclusion(conn_map* map, conn_pair_predicate predicate,
                                            void* user_data);
/** Finds all neighbours anew: lists[n_lists], at least one, all of one dimension. Slot of node a of
 * list k: list_offset[k] + a, where list_offset counts the nodes of the lists before it. On any
 * error the lists of the last rebuild stay as they are. CONN_E_BUDGET names the bytes needed and
 * allowed. */
CONN_API conn_status conn_map_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists);
typedef struct conn_estimate {
    size_t struct_size;
    int64_t n_entries;  /**< neighbours in all rows; 0 if rows were not asked for */
    int64_t n_pairs;    /**< 0 if pairs were not asked for */
    int64_t bytes;      /**< of rows, pairs and orders, in a map without spare memory; overlap and
                             intersections are not in it */
    int64_t peak_bytes; /**< at least what conn_map_memory says of a new map after its first rebuild,
                             at most twice it where lists are most of it: bytes and three standard
                             errors more, nodes, order, 16 bytes a node, 4 MiB a thread, every found
                             row in memory that may be half empty, and lists from which others are
                             made, with all pairs that are then left out. Of a search on a device
                             only what the host holds */
    int64_t n_sampled;  /**< nodes whose neighbours were counted */
    double relative_error; /**< standard error of n_entries and n_pairs over their values; 0: they
                                are exact */
    int32_t is_lower_bound; /**< 1: overlap or intersections are asked for; they, and what they are
                                 made from, are in neither number of bytes: finding their sizes
                                 would take as long as making them */
    int32_t reserved;       /**< 0 */
} conn_estimate;
#define CONN_ESTIMATE_INIT \
    { sizeof(conn_estimate), 0, 0, 0, 0, 0, 0, 0, 0 }
/** What a rebuild with these lists would make, while nothing is stored and the map stays as it is.
 * Exact up to 20000 nodes with a row; beyond from a sample of about 4096, always the same ones.
 * Most of its time goes into an order of all nodes: about a third of that of a first rebuild. Fails
 * as conn_map_rebuild does, but for the budget, which does not count here. */
CONN_API conn_status conn_map_estimate(const conn_map* map, conn_nodes* const* lists,
                                       int32_t n_lists, conn_estimate* estimate);
/** Whether the lists of the last rebuild may miss a neighbour among these nodes, which may have
 * moved and changed their supports since. *needed is 0 while the drift, twice the largest
 * displacement plus the largest growth of a support radius, is at most the skin of that rebuild;
 * the host then goes on with the lists it has. A rebuild with a skin widens all supports by it:
 * rows and pairs hold every neighbour and some nodes close to it, which the kernel or a test of the
 * distance sorts out. *needed is 1 without a rebuild or a skin, after other options were set, if
 * the number of lists, their sizes, internal nodes, extents or kind of support changed, or if a
 * value is bad, which the rebuild then names. *drift (drift may be NULL) is infinite where it
 * cannot be told. The report counts rebuilds, reuses and, in millionths of the skin, the largest
 * drift reused under. */
CONN_API conn_status conn_map_needs_rebuild(conn_map* map, conn_nodes* const* lists,
                                            int32_t n_lists, int32_t* needed, double* drift);
/** Number of successful rebuilds and patches: 0 before the first. */
CONN_API conn_status conn_map_generation(const conn_map* map, uint64_t* generation);

typedef struct conn_map_info {
    size_t struct_size;
    uint64_t generation;
    int64_t n_slots;   /**< nodes of all lists */
    int64_t n_rows;    /**< stored nodes: internal ones, or all if ghosts have rows */
    int64_t n_entries; /**< neighbours in all rows; 0 if rows were not asked for */
    int64_t n_pairs;   /**< 0 if pairs were not asked for */
    int64_t bytes;     /**< held by the map, as conn_map_memory says, but for old views */
    int32_t dim, n_lists, n_report_entries, n_report_counters;
} conn_map_info;
#define CONN_MAP_INFO_INIT \
    { sizeof(conn_map_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
/** What the last rebuild or patch left. */
CONN_API conn_status conn_map_get_info(const conn_map* map, conn_map_info* info);
/** *bytes: what the map holds in a space now: lists, spare memory for the next rebuild, copies for
 * views and sums, and lists of older generations that acquired views still pin. *high_water: the
 * most of it that any call on the map has left behind since the map was made; it never goes back.
 * What a call holds only in passing is not in it, see conn_map_estimate; nor are pair fields and
 * boundaries. Either output may be NULL. CONN_E_UNSUPPORTED for a space this build does not use. */
CONN_API conn_status conn_map_memory(const conn_map* map, int32_t space, int64_t* bytes,
                                     int64_t* high_water);

/** list_offset [n_lists + 1]: first slot of each list. row_offset [n_lists + 1]: first row of each
 * list; node a of list k has row row_offset[k] + a. capacity is the length of both arrays, of which
 * either may be NULL; *count receives n_lists + 1, also with CONN_E_BUFFER. */
CONN_API conn_status conn_map_offsets(const conn_map* map, int64_t* list_offset,
                                      int64_t* row_offset, int64_t capacity, int64_t* count);
/** Nodes of a list in an order that keeps neighbours close in memory, internal ones first: nodes
 * [n of the list], a permutation, as conn_reorder takes it. With nodes NULL only *count is set;
 * CONN_E_BUFFER sets it, too. CONN_E_NOT_BUILT without the option spatial_order. */
CONN_API conn_status conn_map_spatial_order(const conn_map* map, int32_t list, int32_t* nodes,
                                            int64_t capacity, int64_t* count);
/** The order of CONN_ORDER_KEY, each array [n_slots] or NULL: slots by rank, ranks by position of
 * the slot, Morton keys by rank. *count receives n_slots, also with CONN_E_BUFFER. CONN_E_NOT_BUILT
 * in slot order.
 */
CONN_API conn_status conn_map_key_order(const conn_map* map, int32_t* slots, int32_t* ranks,
                                        uint64_t* keys, int64_t capacity, int64_t* count);
/** The nodes of a list in the order in which to walk through them: internal nodes ascending, in key
 * order all nodes of the list by rank. With nodes NULL only *count is set; CONN_E_BUFFER sets it,
 * too. */
CONN_API conn_status conn_map_traversal(const conn_map* map, int32_t list, int32_t* nodes,
                                        int64_t capacity, int64_t* count);
/** Puts a field of the host in another order: node k of out becomes node order[k] of in. order [n],
 * n being in->extent[0], is a permutation that counts from index_base, 0 or 1. in: 1 or 2
 * dimensions, any dtype, strides as they are but no 0, no element twice, and nodes not mixed with
 * components. out: the address of component 0 of node 0, the rest laid out as in. out may be
 * in->data: the field is then copied first. Otherwise the two must not overlap; nor out and order.
 * CONN_E_ARGUMENT names what is wrong, and out is then untouched. */
CONN_API conn_status conn_reorder(const conn_array* in, const int32_t* order, int64_t n,
                                  int32_t index_base, void* out);
/**@}*/

/** @name Any two nodes
 * Questions about slots a and b that need not be a pair. Both need rows, of a and of b:
 * CONN_E_ARGUMENT for a ghost without, or a node that is not active. Slots ascend. With slots NULL
 * only *count is set; CONN_E_BUFFER sets it, too. */
/**@{*/
/** Common neighbours of a and b, and both themselves. With lists[n_lists], those of the last
 * rebuild, only the ones between the two, as CONN_INTERSECTION_IN_SEGMENT; NULL and 0: all. */
CONN_API conn_status conn_map_common_neighbours(const conn_map* map, int32_t a, int32_t b,
                                                conn_nodes* const* lists, int32_t n_lists,
                                                int32_t* slots, int64_t capacity, int64_t* count);
/** Neighbours of a or b. */
CONN_API conn_status conn_map_all_neighbours(const conn_map* map, int32_t a, int32_t b,
                                             int32_t* slots, int64_t capacity, int64_t* count);
/** pair [n]: the number of the pair {i[k], j[k]}, in either orientation; -1 where the two are no
 * pair of the list, or no slots. A binary search each. CONN_E_NOT_BUILT without pairs. */
CONN_API conn_status conn_map_find_pairs(const conn_map* map, int64_t n, const int32_t* i,
                                         const int32_t* j, int64_t* pair);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
