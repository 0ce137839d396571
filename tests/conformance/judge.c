/* SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include "judge.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

struct conf_answer {
    conf_pairs pairs;     /* of conf_add_pair */
    int64_t n_neighbours; /* of conf_add_row */
    uint64_t neighbours;
    int refused;
    char reason[120];
};

void conf_add_pair(conf_answer* answer, int64_t i, int64_t j) {
    conf_pairs_add(&answer->pairs, i, j);
}

void conf_add_row(conf_answer* answer, int64_t i, const int32_t* neighbours, int64_t n) {
    answer->n_neighbours += n;
    for (int64_t k = 0; k < n; ++k) answer->neighbours += conf_pair_hash(i, neighbours[k]);
}

void conf_refuse(conf_answer* answer, const char* reason) {
    answer->refused = 1;
    snprintf(answer->reason, sizeof answer->reason, "%s", reason);
}

int conf_failed(conf_verdict verdict) { return verdict >= CONF_WRONG; }

static conf_result result_of(conf_verdict verdict, const char* text) {
    conf_result result = {CONF_EXACT, 0, ""};
    result.verdict = verdict;
    snprintf(result.text, sizeof result.text, "%s", text);
    return result;
}

/** Rows hold each pair from both sides. */
static conf_result compare(const conf_answer* answer, const conf_scene* scene) {
    const conf_pairs* const want = &scene->expected;
    const int rows = answer->n_neighbours > 0;
    const int64_t count = rows ? answer->n_neighbours : answer->pairs.count,
                  wanted = rows ? 2 * want->count : want->count;
    char text[160];
    if (answer->refused)
        return result_of(scene->may_refuse ? CONF_REFUSED : CONF_WRONG, answer->reason);
    if (count != wanted) {
        snprintf(text, sizeof text, "%lld %s instead of %lld", (long long)count,
                 rows ? "neighbours" : "pairs", (long long)wanted);
        return result_of(CONF_WRONG, text);
    }
    const int same = rows ? answer->neighbours == want->ascending + want->descending
                          : answer->pairs.ascending == want->ascending &&
                                answer->pairs.descending == want->descending;
    return result_of(same ? CONF_EXACT : CONF_WRONG, same ? "" : "as many, but other pairs");
}

/** Makes room for nodes with three components, the last ones 0. Returns -1 without memory. */
static int lift(conf_points* p) {
    double* const x = (double*)calloc((size_t)p->n * 3 + 1, sizeof(double));
    if (x == NULL) return -1;
    for (int64_t i = 0; i < p->n; ++i)
        for (int d = 0; d < p->dim; ++d) x[3 * i + d] = p->x[p->dim * i + d];
    free(p->x);
    p->x = x;
    p->dim = 3;
    return 0;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/** Why the nodes are not put to a library with such limits; NULL if they are. */
static const char* beyond(int limits, const conf_nodes* nodes) {
    if (!nodes->same_radius && (limits & CONF_SAME_RADIUS_ONLY) != 0) return "one support for all";
    if (nodes->period > 0 && (limits & CONF_OPEN_ONLY) != 0) return "no periodic boxes";
    if (nodes->dim < 3 && (limits & CONF_THREE_D_ONLY) != 0) return "three dimensions only";
    if (nodes->n > 25000 && (limits & CONF_FEW_NODES) != 0) return "25 000 nodes at most";
    return NULL;
}

static conf_result ask(const conf_library* library, const conf_scene* scene,
                       const conf_nodes* nodes, int limit) {
    conf_answer answer;
    memset(&answer, 0, sizeof answer);
    alarm((unsigned)limit);
    const double begun = now();
    library->find_pairs(nodes, &answer);
    const double ended = now();
    alarm(0);
    conf_result result = compare(&answer, scene);
    result.seconds = ended - begun;
    return result;
}

static conf_result judge_here(const conf_library* library, const conf_scene* scene, int limit) {
    conf_points points = {0, 0, NULL, NULL, 0};
    int made = scene->make(scene->number, &points);
    if (made == 0 && points.dim < 3 && (library->limits & CONF_THREE_D_ONLY) != 0 &&
        points.period == 0)
        made = lift(&points);
    if (made != 0)
        return result_of(CONF_NO_POINTS, made < 0 ? "no memory for the points"
                                                  : "the mathematics library makes other points");
    const conf_nodes nodes = conf_nodes_of(&points);
    const char* const reason = beyond(library->limits, &nodes);
    const conf_result result =
        reason != NULL ? result_of(CONF_CANNOT, reason) : ask(library, scene, &nodes, limit);
    conf_points_free(&points);
    return result;
}

static conf_result verdict_on_death(int status, int limit) {
    char text[160];
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
        snprintf(text, sizeof text, "no answer in %d s", limit);
        return result_of(CONF_TOO_LONG, text);
    }
    if (WIFSIGNALED(status))
        snprintf(text, sizeof text, "signal %d", WTERMSIG(status));
    else
        snprintf(text, sizeof text, "the process ended with %d", WEXITSTATUS(status));
    return result_of(CONF_CRASHED, text);
}

conf_result conf_judge(const conf_library* library, const conf_scene* scene, int limit) {
    int ends[2];
    if (pipe(ends) != 0) return result_of(CONF_NO_POINTS, "no pipe");
    const pid_t child = fork();
    if (child < 0) {
        close(ends[0]);
        close(ends[1]);
        return result_of(CONF_NO_POINTS, "no process");
    }
    if (child == 0) {
        close(ends[0]);
        const int quiet = open("/dev/null", O_WRONLY); /* what libraries print */
        if (quiet >= 0) dup2(quiet, STDOUT_FILENO), dup2(quiet, STDERR_FILENO);
        const conf_result result = judge_here(library, scene, limit);
        const ssize_t written = write(ends[1], &result, sizeof result);
        _exit(written == (ssize_t)sizeof result ? 0 : 1);
    }
    close(ends[1]);
    conf_result result;
    const ssize_t got = read(ends[0], &result, sizeof result);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return got == (ssize_t)sizeof result ? result : verdict_on_death(status, limit);
}
