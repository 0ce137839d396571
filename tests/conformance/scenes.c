/* SPDX-License-Identifier: BSD-3-Clause */
#include "scenes.h"

#include <math.h>
#include <stdlib.h>

#include "workloads.h"

/* ---- points ------------------------------------------------------------------------------- */

static int reserve(conf_points* p, int dim, int64_t n, double radius) {
    const size_t room = n > 0 ? (size_t)n : 1;
    p->dim = dim;
    p->n = n;
    p->period = 0;
    p->x = (double*)calloc(room * (size_t)dim, sizeof(double));
    p->radius = (double*)malloc(room * sizeof(double));
    if (p->x == NULL || p->radius == NULL) return -1;
    for (int64_t i = 0; i < n; ++i) p->radius[i] = radius;
    return 0;
}

void conf_points_free(conf_points* points) {
    free(points->x);
    free(points->radius);
    points->x = points->radius = NULL;
}

static void place(conf_points* p, int64_t i, double x, double y, double z) {
    const double at[3] = {x, y, z};
    for (int d = 0; d < p->dim; ++d) p->x[i * p->dim + d] = at[d];
}

/** A cubic lattice: side^dim nodes. */
static int lattice(conf_points* p, int dim, int side, double spacing, double origin, double R) {
    int64_t n = 1;
    for (int d = 0; d < dim; ++d) n *= side;
    if (reserve(p, dim, n, R) != 0) return -1;
    for (int64_t i = 0; i < n; ++i) {
        const int64_t a = i % side, b = i / side % side, c = i / side / side;
        place(p, i, origin + (double)a * spacing, origin + (double)b * spacing,
              origin + (double)c * spacing);
    }
    return 0;
}

static void scatter(conf_points* p, int64_t first, int64_t n, uint64_t seed, double size) {
    for (int64_t i = first; i < first + n; ++i)
        for (int d = 0; d < p->dim; ++d)
            p->x[i * p->dim + d] = size * conf_random(seed, (uint64_t)(4 * i + d));
}

/* ---- scenes ------------------------------------------------------------------------------- */

static int make_workload(int number, conf_points* p) {
    const conf_workload_facts known = conf_workload_known(number);
    conf_workload w;
    if (conf_workload_make(number, known.n, &w) != 0) return -1;
    const int failed = reserve(p, w.dim, w.n, 0);
    for (int64_t i = 0; failed == 0 && i < w.n; ++i) {
        place(p, i, w.x[3 * i], w.x[3 * i + 1], w.x[3 * i + 2]);
        p->radius[i] = w.radius[i];
    }
    conf_workload_free(&w);
    return failed != 0 ? failed : w.hash != known.hash;
}

static int make_coincident(int n, conf_points* p) {
    if (reserve(p, 3, n, 0.1) != 0) return -1;
    for (int i = 0; i < n; ++i) place(p, i, 0.3, 0.3, 0.3);
    return 0;
}

static int make_line(int dim, conf_points* p) {
    if (reserve(p, dim, 1000, 3) != 0) return -1;
    for (int i = 0; i < 1000; ++i) place(p, i, i, 0, 0);
    return 0;
}

static int make_plane(int tilted, conf_points* p) {
    if (reserve(p, 3, 1024, 2.5) != 0) return -1;
    for (int i = 0; i < 1024; ++i) place(p, i, i % 32, i / 32, tilted ? i / 32 : 0);
    return 0;
}

/** Two clusters of 1000 at distance 1: all nodes of each see each other. */
static int make_clusters(int exponent, conf_points* p) {
    if (reserve(p, 3, 2000, 0.1) != 0) return -1;
    scatter(p, 0, 2000, 2003, pow(10, -exponent));
    for (int i = 0; i < 2000; i += 2) p->x[3 * i] += 1;
    return 0;
}

/** One cluster whose nodes see a few of each other, and one node far away. */
static int make_dense_cluster(int exponent, conf_points* p) {
    const double size = pow(10, -exponent);
    if (reserve(p, 3, 2001, 0.2 * size) != 0) return -1;
    scatter(p, 0, 2000, 2013, size);
    place(p, 2000, 1, 1, 1);
    return 0;
}

static int make_outlier(int exponent, conf_points* p) {
    const double far = pow(10, exponent);
    if (reserve(p, 3, 8001, 0.12) != 0) return -1;
    scatter(p, 0, 8000, 2004, 1);
    place(p, 8000, far, far, far);
    return 0;
}

/** Every third node is blind, but may be seen. */
static int make_blind(int unused, conf_points* p) {
    (void)unused;
    if (reserve(p, 3, 1000, 0.2) != 0) return -1;
    scatter(p, 0, 1000, 2006, 1);
    for (int i = 0; i < 1000; i += 3) p->radius[i] = 0;
    return 0;
}

/** 27 nodes in a periodic box of side 1; support in hundredths. */
static int make_small_box(int hundredths, conf_points* p) {
    if (lattice(p, 3, 3, 0.25, 0.125, hundredths / 100.0) != 0) return -1;
    p->period = 1;
    return 0;
}

static int make_on_surface(int periodic, conf_points* p) {
    if (lattice(p, 3, 8, 1, 0, 2) != 0) return -1;
    p->period = periodic ? 8 : 0;
    return 0;
}

static int make_periodic_plane(int unused, conf_points* p) {
    (void)unused;
    if (lattice(p, 2, 16, 1, 0, 2) != 0) return -1;
    p->period = 16;
    return 0;
}

/** Supports of exactly half the box. */
static int make_half_box(int unused, conf_points* p) {
    (void)unused;
    if (lattice(p, 3, 4, 1, 0, 2) != 0) return -1;
    p->period = 4;
    return 0;
}

static int make_few(int n, conf_points* p) {
    if (reserve(p, 3, n, 1) != 0) return -1;
    for (int i = 0; i < n; ++i) place(p, i, 2 * i, 0, 0);
    return 0;
}

/** Two nodes, each on the surface of the other's support. */
static int make_touching(int unused, conf_points* p) {
    (void)unused;
    if (reserve(p, 3, 2, 1) != 0) return -1;
    place(p, 1, 1, 0, 0);
    return 0;
}

static int make_far_from_origin(int exponent, conf_points* p) {
    return lattice(p, 3, 20, 0.01, pow(10, exponent), 0.024);
}

static int make_giant(int unused, conf_points* p) {
    (void)unused;
    if (reserve(p, 3, 20001, 2.4420079599615385) != 0) return -1;
    scatter(p, 0, 20000, 2016, 27);
    place(p, 20000, 13.5, 13.5, 13.5);
    p->radius[20000] = 27;
    return 0;
}

/* clang-format off */
const conf_scene conf_scenes[] = {
    {"W1", "jittered lattice, 1e6 nodes",
     1, 0, make_workload, {31141276, 0xcbf744554b02e315u, 0x60b1ecc6d59b3fe1u}},
    {"W2", "jittered lattice, 1e5 nodes",
     2, 0, make_workload, {3016522, 0x422e17a72f5fb066u, 0xd02c197769189a81u}},
    {"W3", "Plummer sphere: supports and density follow each other over 65x and 2.7e5x",
     3, 0, make_workload, {32594744, 0x6622e4b0b961a3b1u, 0x5f3e0aba28d498ebu}},
    {"W4", "plane lattice",
     4, 0, make_workload, {11783030, 0x9cb37a3cef0953fdu, 0xe300ecca8667ccc8u}},
    {"W5", "thin shell in a box 350 times as large",
     5, 0, make_workload, {23534570, 0xb8c02089572867bau, 0xb4976461f6c342c4u}},
    {"W6", "tank and spray",
     6, 0, make_workload, {13011005, 0x91237c12d46a6856u, 0x978cdaba83541246u}},
    {"W7", "one node in a hundred with ten times the support",
     7, 0, make_workload, {80631534, 0x87d54961b3ec37f9u, 0x745315545f8e606fu}},
    {"A1-2", "two nodes at one place",
     2, 0, make_coincident, {1, 0xdbd238973a2b148au, 0x106e11b2223f6961u}},
    {"A1-65", "65 nodes at one place: no tree can part them",
     65, 0, make_coincident, {2080, 0xa719eca84513bbe4u, 0xb512acab98e8e0d2u}},
    {"A1-4096", "4096 nodes at one place",
     4096, 0, make_coincident, {8386560, 0x6603fd70ace81b0cu, 0x6afee3f1bde99af9u}},
    {"A2-1d", "1000 nodes on a line, one dimension",
     1, 0, make_line, {2994, 0x9bd76546dbeb24ccu, 0x97e39180b537ee72u}},
    {"A2-line", "the same line in three dimensions",
     3, 0, make_line, {2994, 0x9bd76546dbeb24ccu, 0x97e39180b537ee72u}},
    {"A2-plane", "a plane in three dimensions",
     0, 0, make_plane, {9546, 0xf18a56c8fd5e652du, 0x502978dc4efcf367u}},
    {"A2-tilted", "the same at 45 degrees",
     1, 0, make_plane, {6726, 0x2c8ef4e9a0cbb608u, 0x4a53ea429adcc270u}},
    {"A3-1e-9", "two clusters, 1e-9 of their distance wide",
     9, 0, make_clusters, {999000, 0xa3221c1daed91e42u, 0x11bcfebb3e2d9762u}},
    {"A3-1e-13", "two clusters, 1e-13 of their distance wide",
     13, 0, make_clusters, {999000, 0xa3221c1daed91e42u, 0x11bcfebb3e2d9762u}},
    {"A3-inside-1e-9", "a cluster of 1e-9 of the box; supports a fifth of it",
     9, 0, make_dense_cluster, {52024, 0xa0ac5b85731b2ad6u, 0x5e8840f6e974624au}},
    {"A3-inside-1e-13", "a cluster of 1e-13 of the box; supports a fifth of it",
     13, 0, make_dense_cluster, {52024, 0xa0ac5b85731b2ad6u, 0x5e8840f6e974624au}},
    {"A4-1e3", "one node 1e3 boxes away",
     3, 0, make_outlier, {200796, 0xf6cf69fd983b8eedu, 0x04bf7b87ec12508au}},
    {"A4-1e30", "one node 1e30 boxes away: its square is no float",
     30, 0, make_outlier, {200796, 0xf6cf69fd983b8eedu, 0x04bf7b87ec12508au}},
    {"A4-1e200", "one node 1e200 boxes away: its square is no double",
     200, 0, make_outlier, {200796, 0xf6cf69fd983b8eedu, 0x04bf7b87ec12508au}},
    {"A6-blind", "every third node has no support, and is seen by others",
     0, 0, make_blind, {12040, 0x8ba43d65921fd841u, 0x3733420b87608465u}},
    {"A9-0.40", "periodic box of side 1, supports 0.40",
     40, 0, make_small_box, {126, 0xc4b8c1a1d489d123u, 0x87431c517d0a5f3du}},
    {"A9-0.51", "supports 0.51: beyond half the box",
     51, 1, make_small_box, {185, 0x5496f54636397aebu, 0xb4fd164e36bf336cu}},
    {"A9-0.90", "supports 0.90",
     90, 1, make_small_box, {351, 0xb8ad05383952ab02u, 0x4f7612a4c07c07c3u}},
    {"A9-1.20", "supports 1.20",
     120, 1, make_small_box, {351, 0xb8ad05383952ab02u, 0x4f7612a4c07c07c3u}},
    {"A9-half", "supports of exactly half the box",
     0, 0, make_half_box, {928, 0x45b553ba4cc66deeu, 0x8527a58a389eb80fu}},
    {"A9-2d", "a periodic plane",
     0, 0, make_periodic_plane, {1536, 0x16fdfbc62d8ba54eu, 0x331c13ee2c3d2262u}},
    {"A10-open", "nodes exactly on the surface of supports",
     0, 0, make_on_surface, {6220, 0x040f40b19564f9e5u, 0x7c7e1b5dbc0f1125u}},
    {"A10-periodic", "the same, periodic",
     1, 0, make_on_surface, {8192, 0x72f212667a2675dau, 0x449f0d3b02bd16bfu}},
    {"A11-0", "no node",
     0, 0, make_few, {0, 0x0000000000000000u, 0x0000000000000000u}},
    {"A11-1", "one node",
     1, 0, make_few, {0, 0x0000000000000000u, 0x0000000000000000u}},
    {"A11-2", "two nodes apart",
     2, 0, make_few, {0, 0x0000000000000000u, 0x0000000000000000u}},
    {"A11-touching", "two nodes, each on the other's surface",
     0, 0, make_touching, {1, 0xdbd238973a2b148au, 0x106e11b2223f6961u}},
    {"A14-1e3", "lattice of 0.01 at 1e3: more digits than a float has",
     3, 0, make_far_from_origin, {197236, 0x094f4b2f09eb7fcbu, 0x32ae501f14a63368u}},
    {"A14-1e5", "the same at 1e5",
     5, 0, make_far_from_origin, {197236, 0x094f4b2f09eb7fcbu, 0x32ae501f14a63368u}},
    {"A16", "one support that holds all 20 000 others",
     0, 0, make_giant, {579131, 0xae816f966b56a6abu, 0x318d354fdd14a341u}},
};
/* clang-format on */
const int conf_n_scenes = (int)(sizeof conf_scenes / sizeof conf_scenes[0]);

/* ---- answers ------------------------------------------------------------------------------ */

uint64_t conf_pair_hash(int64_t i, int64_t j) {
    return conf_mix(((uint64_t)i << 32) + (uint64_t)j + 1);
}

void conf_pairs_add(conf_pairs* pairs, int64_t i, int64_t j) {
    const int64_t lo = i < j ? i : j, hi = i < j ? j : i;
    ++pairs->count;
    pairs->ascending += conf_pair_hash(lo, hi);
    pairs->descending += conf_pair_hash(hi, lo);
}

conf_nodes conf_nodes_of(const conf_points* p) {
    conf_nodes nodes = {p->dim, p->n,     p->n > 0 ? p->x : NULL, p->n > 0 ? p->radius : NULL,
                        1,      p->period};
    for (int64_t i = 1; i < p->n; ++i)
        if (p->radius[i] != p->radius[0]) nodes.same_radius = 0;
    return nodes;
}
