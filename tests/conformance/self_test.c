/* SPDX-License-Identifier: BSD-3-Clause */
/* Libraries with a known defect each, and the verdict that they must get. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"

static double distance2(const conf_nodes* nodes, int64_t i, int64_t j) {
    double r2 = 0;
    for (int d = 0; d < nodes->dim; ++d) {
        const double dx = nodes->x[i * nodes->dim + d] - nodes->x[j * nodes->dim + d];
        r2 += dx * dx;
    }
    return r2;
}

static double reach2(const conf_nodes* nodes, int64_t i, int64_t j) {
    const double R = fmax(nodes->radius[i], nodes->radius[j]);
    return R * R;
}

static void takes_the_open_ball(const conf_nodes* nodes, conf_answer* answer) {
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int64_t j = i + 1; j < nodes->n; ++j)
            if (distance2(nodes, i, j) < reach2(nodes, i, j)) conf_add_pair(answer, i, j);
}

static void sees_its_own_support_only(const conf_nodes* nodes, conf_answer* answer) {
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int64_t j = i + 1; j < nodes->n; ++j)
            if (distance2(nodes, i, j) <= nodes->radius[i] * nodes->radius[i])
                conf_add_pair(answer, i, j);
}

static void names_other_nodes(const conf_nodes* nodes, conf_answer* answer) {
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int64_t j = i + 1; j < nodes->n; ++j)
            if (distance2(nodes, i, j) <= reach2(nodes, i, j))
                conf_add_pair(answer, nodes->n - 1 - i, j);
}

/** One neighbour twice instead of another, so that the number is right. */
static void repeats_a_neighbour(const conf_nodes* nodes, conf_answer* answer) {
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int64_t j = 0, k = 0; j < nodes->n; ++j) {
            if (j == i || distance2(nodes, i, j) > reach2(nodes, i, j)) continue;
            const int32_t named = (int32_t)(i == 0 && k++ > 0 ? 1 : j);
            conf_add_row(answer, i, &named, 1);
        }
}

static void gives_up(const conf_nodes* nodes, conf_answer* answer) {
    (void)nodes;
    conf_refuse(answer, "no");
}

static void crashes(const conf_nodes* nodes, conf_answer* answer) {
    (void)nodes, (void)answer;
    abort();
}

static void never_ends(const conf_nodes* nodes, conf_answer* answer) {
    for (volatile int64_t k = 0;; ++k)
        if (k < 0) conf_add_pair(answer, k, nodes->n);
}

static const struct {
    conf_library library;
    const char* scene;
    conf_verdict expected;
} cases[] = {
    {{"takes the open ball", 0, takes_the_open_ball}, "A10-open", CONF_WRONG},
    {{"takes the open ball", 0, takes_the_open_ball}, "A11-touching", CONF_WRONG},
    {{"takes the open ball", 0, takes_the_open_ball}, "A1-65", CONF_EXACT},
    {{"sees its own support only", 0, sees_its_own_support_only}, "A6-blind", CONF_WRONG},
    {{"sees its own support only", CONF_SAME_RADIUS_ONLY, sees_its_own_support_only},
     "A6-blind",
     CONF_CANNOT},
    {{"names other nodes", 0, names_other_nodes}, "A2-plane", CONF_WRONG},
    {{"repeats a neighbour", 0, repeats_a_neighbour}, "A2-line", CONF_WRONG},
    {{"gives up", 0, gives_up}, "A9-1.20", CONF_REFUSED},
    {{"gives up", 0, gives_up}, "A9-0.40", CONF_WRONG},
    {{"gives up", CONF_OPEN_ONLY, gives_up}, "A9-0.40", CONF_CANNOT},
    {{"gives up", CONF_THREE_D_ONLY, gives_up}, "A9-2d", CONF_CANNOT},
    {{"takes the open ball", CONF_THREE_D_ONLY, takes_the_open_ball}, "A2-1d", CONF_WRONG},
    {{"gives up", CONF_FEW_NODES, gives_up}, "W2", CONF_CANNOT},
    {{"crashes", 0, crashes}, "A11-0", CONF_CRASHED},
    {{"never ends", 0, never_ends}, "A11-1", CONF_TOO_LONG},
};

int main(void) {
    int n_failed = 0;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k)
        for (int s = 0; s < conf_n_scenes; ++s) {
            if (strcmp(conf_scenes[s].name, cases[k].scene) != 0) continue;
            const conf_result r = conf_judge(&cases[k].library, &conf_scenes[s], 1);
            if (r.verdict == cases[k].expected) continue;
            printf("%s, %s: verdict %d instead of %d (%s)\n", cases[k].library.name, cases[k].scene,
                   (int)r.verdict, (int)cases[k].expected, r.text);
            ++n_failed;
        }
    return n_failed > 0;
}
