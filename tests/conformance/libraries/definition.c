/* SPDX-License-Identifier: BSD-3-Clause */
/* No library but the definition, all nodes with all nodes: it checks the answers that are stored.
 */
#include "../conformance.h"

#include <math.h>

static double distance2(const conf_nodes* nodes, int64_t i, int64_t j) {
    double r2 = 0;
    for (int d = 0; d < nodes->dim; ++d) {
        double dx = fabs(nodes->x[i * nodes->dim + d] - nodes->x[j * nodes->dim + d]);
        if (nodes->period > 0 && dx > nodes->period / 2) dx = nodes->period - dx;
        r2 += dx * dx;
    }
    return r2;
}

static void find_pairs(const conf_nodes* nodes, conf_answer* answer) {
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int64_t j = i + 1; j < nodes->n; ++j) {
            const double R = fmax(nodes->radius[i], nodes->radius[j]);
            if (R > 0 && distance2(nodes, i, j) <= R * R) conf_add_pair(answer, i, j);
        }
}

const conf_library conf_definition = {"definition", CONF_FEW_NODES, find_pairs};
