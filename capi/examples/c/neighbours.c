/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes in, rebuild, loop over pairs, move the nodes, rebuild: what a host does in every step.
 * From the root of a built clone:
 * cc capi/examples/c/neighbours.c -Icapi -Iinclude -Lbuild -lconnectivity -Wl,-rpath,$PWD/build */
#include <stdio.h>

#include <connectivity.h>

enum { side = 10, n = side * side * side };

static double x[n][3], h[n];
static int neighbours[n];

static int check(conn_status status) {
    if (status != CONN_OK) fprintf(stderr, "%s\n", conn_last_error());
    return status == CONN_OK;
}

/* Neighbours of each node, counted over the pairs: each pair is there once. */
static int count_neighbours(conn_map* map) {
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    if (!check(conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &pairs))) return 0;
    for (int i = 0; i < n; ++i) neighbours[i] = 0;
    for (int64_t i = 0; i < pairs.n_slots; ++i)
        for (int64_t k = pairs.offsets[i]; k < pairs.offsets[i + 1]; ++k) {
            ++neighbours[i];
            ++neighbours[pairs.j[k]];
        }
    printf("generation %llu: %lld pairs, node 0 has %d neighbours\n",
           (unsigned long long)pairs.generation, (long long)pairs.n_pairs, neighbours[0]);
    return check(conn_map_pairs_release(&pairs));
}

int main(void) {
    conn_context* context = NULL;
    conn_nodes* gas = NULL;
    conn_map* map = NULL;
    const conn_array positions = conn_array_matrix(x[0], n, 3), lengths = conn_array_vector(h, n);

    for (int i = 0; i < n; ++i) { /* a unit lattice; supports reach 2 h = 1.5 */
        x[i][0] = i % side;
        x[i][1] = i / side % side;
        x[i][2] = i / side / side;
        h[i] = 0.75;
    }
    int ok = check(conn_context_create(NULL, &context)) &&
             check(conn_nodes_create(context, "gas", 3, 2.0, &gas)) &&
             check(conn_map_create(context, NULL, &map));
    for (int step = 0; ok && step < 2; ++step) {
        conn_nodes* lists[] = {gas};
        ok = check(conn_nodes_set_h(gas, n, &positions, 1, &lengths)) &&
             check(conn_map_rebuild(map, lists, 1)) && count_neighbours(map);
        for (int i = 0; i < n; ++i) x[i][0] *= 1.25; /* the next step is stretched along x */
    }
    conn_map_destroy(&map);
    conn_nodes_destroy(&gas);
    conn_context_destroy(&context);
    return ok ? 0 : 1;
}
