/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file scenes.h
 * The scenes of the conformance suite and their exact answers.
 */
#ifndef CONFORMANCE_SCENES_H
#define CONFORMANCE_SCENES_H

#include "conformance.h"

/** A set of pairs in two numbers: its size, and sums over its pairs (i < j) that no order changes,
 * of mix(i, j) and of mix(j, i). */
typedef struct conf_pairs {
    int64_t count;
    uint64_t ascending, descending;
} conf_pairs;

/** Adds the pair, in whatever order it comes. */
void conf_pairs_add(conf_pairs* pairs, int64_t i, int64_t j);
uint64_t conf_pair_hash(int64_t i, int64_t j);

/** Room for a scene; x and radius are released by conf_scene_free. */
typedef struct conf_points {
    int dim;
    int64_t n;
    double *x, *radius;
    double period;
} conf_points;

typedef struct conf_scene {
    const char* name;
    const char* about; /**< what fails here elsewhere */
    int number;        /**< handed to make */
    int may_refuse;    /**< an error is as good an answer */
    /** Returns 0, or -1 without memory, or 1 if this machine makes other points than documented. */
    int (*make)(int number, conf_points* points);
    conf_pairs expected;
} conf_scene;

extern const conf_scene conf_scenes[];
extern const int conf_n_scenes;

void conf_points_free(conf_points* points);
conf_nodes conf_nodes_of(const conf_points* points);

#endif
