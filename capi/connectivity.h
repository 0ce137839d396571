/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity.h
 * Who interacts with whom: neighbour rows and the list of interacting pairs of particles.
 * C99 and later, C++; this header carries the ABI promise (none while the version is 0.x).
 *
 * Errors. Functions return a conn_status: 0 is success; positive means arguments, state or memory,
 * and the object is as it was before the call; negative means a defect in the library.
 * conn_last_error() says what, where, which value and what is allowed. Nothing here ever aborts,
 * exits or prints. Outputs are written on success only, except where a needed size is returned.
 *
 * Handles. Created through an out-parameter, destroyed through a pointer to the handle, which
 * becomes NULL; NULL is accepted and does nothing. A context may be destroyed before what was
 * created with it. Destroying and releasing work at any time, also after conn_shutdown().
 *
 * Threads. Different handles may be used from different threads at once, one handle only from one
 * thread at a time; calls wait for each other inside. The last error belongs to the calling thread.
 *
 * Kokkos. The first conn_context_create() starts it (MPI hosts: after MPI_Init) and nothing stops
 * it but conn_shutdown() or the host, if the host shares it. Then all arrays of acquired views are
 * gone, and calls return CONN_E_FINALIZED. After a fork the child gets CONN_E_FORKED if the
 * library had more than one thread. All arrays are in host memory in this version.
 */
#ifndef CONNECTIVITY_H
#define CONNECTIVITY_H

#include <stddef.h>
#include <stdint.h>

#include <connectivity/base/status.h>

#if defined(__GNUC__)
#define CONN_API __attribute__((visibility("default")))
#else
#define CONN_API
#endif

#define CONN_VERSION_MAJOR 0
#define CONN_VERSION_MINOR 1
#define CONN_VERSION_PATCH 0
#define CONN_VERSION_STRING "0.1.0"
/** Version as one number: major * 10000 + minor * 100 + patch. */
#define CONN_VERSION (CONN_VERSION_MAJOR * 10000 + CONN_VERSION_MINOR * 100 + CONN_VERSION_PATCH)
#define CONN_VERSION_GE(major, minor, patch) (CONN_VERSION >= (major)*10000 + (minor)*100 + (patch))

#ifdef __cplusplus
extern "C" {
#endif

/** @name Status */
/**@{*/
typedef int32_t conn_status;
enum {
#define CONN_STATUS_C_ENUMERATOR(NAME, name, value, text) CONN_##NAME = (value),
    CONN_STATUS_LIST(CONN_STATUS_C_ENUMERATOR)
#undef CONN_STATUS_C_ENUMERATOR
};

/** Static text of a status; "unknown status" for a number that is none. */
CONN_API const char* conn_status_text(conn_status status);
/** What went wrong in the last call on this thread; "" after a success. Valid until the next call
 * on this thread. Never NULL. */
CONN_API const char* conn_last_error(void);
/** For callbacks that stop a call: says why. The text becomes the last error of this thread and
 * part of that of the stopped call. At most 2047 bytes are kept; NULL means "". */
CONN_API void conn_set_error(const char* text);
/**@}*/

/** @name Library */
/**@{*/
/** CONN_VERSION of the library that is loaded. */
CONN_API int32_t conn_version(void);
/** CONN_VERSION_STRING of the library that is loaded. */
CONN_API const char* conn_version_string(void);
/** How the library was built: a JSON object, static text. */
CONN_API const char* conn_build_info(void);
/** Optional. Stops Kokkos if the library started it, and frees all memory of handles and views. It
 * cannot be started again in this process: later calls return CONN_E_FINALIZED. */
CONN_API conn_status conn_shutdown(void);

enum {
    CONN_STRUCT_ARRAY = 1,
    CONN_STRUCT_CONTEXT_OPTIONS = 2,
    CONN_STRUCT_MAP_OPTIONS = 3,
    CONN_STRUCT_MAP_INFO = 4,
    CONN_STRUCT_ROWS_VIEW = 5,
    CONN_STRUCT_PAIRS_VIEW = 6,
    CONN_STRUCT_REPORT_ENTRY = 7
};
/** sizeof of a struct in the library that is loaded, for hosts that mirror the structs in another
 * language; 0 if there is no such struct. */
CONN_API int64_t conn_abi_sizeof(int32_t which);
/**@}*/

/** @name Arrays of the host
 * Read during the call only; nothing of the host is kept. Component c of node i is
 * data[i*stride[0] + c*stride[1]], strides counted in elements, of any sign; 0 repeats one value.
 * x(3,n) of Fortran or a C array of structs: extent {n, 3}, stride {3, 1}; x(n,3): extent {n, 3},
 * stride {1, n}. data may be NULL if extent[0] is 0. With ndim 1 the second entries are not read.
 */
/**@{*/
enum { /* Where memory is. This version reads the first two. */
       CONN_SPACE_HOST = 0,
       CONN_SPACE_HOST_PINNED = 1,
       CONN_SPACE_DEVICE = 2,
       CONN_SPACE_MANAGED = 3
};
enum { CONN_FLOAT64 = 0, CONN_FLOAT32 = 1 };

typedef struct conn_array {
    const void* data;
    int32_t space;     /**< CONN_SPACE_HOST, ... */
    int32_t device_id; /**< of CONN_SPACE_DEVICE */
    int32_t dtype;     /**< CONN_FLOAT64, CONN_FLOAT32 */
    int32_t ndim;      /**< 1 or 2 */
    int64_t extent[2]; /**< nodes, components */
    int64_t stride[2]; /**< elements from node to node, from component to component */
} conn_array;

/** n values one after the other. */
static inline conn_array conn_array_vector(const double* data, int64_t n) {
    conn_array a = {data, CONN_SPACE_HOST, 0, CONN_FLOAT64, 1, {n, 1}, {1, 1}};
    return a;
}
/** n nodes one after the other, the components of a node together: x[n][n_components]. */
static inline conn_array conn_array_matrix(const double* data, int64_t n, int64_t n_components) {
    conn_array a = {
        data, CONN_SPACE_HOST, 0, CONN_FLOAT64, 2, {n, n_components}, {n_components, 1}};
    return a;
}
/**@}*/

/** @name Context: threads, device, memory */
/**@{*/
typedef struct conn_context conn_context;

typedef struct conn_context_options {
    size_t struct_size;   /**< sizeof(conn_context_options) of the host */
    int32_t n_threads;    /**< 0: OMP_NUM_THREADS or all cores; at most 512 */
    int32_t device_id;    /**< -1: automatic */
    int64_t budget_bytes; /**< memory that a rebuild may take; 0: 80 % of what is free then */
} conn_context_options;
#define CONN_CONTEXT_OPTIONS_INIT \
    { sizeof(conn_context_options), 0, -1, 0 }

/** Sets the defaults; size is sizeof *options. For languages without the macro. */
CONN_API conn_status conn_context_options_init(conn_context_options* options, size_t size);
/** Starts the library if need be. options NULL means the defaults. Threads and device are those of
 * the process, chosen by its first context: CONN_E_UNSUPPORTED if a later one asks for others. */
CONN_API conn_status conn_context_create(const conn_context_options* options,
                                         conn_context** context);
CONN_API conn_status conn_context_destroy(conn_context** context);
/** Number of host threads in use, and of workers in conn_map_traverse. */
CONN_API conn_status conn_context_threads(const conn_context* context, int32_t* n_threads);
/**@}*/

/** @name Node lists: named sets of nodes, internal ones first, then ghosts */
/**@{*/
typedef struct conn_nodes conn_nodes;

/** A list without nodes. name: 1 to 255 bytes. dim: 1, 2 or 3. kernel_extent in [1e-100, 1e100]:
 * the eta at which the kernel ends; the support radius is kernel_extent * h. */
CONN_API conn_status conn_nodes_create(conn_context* context, const char* name, int32_t dim,
                                       double kernel_extent, conn_nodes** nodes);
CONN_API conn_status conn_nodes_destroy(conn_nodes** nodes);
/** Copies positions [n, dim] and smoothing lengths h [n] >= 0 (same length unit). positions is one
 * array (n_positions = 1) or one array [n] for each axis (n_positions = dim). The first n_internal
 * nodes are internal. Values are checked by conn_map_rebuild, which names the first bad node. */
CONN_API conn_status conn_nodes_set_h(conn_nodes* nodes, int64_t n_internal,
                                      const conn_array* positions, int32_t n_positions,
                                      const conn_array* h);
/** The same with tensors H [n, dim*(dim+1)/2], 1/length, packed xx,xy,xz,yy,yz,zz (xx,xy,yy in 2D),
 * as one array (n_tensor = 1) or one array [n] for each component. Support: |H r| <= kernel_extent.
 */
CONN_API conn_status conn_nodes_set_tensor(conn_nodes* nodes, int64_t n_internal,
                                           const conn_array* positions, int32_t n_positions,
                                           const conn_array* tensor, int32_t n_tensor);
/** Nodes in the list, and how many are internal. Either output may be NULL. */
CONN_API conn_status conn_nodes_size(const conn_nodes* nodes, int64_t* n, int64_t* n_internal);
/**@}*/

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
    int64_t budget_bytes; /**< memory that a rebuild may take; 0: the context's budget */
    double skin;          /**< length by which supports are widened, see conn_map_needs_rebuild;
                               0: not at all, or in [1e-100, 1e100] */
} conn_map_options;
#define CONN_MAP_OPTIONS_INIT                                                             \
    {                                                                                     \
        sizeof(conn_map_options), 1, 1, 0, 0, CONN_GATHER_SCATTER, CONN_METHOD_AUTOMATIC, \
            {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}, 0, 0                                      \
    }

/** Sets the defaults; size is sizeof *options. */
CONN_API conn_status conn_map_options_init(conn_map_options* options, size_t size);
/** An empty map. options NULL means the defaults. */
CONN_API conn_status conn_map_create(conn_context* context, const conn_map_options* options,
                                     conn_map** map);
CONN_API conn_status conn_map_destroy(conn_map** map);
/** Options of the next rebuild; the present lists stay. */
CONN_API conn_status conn_map_set_options(conn_map* map, const conn_map_options* options);
/** Finds all neighbours anew: lists[n_lists], at least one, all of one dimension. Slot of node a of
 * list k: list_offset[k] + a, where list_offset counts the nodes of the lists before it. On any
 * error the lists of the last rebuild stay as they are. CONN_E_BUDGET names the bytes needed and
 * allowed. */
CONN_API conn_status conn_map_rebuild(conn_map* map, conn_nodes* const* lists, int32_t n_lists);
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
/** Number of successful rebuilds: 0 before the first. */
CONN_API conn_status conn_map_generation(const conn_map* map, uint64_t* generation);

typedef struct conn_map_info {
    size_t struct_size;
    uint64_t generation;
    int64_t n_slots;   /**< nodes of all lists */
    int64_t n_rows;    /**< stored nodes: internal ones, or all if ghost_rows */
    int64_t n_entries; /**< neighbours in all rows; 0 if rows were not asked for */
    int64_t n_pairs;   /**< 0 if pairs were not asked for */
    int64_t bytes;     /**< held by the map's products */
    int32_t dim, n_lists, n_report_entries, n_report_counters;
} conn_map_info;
#define CONN_MAP_INFO_INIT \
    { sizeof(conn_map_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
CONN_API conn_status conn_map_get_info(const conn_map* map, conn_map_info* info);

/** list_offset [n_lists + 1]: first slot of each list. row_offset [n_lists + 1]: first row of each
 * list; node a of list k has row row_offset[k] + a. capacity is the length of both arrays, of which
 * either may be NULL; *count receives n_lists + 1, also with CONN_E_BUFFER. */
CONN_API conn_status conn_map_offsets(const conn_map* map, int64_t* list_offset,
                                      int64_t* row_offset, int64_t capacity, int64_t* count);
/** Nodes of a list in an order that keeps neighbours close in memory, internal ones first: nodes
 * [n of the list], a permutation. With nodes NULL only *count is set; CONN_E_BUFFER sets it, too.
 */
CONN_API conn_status conn_map_spatial_order(const conn_map* map, int32_t list, int32_t* nodes,
                                            int64_t capacity, int64_t* count);
/**@}*/

/** @name Views: the lists themselves, without a copy
 * A view is pinned: its arrays stay valid and unchanged until it is released, through rebuilds and
 * the end of the map. A rebuild while a view is held takes new memory; release first to reuse it. A
 * view is current while its generation is that of the map. Arrays of length 0 may be NULL. */
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
    const int32_t* slots;       /**< [n_entries] ascending within a row; never the node itself */
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
    const int64_t* offsets;     /**< [n_slots + 1]; the pairs whose first slot is i are
                                     [offsets[i] .. offsets[i+1]) */
    const int32_t* i;           /**< [n_pairs], or NULL unless CONN_PAIRS_EXPAND was asked for */
    const int32_t* j;           /**< [n_pairs], i < j, pairs sorted by (i, j) */
    const double* coupling;     /**< NULL: 1 for all pairs */
    const int64_t* list_offset; /**< [n_lists + 1] */
    void* owner;                /**< private */
} conn_pairs_view;
#define CONN_PAIRS_VIEW_INIT \
    { sizeof(conn_pairs_view), 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL }

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
CONN_API conn_status conn_map_pairs_release(conn_pairs_view* view);
/**@}*/

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
 * needs no lock. A result other than 0 stops the traversal. The callback must not throw, jump out,
 * or fork; nor call this library but for conn_set_error, conn_last_error, texts and versions
 * (CONN_E_CALLBACK); nor wait for a thread that does. */
typedef int32_t (*conn_rows_callback)(void* user_data, int32_t worker, int64_t n_rows,
                                      const int32_t* slots, const int64_t* offsets,
                                      const int32_t* neighbours);

/** Finds all neighbours of lists[n_lists] with the map's options, as conn_map_rebuild does, and
 * hands them to the callback instead of storing them: what is CONN_ROWS or CONN_PAIRS, with the
 * content that rows and pairs of a rebuild would have. The callback is called from several threads
 * at once, with blocks of at most 4096 neighbours or one longer row; each stored node (CONN_ROWS)
 * or each slot (CONN_PAIRS) comes in exactly one block, also without neighbours, in any order. The
 * options rows, pairs, spatial_order and budget_bytes do not count. Slots are numbered as in a
 * rebuild. The map's lists, views and generation stay as they are; its report gains an entry
 * "traversal".
 * CONN_E_CALLBACK if the callback returned other than 0: the last error then has that number and
 * the text of conn_set_error, and no block was begun afterwards but on other threads at that
 * moment. CONN_E_ARGUMENT for CONN_PAIRS with another mode than CONN_GATHER_SCATTER. */
CONN_API conn_status conn_map_traverse(conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                                       int32_t what, conn_rows_callback callback, void* user_data);
/**@}*/

/** @name Report: what the last rebuild made, who asked for it, what it cost
 * Texts belong to the map: they are valid until its next rebuild or traversal, or
 * its end. */
/**@{*/
typedef struct conn_report_entry {
    size_t struct_size;
    const char* product;  /**< "rows", "pairs", ... */
    const char* asked_by; /**< "" if nobody */
    const char* reason;   /**< why it was built the way it was */
    int64_t bytes;        /**< held now */
    double ms;            /**< of the last build */
    int32_t built, reused;
} conn_report_entry;
#define CONN_REPORT_ENTRY_INIT \
    { sizeof(conn_report_entry), NULL, NULL, NULL, 0, 0, 0, 0 }

/** Entry index of [0, n_report_entries). */
CONN_API conn_status conn_map_report_entry(const conn_map* map, int32_t index,
                                           conn_report_entry* entry);
/** Counter index of [0, n_report_counters). Either output may be NULL. */
CONN_API conn_status conn_map_report_counter(const conn_map* map, int32_t index, const char** name,
                                             int64_t* value);
/** The report as a table for people. *length receives the bytes without the final NUL. With buffer
 * NULL only that; CONN_E_BUFFER if capacity is not larger than it. */
CONN_API conn_status conn_map_report_text(const conn_map* map, char* buffer, int64_t capacity,
                                          int64_t* length);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
