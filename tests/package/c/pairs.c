/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Pairs of a unit lattice whose supports reach 1.5: six neighbours along the axes and twelve across
 * the faces, so 3 m²(m-1) + 6 m (m-1)² pairs for m nodes a side. Prints their number and the
 * version of the library that was loaded. */
#include <connectivity.h>
#include <stdio.h>

enum { m = 10, n = m * m * m };

static double x[n][3], h[n];

static void make_lattice(void) {
    for (int i = 0; i < n; ++i) {
        x[i][0] = i % m;
        x[i][1] = i / m % m;
        x[i][2] = i / m / m;
        h[i] = 0.75;
    }
}

/* Pairs in the list that are as close as they should be. */
static int64_t count_close(const conn_pairs_view* pairs) {
    int64_t count = 0;
    for (int64_t i = 0; i < pairs->n_slots; ++i)
        for (int64_t k = pairs->offsets[i]; k < pairs->offsets[i + 1]; ++k) {
            const double *a = x[i], *b = x[pairs->j[k]];
            const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
            count += dx * dx + dy * dy + dz * dz <= 1.5 * 1.5;
        }
    return count;
}

int main(void) {
    const int64_t expected = 3 * m * m * (m - 1) + 6 * m * (m - 1) * (m - 1);
    conn_context* context = NULL;
    conn_nodes* nodes = NULL;
    conn_map* map = NULL;
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    const conn_array positions = conn_array_matrix(x[0], n, 3), lengths = conn_array_vector(h, n);

    make_lattice();
    if (conn_context_create(NULL, &context) ||
        conn_nodes_create(context, "lattice", 3, 2.0, &nodes) ||
        conn_nodes_set_h(nodes, n, &positions, 1, &lengths) ||
        conn_map_create(context, NULL, &map) || conn_map_rebuild(map, &nodes, 1) ||
        conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &pairs)) {
        fprintf(stderr, "%s\n", conn_last_error());
        return 1;
    }
    const int64_t count = count_close(&pairs);
    printf("%lld pairs, version %s\n", (long long)count, conn_version_string());
    const int wrong = count != expected || pairs.n_pairs != expected;
    conn_map_pairs_release(&pairs);
    conn_map_destroy(&map);
    conn_nodes_destroy(&nodes);
    conn_context_destroy(&context);
    return wrong;
}
