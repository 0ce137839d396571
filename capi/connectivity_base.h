/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_base.h
 * Status, version and arrays: what all parts of the interface share. See connectivity.h.
 */
#ifndef CONNECTIVITY_BASE_H
#define CONNECTIVITY_BASE_H

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
/** How the library was built, a JSON object, static text: "version", "kokkos", "backends" (names),
 * "device" (whether one of them is no host), "kokkos_linkage" ("private", "shared"), "spaces" of
 * arrays that are read, "compiler", "max_nodes", "asserts". */
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
    CONN_STRUCT_REPORT_ENTRY = 7,
    CONN_STRUCT_INTERSECTION_VIEW = 8,
    CONN_STRUCT_BOUNDARY_NODES = 9,
    CONN_STRUCT_ESTIMATE = 10,
    CONN_STRUCT_TREE_OPTIONS = 11,
    CONN_STRUCT_TREE_INPUT = 12,
    CONN_STRUCT_TREE_VIEW = 13,
    CONN_STRUCT_BOX_LIST_VIEW = 14,
    CONN_STRUCT_PARTICLES_VIEW = 15,
    CONN_STRUCT_LISTS_OPTIONS = 16,
    CONN_STRUCT_CLASSES_VIEW = 17,
    CONN_STRUCT_GRAVITY_OPTIONS = 18,
    CONN_STRUCT_GRAVITY_INFO = 19,
    CONN_STRUCT_GRAVITY_VIEW = 20
};
/** sizeof of a struct in the library that is loaded, for hosts that mirror the structs in another
 * language; 0 if there is no such struct. */
CONN_API int64_t conn_abi_sizeof(int32_t which);
/**@}*/

/** @name Arrays of the host
 * Read during the call only; nothing of the host is kept. Component c of node i is
 * data[i*stride[0] + c*stride[1]], strides counted in elements, of any sign; 0 repeats one value.
 * x(3,n) of Fortran or a C array x[n][3]: conn_array_matrix; x(n,3) of Fortran or x[3][n]:
 * conn_array_planar; separate x, y, z: three of conn_array_vector, where a function takes one array
 * for each component. data may be NULL if extent[0] is 0. With ndim 1 the second entries are not
 * read. Numbers that a function does not take are CONN_E_ARGUMENT, memory that this build does not
 * reach CONN_E_UNSUPPORTED.
 */
/**@{*/
enum { /* Where memory is. This version reads the first two. */
       CONN_SPACE_HOST = 0,
       CONN_SPACE_HOST_PINNED = 1,
       CONN_SPACE_DEVICE = 2,
       CONN_SPACE_MANAGED = 3
};
enum { CONN_FLOAT64 = 0, CONN_FLOAT32 = 1, CONN_INT32 = 2, CONN_INT64 = 3 };

typedef struct conn_array {
    const void* data;
    int32_t space;     /**< CONN_SPACE_HOST, ... */
    int32_t device_id; /**< of CONN_SPACE_DEVICE */
    int32_t dtype;     /**< CONN_FLOAT64, ... */
    int32_t ndim;      /**< 1 or 2 */
    int64_t extent[2]; /**< nodes, components */
    int64_t stride[2]; /**< elements from node to node, from component to component */
} conn_array;

/** n values one after the other, of any of the four types. */
static inline conn_array conn_array_of(int32_t dtype, const void* data, int64_t n) {
    conn_array a = {data, CONN_SPACE_HOST, 0, dtype, 1, {n, 1}, {1, 1}};
    return a;
}
/** The same of CONN_FLOAT64. */
static inline conn_array conn_array_vector(const double* data, int64_t n) {
    return conn_array_of(CONN_FLOAT64, data, n);
}
/** The same of CONN_FLOAT32. */
static inline conn_array conn_array_vector_float(const float* data, int64_t n) {
    return conn_array_of(CONN_FLOAT32, data, n);
}
/** The same of CONN_INT32. */
static inline conn_array conn_array_vector_int32(const int32_t* data, int64_t n) {
    return conn_array_of(CONN_INT32, data, n);
}
/** The same of CONN_INT64. */
static inline conn_array conn_array_vector_int64(const int64_t* data, int64_t n) {
    return conn_array_of(CONN_INT64, data, n);
}
/** n nodes one after the other, the components of a node together: x[n][n_components]. */
static inline conn_array conn_array_matrix_of(int32_t dtype, const void* data, int64_t n,
                                              int64_t n_components) {
    conn_array a = {data, CONN_SPACE_HOST, 0, dtype, 2, {n, n_components}, {n_components, 1}};
    return a;
}
/** The same of CONN_FLOAT64. */
static inline conn_array conn_array_matrix(const double* data, int64_t n, int64_t n_components) {
    return conn_array_matrix_of(CONN_FLOAT64, data, n, n_components);
}
/** The same of CONN_FLOAT32. */
static inline conn_array conn_array_matrix_float(const float* data, int64_t n,
                                                 int64_t n_components) {
    return conn_array_matrix_of(CONN_FLOAT32, data, n, n_components);
}
/** The components one after the other, the nodes of a component together: x[n_components][n]. */
static inline conn_array conn_array_planar_of(int32_t dtype, const void* data, int64_t n,
                                              int64_t n_components) {
    conn_array a = {data, CONN_SPACE_HOST, 0, dtype, 2, {n, n_components}, {1, n}};
    return a;
}
/** The same of CONN_FLOAT64. */
static inline conn_array conn_array_planar(const double* data, int64_t n, int64_t n_components) {
    return conn_array_planar_of(CONN_FLOAT64, data, n, n_components);
}
/** The same of CONN_FLOAT32. */
static inline conn_array conn_array_planar_float(const float* data, int64_t n,
                                                 int64_t n_components) {
    return conn_array_planar_of(CONN_FLOAT32, data, n, n_components);
}
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
