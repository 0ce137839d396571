/* SPDX-License-Identifier: BSD-3-Clause */
#include "workloads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The documented hashes were taken with fused products and sums: the fusion is written out here. */

static const double pi = 3.14159265358979323846;
static const uint64_t golden = 0x9E3779B97F4A7C15u;

uint64_t conf_mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

double conf_random(uint64_t seed, uint64_t k) {
    return (double)(conf_mix(seed + (k + 1) * golden) >> 11) * 0x1.0p-53;
}

/** The k-th of four numbers that belong to point p. */
static double random_of(uint64_t seed, int64_t p, int k) {
    return conf_random(seed, (uint64_t)(4 * p + k));
}

/** Radius of a ball with so many others at a given density. */
static double radius_of(double neighbours, double density) {
    return cbrt((neighbours + 1.0) * 3.0 / (4.0 * pi * density));
}

/** Nodes as a share of a million. */
static double share(int64_t n) { return (double)n / 1e6; }

static int scaled(int side, double scale) {
    const long s = lround(side * scale);
    return s < 1 ? 1 : (int)s;
}

/** Room for n points at the origin with one radius; -1 without memory. */
static int reserve(conf_workload* w, int64_t n, double radius) {
    w->n = n;
    w->x = (double*)calloc((size_t)n * 3, sizeof(double));
    w->radius = (double*)malloc((size_t)n * sizeof(double));
    if (w->x == NULL || w->radius == NULL) return -1;
    for (int64_t p = 0; p < n; ++p) w->radius[p] = radius;
    return 0;
}

static int lattice(conf_workload* w, const int side[3], double jitter, uint64_t seed, double R) {
    if (reserve(w, (int64_t)side[0] * side[1] * side[2], R) != 0) return -1;
    int64_t p = 0;
    for (int k = 0; k < side[2]; ++k)
        for (int j = 0; j < side[1]; ++j)
            for (int i = 0; i < side[0]; ++i, ++p) {
                const int cell[3] = {i, j, k};
                for (int d = 0; d < 3; ++d)
                    w->x[3 * p + d] = fma(jitter, random_of(seed, p, d) - 0.5, cell[d] + 0.5);
            }
    return 0;
}

static int scaled_lattice(conf_workload* w, int a, int b, int c, double scale, uint64_t seed) {
    const int sides[3] = {scaled(a, scale), scaled(b, scale), scaled(c, scale)};
    return lattice(w, sides, 0.4, seed, radius_of(60, 1));
}

static void put_on_sphere(conf_workload* w, int64_t p, double r, uint64_t seed) {
    const double cosine = 2 * random_of(seed, p, 1) - 1;
    const double phi = 2 * pi * random_of(seed, p, 2), sine = sqrt(fma(-cosine, cosine, 1.0));
    w->x[3 * p] = r * sine * cos(phi);
    w->x[3 * p + 1] = r * sine * sin(phi);
    w->x[3 * p + 2] = r * cosine;
}

static int make_w1(conf_workload* w, int64_t n) {
    return scaled_lattice(w, 100, 100, 100, cbrt(share(n)), 101);
}

static int make_w2(conf_workload* w, int64_t n) {
    return scaled_lattice(w, 50, 50, 40, cbrt(10 * share(n)), 102);
}

/** Plummer sphere. */
static int make_w3(conf_workload* w, int64_t n) {
    if (reserve(w, n, 0) != 0) return -1;
    for (int64_t p = 0; p < n; ++p) {
        const double m = 0.99 * random_of(103, p, 0), q = 1.0 / cbrt(m * m);
        const double r = m == 0 ? 0 : 1.0 / sqrt(q - 1.0), t = fma(r, r, 1.0);
        const double central = (double)n / 0.99 * 3 / (4 * pi);
        put_on_sphere(w, p, r, 103);
        w->radius[p] = radius_of(60, central / (t * t * sqrt(t)));
    }
    return 0;
}

static int make_w4(conf_workload* w, int64_t n) {
    const int side = scaled(1000, sqrt(share(n))), sides[3] = {side, side, 1};
    if (lattice(w, sides, 0.4, 104, sqrt(26.0 / pi)) != 0) return -1;
    for (int64_t p = 0; p < w->n; ++p) w->x[3 * p + 2] = 0;
    return 0;
}

/** The mid radius makes the volume of the shell proportional to n: 141 at a million nodes. */
static int make_w5(conf_workload* w, int64_t n) {
    const double half = 2, far = 5e4;
    const double mid = sqrt(fmax(half * half, 19881 * share(n) + (share(n) - 1) * half * half / 3));
    const double inner = mid - half, outer = mid + half;
    const double cube = inner * inner * inner, volume = outer * outer * outer - cube;
    if (reserve(w, n, radius_of(60, 1)) != 0) return -1;
    for (int64_t p = 0; p < n; ++p)
        put_on_sphere(w, p, cbrt(fma(volume, random_of(105, p, 0), cube)), 105);
    for (int corner = 0; corner < 8 && corner < n; ++corner)
        for (int d = 0; d < 3; ++d) w->x[3 * corner + d] = (corner >> d & 1) != 0 ? far : -far;
    return 0;
}

/** Tank with spray. */
static int make_w6(conf_workload* w, int64_t n) {
    const double scale = cbrt(share(n));
    const int sides[3] = {scaled(200, scale), scaled(50, scale), scaled(100, scale)};
    const double size[3] = {4.0 * sides[0], 1.0 * sides[1], 2.0 * sides[2]};
    if (lattice(w, sides, 0.1, 106, radius_of(30, 1)) != 0) return -1;
    for (int64_t p = 0; p < w->n; p += 1000)
        for (int d = 0; d < 3; ++d) w->x[3 * p + d] = size[d] * random_of(1106, p, d);
    return 0;
}

/** Two sizes. */
static int make_w7(conf_workload* w, int64_t n) {
    const double small = radius_of(8, 1), side = 100 * cbrt(share(n));
    if (reserve(w, n, small) != 0) return -1;
    for (int64_t p = 0; p < n; ++p) {
        for (int d = 0; d < 3; ++d) w->x[3 * p + d] = side * random_of(107, p, d);
        if (random_of(107, p, 3) < 0.01) w->radius[p] = 10 * small;
    }
    return 0;
}

static uint64_t hash_of(const double* values, int64_t n) {
    uint64_t hash = 0;
    for (int64_t k = 0; k < n; ++k) {
        uint64_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        hash = hash * 1099511628211u + bits;
    }
    return hash;
}

static void swap_values(double* values, int64_t a, int64_t b) {
    const double kept = values[a];
    values[a] = values[b];
    values[b] = kept;
}

/** Fisher-Yates with the counter-based generator. */
static void shuffle(conf_workload* w) {
    for (uint64_t k = (uint64_t)w->n - 1; k > 0; --k) {
        const int64_t other = (int64_t)(conf_mix(0xC0FFEEu + (k + 1) * golden) % (k + 1));
        for (int d = 0; d < 3; ++d) swap_values(w->x, 3 * (int64_t)k + d, 3 * other + d);
        swap_values(w->radius, (int64_t)k, other);
    }
}

typedef struct recipe {
    int dim;
    int same_radius;
    conf_workload_facts known;
    int (*make)(conf_workload* w, int64_t n);
} recipe;

static const recipe recipes[CONF_N_WORKLOADS] = {
    {3, 1, {1000000, 31141276, 0x77657a2aa51dbbf7u}, make_w1},
    {3, 1, {100000, 3016522, 0xea879acbdfee552fu}, make_w2},
    {3, 0, {1000000, 32594744, 0x9d14d2be8b6f3fdbu}, make_w3},
    {2, 1, {1000000, 11783030, 0xed248b2996b9ac5eu}, make_w4},
    {3, 1, {1000000, 23534570, 0x8826a6a727bc567eu}, make_w5},
    {3, 1, {1000000, 13011005, 0x2fa3729f315b21eeu}, make_w6},
    {3, 0, {1000000, 80631534, 0x46f884a3b3ff39fbu}, make_w7},
};

conf_workload_facts conf_workload_known(int number) { return recipes[number - 1].known; }

int conf_workload_make(int number, int64_t n, conf_workload* workload) {
    const recipe* const r = &recipes[number - 1];
    const conf_workload none = {r->dim, 0, r->same_radius, NULL, NULL, 0};
    *workload = none;
    if (r->make(workload, n) != 0) {
        conf_workload_free(workload);
        return -1;
    }
    workload->hash = hash_of(workload->x, 3 * workload->n);
    shuffle(workload);
    return 0;
}

void conf_workload_free(conf_workload* workload) {
    free(workload->x);
    free(workload->radius);
    workload->x = workload->radius = NULL;
}
