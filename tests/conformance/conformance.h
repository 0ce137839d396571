/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file conformance.h
 * What a neighbour library must answer, whatever its interface: an adapter of a few lines hands
 * over its pairs, and these scenes judge them.
 *
 * The question. Nodes i and j, i != j, are a pair if |x_i - x_j| <= max(R_i, R_j): the support of
 * either reaches the other, its surface included. In a periodic scene the distance is that of the
 * nearest images. The answer is right if it is exactly the set of pairs, compared by its size and
 * by a sum over pairs that does not depend on their order.
 *
 * To judge another library: write an adapter, see libraries/, and name it in CMakeLists.txt.
 */
#ifndef CONFORMANCE_H
#define CONFORMANCE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The nodes of a scene, in the caller's order. */
typedef struct conf_nodes {
    int dim;              /**< 1, 2 or 3 */
    int64_t n;            /**< may be 0 */
    const double* x;      /**< [n][dim]; NULL if n is 0 */
    const double* radius; /**< [n] supports, at least 0 */
    int same_radius;      /**< all supports are equal */
    double period;        /**< side of the periodic box [0, period)^dim; 0: open */
} conf_nodes;

/** Where an adapter puts its pairs; not to be looked into. */
typedef struct conf_answer conf_answer;

/** One pair, in any order, each exactly once. Not for several threads at once. */
void conf_add_pair(conf_answer* answer, int64_t i, int64_t j);
/** The neighbours of node i; call it for every i: each pair then comes from both sides. */
void conf_add_row(conf_answer* answer, int64_t i, const int32_t* neighbours, int64_t n);
/** Why the library gave no answer; for errors that it reports. Copied. */
void conf_refuse(conf_answer* answer, const char* reason);

enum { /* What a library cannot do by its own account; such scenes are not put to it. */
       CONF_SAME_RADIUS_ONLY = 1,
       CONF_OPEN_ONLY = 2,        /**< no periodic boxes */
       CONF_THREE_D_ONLY = 4,     /**< 2D nodes come as 3D nodes with z = 0, 1D likewise */
       CONF_FEW_NODES = 8,        /**< 25 000 */
       CONF_SINGLE_PRECISION = 16 /**< told in the table, judged all the same */
};

typedef struct conf_library {
    const char* name;
    int limits; /**< of CONF_*, added */
    /** Finds all pairs, or refuses. */
    void (*find_pairs)(const conf_nodes* nodes, conf_answer* answer);
} conf_library;

#ifdef __cplusplus
}
#endif

#endif
