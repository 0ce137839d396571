/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The life of the library in a process, one mode a run, since Kokkos starts once in a process:
 *   quiet          nothing is printed
 *   abandon        the process ends with live handles and views
 *   shutdown       everything may be destroyed late; later calls say so
 *   fork N         the child of a process with N threads
 *   limit          memory that the system refuses
 *   parallel       calls from inside the host's own OpenMP region
 * Exit status 0, or the number of the line that failed modulo 256. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <connectivity_boundary.h>
#include <connectivity_gravity.h>
#include <connectivity_lists.h>
#include <connectivity_query.h>

enum { side = 12, n = side * side, n_pairs = 2 * side * (side - 1) };

#define REQUIRE(condition)                                                \
    do {                                                                  \
        if (!(condition)) exit(__LINE__ % 256 == 0 ? 1 : __LINE__ % 256); \
    } while (0)

typedef struct host {
    conn_context* context;
    conn_nodes* nodes;
    conn_map *map, *with_ghosts;
    conn_boundaries* boundaries;
    conn_pair_field* field;
    conn_query* query;
    conn_rows_view rows;
    conn_pairs_view pairs;
    conn_intersection_view common;
    conn_tree* tree;
    conn_lists* lists;
    conn_tree_view boxes;
    conn_box_list_view direct;
    conn_classes_view classes;
    conn_gravity* gravity;
    conn_gravity_view forces;
} host;

/* A square lattice of spacing 1 with supports of 1.2. */
static conn_status set_nodes(host* h) {
    double x[n][2];
    const double length = 0.6;
    for (int i = 0; i < n; ++i) x[i][0] = i % side, x[i][1] = i / side;
    const conn_array positions = conn_array_matrix(&x[0][0], n, 2);
    conn_array lengths = conn_array_vector(&length, n);
    lengths.stride[0] = 0;
    return conn_nodes_set_h(h->nodes, n, &positions, 1, &lengths);
}

/* A box tree of the lattice. */
static conn_status build_tree(host* h) {
    double x[n][2];
    for (int i = 0; i < n; ++i) x[i][0] = i % side, x[i][1] = i / side;
    const conn_array positions = conn_array_matrix(&x[0][0], n, 2);
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    conn_tree_options options = CONN_TREE_OPTIONS_INIT;
    input.dim = 2;
    input.sources = &positions;
    options.max_particles_in_box = 4;
    return conn_tree_build(h->tree, &input, &options);
}

/* Forces of the lattice, by cells. */
static conn_status solve(host* h) {
    double x[n][2];
    const double one = 1;
    conn_array masses = conn_array_vector(&one, n);
    conn_gravity_options options = CONN_GRAVITY_OPTIONS_INIT;
    for (int i = 0; i < n; ++i) x[i][0] = i % side, x[i][1] = i / side;
    const conn_array positions = conn_array_matrix(&x[0][0], n, 2);
    masses.stride[0] = 0;
    options.method = CONN_GRAVITY_FMM;
    return conn_gravity_solve(h->gravity, &positions, 1, &masses, NULL, &options);
}

static conn_status rebuild(host* h) {
    conn_nodes* lists[] = {h->nodes};
    return conn_map_rebuild(h->map, lists, 1);
}

/* Ghosts beyond a wall, common neighbours, and a field whose sum wants the pair of every row entry.
 */
static void start_ghosts(host* h) {
    conn_nodes* lists[] = {h->nodes};
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    const double wall[] = {-0.5, 0, 1, 0};
    double sums[2 * n];
    options.intersection = CONN_INTERSECTION_ALL;
    REQUIRE(conn_map_create(h->context, &options, &h->with_ghosts) == CONN_OK);
    REQUIRE(conn_boundaries_create(h->context, 2, &h->boundaries) == CONN_OK);
    REQUIRE(conn_boundaries_add(h->boundaries, CONN_BOUNDARY_REFLECTING, "wall", wall, 1) ==
            CONN_OK);
    REQUIRE(conn_boundaries_update(h->boundaries, h->with_ghosts, lists, 1, CONN_GHOSTS_KEEP) ==
            CONN_OK);
    REQUIRE(conn_map_intersection_acquire(h->with_ghosts, CONN_SPACE_HOST, &h->common) == CONN_OK);
    REQUIRE(h->common.n_pairs > n_pairs);
    REQUIRE(conn_query_create(h->context, &h->query) == CONN_OK);
    REQUIRE(conn_query_update(h->query, lists, 1, NULL) == CONN_OK);
    REQUIRE(conn_pair_field_create(h->with_ghosts, 1, &h->field) == CONN_OK);
    REQUIRE(conn_pair_field_sum(h->field, h->with_ghosts, CONN_SYMMETRIC, CONN_SUM_DETERMINISTIC,
                                sums, 2 * n) == CONN_OK);
}

/* Interaction lists, with views of all kinds. */
static void start_lists(host* h) {
    REQUIRE(conn_tree_create(h->context, &h->tree) == CONN_OK);
    REQUIRE(conn_lists_create(h->context, &h->lists) == CONN_OK);
    REQUIRE(build_tree(h) == CONN_OK);
    REQUIRE(conn_lists_rebuild(h->lists, h->tree, NULL) == CONN_OK);
    REQUIRE(conn_tree_acquire(h->tree, CONN_SPACE_HOST, &h->boxes) == CONN_OK);
    REQUIRE(conn_lists_acquire(h->lists, CONN_LIST_NEIGHBOR_SOURCE_BOXES, 0, CONN_SPACE_HOST,
                               &h->direct) == CONN_OK);
    REQUIRE(conn_lists_classes_acquire(h->lists, CONN_CLASSES_TRANSLATION, CONN_SPACE_HOST,
                                       &h->classes) == CONN_OK);
    REQUIRE(h->boxes.n_sources == n && h->direct.n_entries > 0);
}

static void start_gravity(host* h) {
    REQUIRE(conn_gravity_create(h->context, &h->gravity) == CONN_OK);
    REQUIRE(solve(h) == CONN_OK);
    REQUIRE(conn_gravity_acquire(h->gravity, CONN_SPACE_HOST, &h->forces) == CONN_OK);
    REQUIRE(h->forces.n == n && h->forces.potential[0] < 0);
}

static void finish_lists(host* h) {
    REQUIRE(conn_tree_destroy(&h->tree) == CONN_OK && h->tree == NULL);
    REQUIRE(conn_lists_destroy(&h->lists) == CONN_OK && h->lists == NULL);
    REQUIRE(conn_tree_release(&h->boxes) == CONN_OK && h->boxes.box_flags == NULL);
    REQUIRE(conn_box_list_release(&h->direct) == CONN_OK && h->direct.lists == NULL);
    REQUIRE(conn_lists_classes_release(&h->classes) == CONN_OK && h->classes.classes == NULL);
}

static host start(int n_threads) {
    host h = {NULL,
              NULL,
              NULL,
              NULL,
              NULL,
              NULL,
              NULL,
              CONN_ROWS_VIEW_INIT,
              CONN_PAIRS_VIEW_INIT,
              CONN_INTERSECTION_VIEW_INIT,
              NULL,
              NULL,
              CONN_TREE_VIEW_INIT,
              CONN_BOX_LIST_VIEW_INIT,
              CONN_CLASSES_VIEW_INIT,
              NULL,
              CONN_GRAVITY_VIEW_INIT};
    uint8_t active[n];
    conn_map_options map_options = CONN_MAP_OPTIONS_INIT;
    memset(active, 1, sizeof active);
    map_options.active = active;
    map_options.n_active = n;
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.n_threads = n_threads;
    REQUIRE(conn_context_create(&options, &h.context) == CONN_OK);
    REQUIRE(conn_nodes_create(h.context, "lattice", 2, 2.0, &h.nodes) == CONN_OK);
    REQUIRE(conn_map_create(h.context, &map_options, &h.map) == CONN_OK);
    REQUIRE(set_nodes(&h) == CONN_OK);
    REQUIRE(rebuild(&h) == CONN_OK);
    REQUIRE(conn_map_rows_acquire(h.map, CONN_SPACE_HOST, &h.rows) == CONN_OK);
    REQUIRE(conn_map_pairs_acquire(h.map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, &h.pairs) == CONN_OK);
    REQUIRE(h.rows.n_entries == 2 * n_pairs);
    REQUIRE(h.pairs.n_pairs == n_pairs);
    start_ghosts(&h);
    start_lists(&h);
    start_gravity(&h);
    return h;
}

static void finish(host* h) {
    finish_lists(h);
    REQUIRE(conn_gravity_destroy(&h->gravity) == CONN_OK && h->gravity == NULL);
    REQUIRE(conn_gravity_release(&h->forces) == CONN_OK && h->forces.potential == NULL);
    REQUIRE(conn_map_rows_release(&h->rows) == CONN_OK && h->rows.slots == NULL);
    REQUIRE(conn_map_pairs_release(&h->pairs) == CONN_OK && h->pairs.j == NULL);
    REQUIRE(conn_map_intersection_release(&h->common) == CONN_OK && h->common.slots == NULL);
    REQUIRE(conn_query_destroy(&h->query) == CONN_OK && h->query == NULL);
    REQUIRE(conn_pair_field_destroy(&h->field) == CONN_OK && h->field == NULL);
    REQUIRE(conn_boundaries_destroy(&h->boundaries) == CONN_OK && h->boundaries == NULL);
    REQUIRE(conn_map_destroy(&h->with_ghosts) == CONN_OK && h->with_ghosts == NULL);
    REQUIRE(conn_map_destroy(&h->map) == CONN_OK && h->map == NULL);
    REQUIRE(conn_nodes_destroy(&h->nodes) == CONN_OK && h->nodes == NULL);
    REQUIRE(conn_context_destroy(&h->context) == CONN_OK && h->context == NULL);
}

/* Every kind of call says the same. */
static void require_all(host* h, conn_status expected) {
    uint64_t generation = 0;
    int64_t count = 0;
    int32_t n_failed = 0;
    conn_context* context = NULL;
    conn_map* map = NULL;
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    conn_tree_view boxes = CONN_TREE_VIEW_INIT;
    conn_gravity_view forces = CONN_GRAVITY_VIEW_INIT;
    conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
    conn_estimate estimate = CONN_ESTIMATE_INIT;
    const double one = 1;
    double out = 0;
    const int32_t zero = 0;
    const conn_array array = conn_array_vector(&one, 1);
    REQUIRE(conn_context_create(NULL, &context) == expected && context == NULL);
    REQUIRE(conn_map_create(h->context, NULL, &map) == expected && map == NULL);
    REQUIRE(set_nodes(h) == expected);
    REQUIRE(rebuild(h) == expected);
    REQUIRE(strstr(conn_last_error(), "conn_map_rebuild: ") != NULL);
    REQUIRE(conn_map_generation(h->map, &generation) == expected);
    REQUIRE(conn_map_pairs_acquire(h->map, CONN_SPACE_HOST, 0, &pairs) == expected);
    REQUIRE(conn_map_validate(h->map, &h->nodes, 1, &n_failed, NULL, 0, NULL) == expected);
    REQUIRE(conn_query_update(h->query, &h->nodes, 1, NULL) == expected);
    REQUIRE(conn_query_neighbours(h->query, 0, CONN_GATHER, NULL, 0, &count) == expected);
    REQUIRE(build_tree(h) == expected);
    REQUIRE(conn_tree_acquire(h->tree, CONN_SPACE_HOST, &boxes) == expected);
    REQUIRE(conn_lists_rebuild(h->lists, h->tree, NULL) == expected);
    REQUIRE(conn_lists_work(h->lists, CONN_WORK_M2L, NULL, 0, &count, NULL) == expected);
    REQUIRE(solve(h) == expected);
    REQUIRE(conn_gravity_acquire(h->gravity, CONN_SPACE_HOST, &forces) == expected);
    REQUIRE(conn_gravity_get_info(h->gravity, &info) == expected);
    REQUIRE(conn_gravity_copy(h->gravity, NULL, 0, NULL, NULL) == expected);
    REQUIRE(conn_gravity_release_scratch(h->gravity) == expected);
    REQUIRE(conn_map_estimate(h->map, &h->nodes, 1, &estimate) == expected);
    REQUIRE(conn_map_memory(h->map, CONN_SPACE_HOST, &count, NULL) == expected);
    REQUIRE(conn_map_rows_copy(h->map, NULL, 0, &count, NULL, 0, &count) == expected);
    REQUIRE(conn_map_pairs_copy(h->map, NULL, NULL, NULL, 0, &count) == expected);
    REQUIRE(conn_context_set_log(h->context, CONN_LOG_NONE, NULL, NULL) == expected);
    REQUIRE(conn_reorder(&array, &zero, 1, 0, &out) == expected);
    REQUIRE(conn_pair_field_reset(h->field, h->with_ghosts) == expected);
    REQUIRE(conn_map_set_coupling(h->map, NULL, 0) == expected);
    REQUIRE(conn_boundaries_update(h->boundaries, h->map, &h->nodes, 1, CONN_GHOSTS_CULL) ==
            expected);
}

static void late_destroy(void) {
    REQUIRE(conn_shutdown() == CONN_OK); /* nothing was started: nothing to stop */
    host h = start(2);
    REQUIRE(conn_shutdown() == CONN_OK);
    require_all(&h, CONN_E_FINALIZED);
    REQUIRE(conn_shutdown() == CONN_OK);
    finish(&h);
}

static void child(host* h, int n_threads) {
    if (n_threads == 1) {
        REQUIRE(rebuild(h) == CONN_OK && build_tree(h) == CONN_OK && solve(h) == CONN_OK);
        finish(h);
        _exit(0);
    }
    require_all(h, CONN_E_FORKED);
    REQUIRE(conn_shutdown() == CONN_E_FORKED);
    finish(h);
    _exit(0);
}

static void fork_with(int n_threads) {
    host h = start(n_threads);
    const pid_t pid = fork();
    REQUIRE(pid >= 0);
    if (pid == 0) {
        alarm(20); /* a kernel that waits for lost threads would wait for ever */
        child(&h, n_threads);
    }
    int status = -1;
    REQUIRE(waitpid(pid, &status, 0) == pid && WIFEXITED(status));
    if (WEXITSTATUS(status) != 0) exit(WEXITSTATUS(status));
    REQUIRE(rebuild(&h) == CONN_OK);
    finish(&h);
}

/* 24 GB where 2 GiB are allowed. */
static void limit(void) {
    host h = start(2);
    const int64_t n_huge = 1000000000;
    const double one = 1;
    conn_array positions = conn_array_matrix(&one, n_huge, 2);
    conn_array lengths = conn_array_vector(&one, n_huge);
    struct rlimit memory;
    positions.stride[0] = positions.stride[1] = lengths.stride[0] = 0;
    REQUIRE(getrlimit(RLIMIT_AS, &memory) == 0);
    memory.rlim_cur = (rlim_t)2 << 30;
    REQUIRE(setrlimit(RLIMIT_AS, &memory) == 0);
    REQUIRE(conn_nodes_set_h(h.nodes, n_huge, &positions, 1, &lengths) == CONN_E_MEMORY);
    REQUIRE(conn_last_error()[0] != '\0');
    REQUIRE(rebuild(&h) == CONN_OK);
    finish(&h);
}

static void parallel(void) {
    int n_right = 0;
#pragma omp parallel num_threads(3) reduction(+ : n_right)
    for (int k = 0; k < 5; ++k) {
        host h = start(0);
        ++n_right;
        finish(&h);
    }
    REQUIRE(n_right >= 5 && n_right % 5 == 0);
    host h = start(0);
    finish(&h);
}

int main(int argc, char** argv) {
    const char* mode = argc > 1 ? argv[1] : "";
    if (strcmp(mode, "quiet") == 0) {
        host h = start(2);
        finish(&h);
    } else if (strcmp(mode, "abandon") == 0) {
        start(2);
    } else if (strcmp(mode, "shutdown") == 0) {
        late_destroy();
    } else if (strcmp(mode, "fork") == 0 && argc > 2) {
        fork_with(atoi(argv[2]));
    } else if (strcmp(mode, "limit") == 0) {
        limit();
    } else if (strcmp(mode, "parallel") == 0) {
        parallel();
    } else {
        return 2;
    }
    return 0;
}
