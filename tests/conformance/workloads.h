/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file workloads.h
 * The points of the standard workloads W1-W7: the same on every machine, at any size.
 *
 * W1 jittered lattice, W2 the same at 1e5 nodes, W3 Plummer sphere with radii that follow density
 * (65x), W4 2D lattice, W5 thin shell in a huge box, W6 tank with scattered spray, W7 uniform with
 * 1 % of radii ten times larger. At other sizes lattice sides, W5's mid radius and W7's box are
 * scaled; lattices have the nearest number of nodes that fills their sides. Cost: about 0.2 us
 * and 100 bytes a node.
 */
#ifndef CONFORMANCE_WORKLOADS_H
#define CONFORMANCE_WORKLOADS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CONF_N_WORKLOADS = 7 };

typedef struct conf_workload {
    int dim; /**< components that count; x has three always */
    int64_t n;
    int same_radius;
    double* x;      /**< [n][3] shuffled; released by conf_workload_free */
    double* radius; /**< [n] shuffled */
    uint64_t hash;  /**< of the points before the shuffle */
} conf_workload;

/** What is known of a workload at its standard size. */
typedef struct conf_workload_facts {
    int64_t n;
    int64_t n_pairs;
    uint64_t hash; /**< W3 and W5 use cos, sin and cbrt: another mathematics library may round them
                        differently, and then has other points */
} conf_workload_facts;

/** number: 1 to 7. */
conf_workload_facts conf_workload_known(int number);
/** n: nodes wanted. Returns 0, or -1 without memory. */
int conf_workload_make(int number, int64_t n, conf_workload* workload);
void conf_workload_free(conf_workload* workload);

/** Counter-based random numbers: the k-th number of a seed in [0, 1), and the finaliser of
 * splitmix64 behind it. */
double conf_random(uint64_t seed, uint64_t k);
uint64_t conf_mix(uint64_t z);

#ifdef __cplusplus
}
#endif

#endif
