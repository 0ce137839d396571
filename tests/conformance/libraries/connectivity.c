/* SPDX-License-Identifier: BSD-3-Clause */
/* libconnectivity, its list of pairs and its rows. */
#include <connectivity.h>

#include "../conformance.h"

typedef struct handles {
    conn_context* context;
    conn_nodes* nodes;
    conn_map* map;
} handles;

static conn_status build(handles* h, const conf_nodes* nodes, int rows) {
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.rows = rows;
    options.pairs = !rows;
    for (int d = 0; d < nodes->dim && nodes->period > 0; ++d) {
        options.periodic[d] = 1;
        options.box_hi[d] = nodes->period;
    }
    const conn_array x = conn_array_matrix(nodes->x, nodes->n, nodes->dim),
                     R = conn_array_vector(nodes->radius, nodes->n);
    conn_status s = conn_context_create(NULL, &h->context);
    if (s == CONN_OK) s = conn_nodes_create(h->context, "nodes", nodes->dim, 1.0, &h->nodes);
    if (s == CONN_OK) s = conn_nodes_set_h(h->nodes, nodes->n, &x, 1, &R);
    if (s == CONN_OK) s = conn_map_create(h->context, &options, &h->map);
    if (s == CONN_OK) s = conn_map_rebuild(h->map, &h->nodes, 1);
    return s;
}

static conn_status tell_pairs(conn_map* map, conf_answer* answer) {
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    const conn_status s = conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &pairs);
    for (int64_t i = 0; s == CONN_OK && i < pairs.n_slots; ++i)
        for (int64_t k = pairs.offsets[i]; k < pairs.offsets[i + 1]; ++k)
            conf_add_pair(answer, i, pairs.j[k]);
    conn_map_pairs_release(&pairs);
    return s;
}

static conn_status tell_rows(conn_map* map, conf_answer* answer) {
    conn_rows_view rows = CONN_ROWS_VIEW_INIT;
    const conn_status s = conn_map_rows_acquire(map, CONN_SPACE_HOST, &rows);
    for (int64_t i = 0; s == CONN_OK && i < rows.n_rows; ++i)
        conf_add_row(answer, i, rows.slots + rows.offsets[i],
                     rows.offsets[i + 1] - rows.offsets[i]);
    conn_map_rows_release(&rows);
    return s;
}

static void find(const conf_nodes* nodes, conf_answer* answer, int rows) {
    handles h = {NULL, NULL, NULL};
    conn_status s = build(&h, nodes, rows);
    if (s == CONN_OK) s = rows ? tell_rows(h.map, answer) : tell_pairs(h.map, answer);
    if (s != CONN_OK) conf_refuse(answer, conn_last_error());
    conn_map_destroy(&h.map);
    conn_nodes_destroy(&h.nodes);
    conn_context_destroy(&h.context);
}

static void find_pairs(const conf_nodes* nodes, conf_answer* answer) { find(nodes, answer, 0); }
static void find_rows(const conf_nodes* nodes, conf_answer* answer) { find(nodes, answer, 1); }

const conf_library conf_connectivity_pairs = {"libconnectivity-pairs", 0, find_pairs};
const conf_library conf_connectivity_rows = {"libconnectivity-rows", 0, find_rows};
