/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file judge.h
 * Puts a scene to a library in a process of its own, so that a crash or an endless loop is a
 * verdict like any other.
 */
#ifndef CONFORMANCE_JUDGE_H
#define CONFORMANCE_JUDGE_H

#include "scenes.h"

typedef enum conf_verdict {
    CONF_EXACT,     /**< exactly the pairs */
    CONF_REFUSED,   /**< an error, where it is as good an answer */
    CONF_CANNOT,    /**< not put to it: beyond what the library claims */
    CONF_NO_POINTS, /**< this machine makes other points */
    CONF_WRONG,     /**< other pairs, or an error where none is due */
    CONF_CRASHED,
    CONF_TOO_LONG
} conf_verdict;

typedef struct conf_result {
    conf_verdict verdict;
    double seconds; /**< of find_pairs, without the making of the points */
    char text[160]; /**< for people: what was found instead, why it was refused */
} conf_result;

/** Any verdict from CONF_WRONG on is a failure. */
int conf_failed(conf_verdict verdict);

/** limit: seconds the library may take. */
conf_result conf_judge(const conf_library* library, const conf_scene* scene, int limit);

#endif
