/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What spatial order is worth to a host in C: its density loop over all pairs with nodes stored in
 * a random order, and with its fields put into the library's order by conn_reorder. One thread of
 * the host; prints the fastest of several loops each, and their ratio.
 * Usage: c_host_step [NODES [REPEATS]]. Nodes are random in a unit box, about 60 neighbours each.
 */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <connectivity.h>

#define CHECK(call)                                     \
    do {                                                \
        if ((call) != CONN_OK) {                        \
            fprintf(stderr, "%s\n", conn_last_error()); \
            exit(1);                                    \
        }                                               \
    } while (0)

static double uniform(void) {
    static uint64_t state = 88172645463325252u;
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

static double ms_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static double weight(double q) {
    const double rest = 1 - q;
    return q >= 1 ? 0 : q < 0.5 ? 1 - 6 * q * q * rest : 2 * rest * rest * rest;
}

/* Cubic spline with the supports of both ends, mass 1. */
static void sum_density(const conn_pairs_view* pairs, int64_t n, const double* x, const double* R,
                        double* density) {
    for (int64_t a = 0; a < n; ++a) density[a] = 1 / (R[a] * R[a] * R[a]);
    for (int64_t a = 0; a < n; ++a)
        for (int64_t k = pairs->offsets[a]; k < pairs->offsets[a + 1]; ++k) {
            const int64_t b = pairs->j[k];
            double r2 = 0;
            for (int d = 0; d < 3; ++d) {
                const double r = x[3 * a + d] - x[3 * b + d];
                r2 += r * r;
            }
            density[a] += weight(sqrt(r2) / R[a]) / (R[a] * R[a] * R[a]);
            density[b] += weight(sqrt(r2) / R[b]) / (R[b] * R[b] * R[b]);
        }
}

/* Milliseconds of the fastest loop over the pairs of these nodes; *total: the sum of densities. */
static double time_loop(conn_nodes* nodes, conn_map* map, int64_t n, double* x, double* R,
                        int repeats, double* total) {
    const conn_array positions = conn_array_matrix(x, n, 3), supports = conn_array_vector(R, n);
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    double* const density = malloc((size_t)n * sizeof *density);
    double best = INFINITY;
    if (density == NULL) exit(1);
    CHECK(conn_nodes_set_h(nodes, n, &positions, 1, &supports));
    CHECK(conn_map_rebuild(map, &nodes, 1));
    CHECK(conn_map_pairs_acquire(map, CONN_SPACE_HOST, 0, &pairs));
    for (int turn = 0; turn < repeats; ++turn) {
        const double start = ms_now();
        sum_density(&pairs, n, x, R, density);
        best = fmin(best, ms_now() - start);
    }
    *total = 0;
    for (int64_t a = 0; a < n; ++a) *total += density[a];
    CHECK(conn_map_pairs_release(&pairs));
    free(density);
    return best;
}

int main(int argc, char** argv) {
    const int64_t n = argc > 1 ? atol(argv[1]) : 1000000;
    const int repeats = argc > 2 ? atoi(argv[2]) : 5;
    conn_context* context = NULL;
    conn_nodes* nodes = NULL;
    conn_map* map = NULL;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    double shuffled_total = 0, ordered_total = 0;
    double *x, *R;
    int32_t* order;
    int64_t count = 0;
    if (n < 1 || repeats < 1) return 2;
    x = malloc(3 * (size_t)n * sizeof *x), R = malloc((size_t)n * sizeof *R);
    order = malloc((size_t)n * sizeof *order);
    if (x == NULL || R == NULL || order == NULL) return 1;
    for (int64_t k = 0; k < 3 * n; ++k) x[k] = uniform();
    for (int64_t a = 0; a < n; ++a) R[a] = cbrt(60 / (4.18879 * (double)n)) * (1 + 0.1 * uniform());

    options.rows = 0, options.spatial_order = 1;
    CHECK(conn_context_create(NULL, &context));
    CHECK(conn_nodes_create(context, "nodes", 3, 1.0, &nodes));
    CHECK(conn_map_create(context, &options, &map));
    const double shuffled = time_loop(nodes, map, n, x, R, repeats, &shuffled_total);
    CHECK(conn_map_spatial_order(map, 0, order, n, &count));
    const conn_array positions = conn_array_matrix(x, n, 3), supports = conn_array_vector(R, n);
    CHECK(conn_reorder(&positions, order, n, 0, x));
    CHECK(conn_reorder(&supports, order, n, 0, R));
    const double ordered = time_loop(nodes, map, n, x, R, repeats, &ordered_total);
    printf("%lld nodes: density loop over pairs, shuffled %.2f ms, reordered %.2f ms, ratio %.2f\n",
           (long long)n, shuffled, ordered, shuffled / ordered);
    CHECK(conn_map_destroy(&map));
    CHECK(conn_nodes_destroy(&nodes));
    CHECK(conn_context_destroy(&context));
    free(x), free(R), free(order);
    /* The same sums, but for their order. */
    return fabs(shuffled_total - ordered_total) <= 1e-9 * shuffled_total ? 0 : 3;
}
