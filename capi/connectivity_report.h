/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_report.h
 * The report of a map. See connectivity.h.
 */
#ifndef CONNECTIVITY_REPORT_H
#define CONNECTIVITY_REPORT_H

#include "connectivity_map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Report: what the last rebuild made, who asked for it, what it cost
 * Texts belong to the map: they are valid until its next rebuild, patch or traversal, or
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
