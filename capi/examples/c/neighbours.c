/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes in, rebuild, loop over pairs, sums of pair values at nodes, move, rebuild, patch: the same
 * digits as ../fortran/neighbours.f90 and ../python/neighbours.py. Built by
 *
 *     cc neighbours.c $(pkg-config --cflags --libs connectivity) -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <connectivity.h>

enum { side = 10, n = side * side * side, left = n - side * side };

static double x[n][3], h[n], density[n], push[3 * n];
static const double* shown = push + 3 * (left - 1);
static conn_nodes* gas;
static conn_map* map;
static conn_pair_field* field;

static void check(conn_status status) {
    if (status == CONN_OK) return;
    fprintf(stderr, "%s: %s\n", conn_status_text(status), conn_last_error());
    exit(1);
}

static void step(void) {
    const conn_array positions = conn_array_matrix(x[0], n, 3), lengths = conn_array_vector(h, n);
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    double* force = NULL;
    check(conn_nodes_set_h(gas, n, &positions, 1, &lengths));
    check(conn_map_rebuild(map, &gas, 1));
    check(conn_pair_field_destroy(&field));
    check(conn_pair_field_create(map, 3, &field));
    check(conn_pair_field_data(field, map, &force, NULL, NULL));
    check(conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &pairs));
    /* A node sees itself; Wendland C2 over its value at distance 0. */
    for (int a = 0; a < n; ++a) density[a] = 1;
    for (int64_t k = 0; k < pairs.n_pairs; ++k) { /* each pair once */
        const double *a = x[pairs.i[k]], *b = x[pairs.j[k]];
        const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        const double q = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 1.5, t = (1 - q) * (1 - q);
        density[pairs.i[k]] += t * t * (1 + 4 * q);
        density[pairs.j[k]] += t * t * (1 + 4 * q);
        for (int axis = 0; axis < 3; ++axis) force[3 * k + axis] = t * d[axis];
    }
    check(conn_pair_field_sum(field, map, CONN_ANTISYMMETRIC, CONN_SUM_DETERMINISTIC, push, 3 * n));
    printf("rebuilt: %lld pairs\ndensity%24.16E%24.16E\nforce%24.16E%24.16E%24.16E\n",
           (long long)pairs.n_pairs, density[0], density[n / 2 - 1], shown[0], shown[1], shown[2]);
    check(conn_map_pairs_release(&pairs));
}

int main(void) {
    conn_context* context = NULL;
    int32_t keep[n], old2new[n];
    int64_t n_pairs = 0;

    for (int a = 0; a < n; ++a) { /* a unit lattice; supports reach 2 h = 1.5 */
        x[a][0] = a % side, x[a][1] = a / side % side, x[a][2] = a / side / side;
        h[a] = 0.75;
    }
    check(conn_context_create(NULL, &context));
    check(conn_nodes_create(context, "gas", 3, 2.0, &gas));
    check(conn_map_create(context, NULL, &map));
    step();

    /* Stretched along x, squeezed along y. */
    for (int a = 0; a < n; ++a) x[a][0] *= 1.25, x[a][1] *= 0.9;
    step();

    /* The last layer goes, the other nodes keep their numbers. */
    for (int a = 0; a < n; ++a) keep[a] = a < left, old2new[a] = a;
    check(conn_map_patch(map, keep, old2new, n, &field, 1));
    check(conn_map_pairs_copy(map, NULL, NULL, NULL, 0, &n_pairs));
    check(conn_pair_field_sum(field, map, CONN_ANTISYMMETRIC, CONN_SUM_DETERMINISTIC, push, 3 * n));
    printf("patched: %lld pairs\nforce%24.16E%24.16E%24.16E\n", (long long)n_pairs, shown[0],
           shown[1], shown[2]);
    check(conn_pair_field_destroy(&field));
    check(conn_map_destroy(&map));
    check(conn_nodes_destroy(&gas));
    check(conn_context_destroy(&context));
    return 0;
}
