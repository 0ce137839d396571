/* SPDX-License-Identifier: BSD-3-Clause
 * Nodes in, rebuild, loop over pairs, sums of pair values at nodes, move, rebuild, patch: the same
 * digits as ../fortran/neighbours.f90 and ../python/neighbours.py. Built by
 *     cc neighbours.c $(pkg-config --cflags --libs connectivity) */
#include <connectivity.h>
#include <stdio.h>
#include <stdlib.h>
#define CHECK(call) \
    if ((call) != CONN_OK) fprintf(stderr, "%s\n", conn_last_error()), exit(1)

enum { side = 10, n = side * side * side, left = n - side * side };
static double x[n][3], h[n], density[n];
static conn_nodes* gas;
static conn_map* map;
static conn_pair_field* weights;

static void show(const char* what) {
    int64_t n_pairs = 0;
    CHECK(conn_pair_field_data(weights, map, NULL, &n_pairs, NULL));
    CHECK(conn_pair_field_sum(weights, map, CONN_SYMMETRIC, CONN_SUM_DETERMINISTIC, density, n));
    printf("%s: %d pairs\n%24.16E%24.16E\n", what, (int)n_pairs, density[0], density[left - 1]);
}

static void step(void) {
    const conn_array positions = conn_array_matrix(x[0], n, 3), lengths = conn_array_vector(h, n);
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    double* weight = NULL;
    CHECK(conn_nodes_set_h(gas, n, &positions, 1, &lengths));
    CHECK(conn_map_rebuild(map, &gas, 1));
    CHECK(conn_pair_field_destroy(&weights));
    CHECK(conn_pair_field_create(map, 1, &weights));
    CHECK(conn_pair_field_data(weights, map, &weight, NULL, NULL));
    CHECK(conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &pairs));
    for (int64_t k = 0; k < pairs.n_pairs; ++k) { /* each pair once */
        const double *a = x[pairs.i[k]], *b = x[pairs.j[k]];
        const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        weight[k] = 1 - (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 2.25;
    }
    CHECK(conn_map_pairs_release(&pairs));
    show("rebuilt");
}

int main(void) {
    conn_context* context = NULL;
    int32_t keep[n], old2new[n];
    for (int a = 0; a < n; ++a) { /* a unit lattice; supports reach 2 h = 1.5 */
        x[a][0] = a % side, x[a][1] = a / side % side, x[a][2] = a / side / side, h[a] = 0.75;
        keep[a] = a < left, old2new[a] = a; /* without its last layer */
    }
    CHECK(conn_context_create(NULL, &context));
    CHECK(conn_nodes_create(context, "gas", 3, 2.0, &gas));
    CHECK(conn_map_create(context, NULL, &map));
    step();
    for (int a = 0; a < n; ++a) x[a][0] *= 1.25, x[a][1] *= 0.9; /* stretched and squeezed */
    step();
    CHECK(conn_map_patch(map, keep, old2new, n, &weights, 1));
    show("patched");
    conn_pair_field_destroy(&weights), conn_map_destroy(&map);
    conn_nodes_destroy(&gas), conn_context_destroy(&context);
}
