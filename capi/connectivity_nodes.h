/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_nodes.h
 * Context and node lists: where work runs, and the nodes that are searched. See connectivity.h.
 */
#ifndef CONNECTIVITY_NODES_H
#define CONNECTIVITY_NODES_H

#include "connectivity_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Context: threads, device, memory */
/**@{*/
typedef struct conn_context conn_context;

typedef struct conn_context_options {
    size_t struct_size;   /**< sizeof(conn_context_options) of the host */
    int32_t n_threads;    /**< 0: OMP_NUM_THREADS or all cores; at most 512 */
    int32_t device_id;    /**< -1: automatic */
    int64_t budget_bytes; /**< memory that a rebuild may take; 0: 80 % of what is free then */
    void* stream;         /**< of the device, to run kernels in; NULL: the library's own. Others are
                               CONN_E_UNSUPPORTED in this version */
} conn_context_options;
#define CONN_CONTEXT_OPTIONS_INIT \
    { sizeof(conn_context_options), 0, -1, 0, NULL }

/** Sets the defaults; size is sizeof *options. For languages without the macro. */
CONN_API conn_status conn_context_options_init(conn_context_options* options, size_t size);
/** Starts the library if need be. options NULL means the defaults. Threads and device are those of
 * the process, chosen by its first context: CONN_E_UNSUPPORTED if a later one asks for others. */
CONN_API conn_status conn_context_create(const conn_context_options* options,
                                         conn_context** context);
/** Ends it; *context becomes NULL. What was created with it goes on. NULL is fine, and so is
 * *context NULL. */
CONN_API conn_status conn_context_destroy(conn_context** context);
/** Number of host threads in use, and of workers in conn_map_traverse. */
CONN_API conn_status conn_context_threads(const conn_context* context, int32_t* n_threads);

enum {
    CONN_LOG_NONE = 0,
    CONN_LOG_ERROR = 1, /**< a line for each rebuild, patch, removal of pairs, traversal and update
                             of boundaries that fails */
    CONN_LOG_INFO = 2,  /**< also for each that succeeds: sizes, bytes, ms */
    CONN_LOG_DEBUG = 3  /**< also a line for each entry of the report that was built */
};
/** Receives a line without its end, in UTF-8 and valid during the call only. It comes from inside a
 * call, perhaps on a thread of the library, one line at a time. */
typedef void (*conn_log_callback)(void* user_data, int32_t level, const char* line);
/** What maps made with this context report, as it happens: lines up to this level. Until it is
 * called, and with CONN_LOG_NONE (callback may then be NULL), nothing. The end of the context ends
 * the log, also of maps that live on. */
CONN_API conn_status conn_context_set_log(conn_context* context, int32_t level,
                                          conn_log_callback callback, void* user_data);
/**@}*/

/** @name Node lists: named sets of nodes, internal ones first, then ghosts */
/**@{*/
typedef struct conn_nodes conn_nodes;

/** A list without nodes. name: 1 to 255 bytes. dim: 1, 2 or 3. kernel_extent in [1e-100, 1e100]:
 * the eta at which the kernel ends; the support radius is kernel_extent * h. */
CONN_API conn_status conn_nodes_create(conn_context* context, const char* name, int32_t dim,
                                       double kernel_extent, conn_nodes** nodes);
/** Ends it; *nodes becomes NULL. Maps keep what they built of it. NULL is fine, and so is *nodes
 * NULL. */
CONN_API conn_status conn_nodes_destroy(conn_nodes** nodes);
/** Copies positions [n, dim] and smoothing lengths h [n] >= 0 (same length unit). positions is one
 * array (n_positions = 1) or one array [n] for each axis (n_positions = dim). Each argument is
 * float64 or float32, which gives the lists of the same values in float64. The first n_internal
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
/** What nodes are called beside their number, for CONN_ORDER_KEY; copied, and forgotten by the next
 * conn_nodes_set_h or conn_nodes_set_tensor. Both are int32 or int64, one after the other or with a
 * stride; NULL: none. global_ids [nodes of the list]: names that do not depend on storage, the last
 * word between coincident nodes. owner [ghosts of the list]: of each ghost the internal node of
 * this list that it is an image of, counted from 0, or -1 for a ghost of its own; an image is
 * ordered by the key and the id of its owner. */
CONN_API conn_status conn_nodes_set_ids(conn_nodes* nodes, const conn_array* global_ids,
                                        const conn_array* owner);
/** Nodes in the list, and how many are internal. Either output may be NULL. */
CONN_API conn_status conn_nodes_size(const conn_nodes* nodes, int64_t* n, int64_t* n_internal);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
