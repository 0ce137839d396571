/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_tree.h
 * EXPERIMENTAL: box trees, adaptive 2^dim trees whose leaves hold few particles.
 *
 * Not part of connectivity.h and of its promise: until hosts have used them, these functions may
 * change or go in any version. Hosts that want them include this header; errors, handles and
 * threads are as connectivity.h says.
 *
 * Boxes, particles and levels count from 0. Box 0 is the root, boxes are numbered level by level, a
 * parent before its children. Names are those of boxtree,
 * https://documen.tician.de/boxtree/tree.html
 */
#ifndef CONNECTIVITY_TREE_H
#define CONNECTIVITY_TREE_H

#include "connectivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Building a tree */
/**@{*/
typedef struct conn_tree conn_tree;

enum {                                 /* Which boxes are split. */
       CONN_TREE_ADAPTIVE = 0,         /**< those over the limit */
       CONN_TREE_LEVEL_RESTRICTED = 1, /**< and leaves that touch one more than a level finer */
       CONN_TREE_NON_ADAPTIVE = 2      /**< all of the last level while one of them is */
};
enum { /* Where a particle with a radius must stay to be handed to a child box. */
       CONN_EXTENT_NONE = 0, /**< in a view: no particle has a radius */
       CONN_EXTENT_LINF = 1, /**< the child's cube, enlarged by 1 + stick_out_factor */
       CONN_EXTENT_L2 = 2    /**< the ball around that cube */
};
enum {                            /* More particles at one place than a leaf may hold. */
       CONN_COINCIDENT_ERROR = 0, /**< CONN_E_ARGUMENT, which names two of them */
       CONN_COINCIDENT_LEAF = 1   /**< a leaf over the limit */
};
enum {                           /* Hulls of each box's particles. */
       CONN_HULLS_AUTOMATIC = 0, /**< where particles have radii */
       CONN_HULLS_ALWAYS = 1,
       CONN_HULLS_NEVER = 2
};

typedef struct conn_tree_options {
    size_t struct_size;
    int32_t kind;                   /**< CONN_TREE_ADAPTIVE, ... */
    int32_t max_particles_in_box;   /**< the limit, at least 1; or -1: not given, and the next one
                                         is. Exactly one of the two must be given */
    int32_t max_leaf_refine_weight; /**< the limit of the sum of refine_weights, or -1 */
    int32_t extent_norm;            /**< CONN_EXTENT_LINF or CONN_EXTENT_L2 */
    double stick_out_factor;        /**< share of a box's half width by which a particle may stick
                                         out of it; to be given where there are radii, and only
                                         there; -1: not given */
    int32_t coincident;             /**< CONN_COINCIDENT_ERROR, ... */
    int32_t hulls;                  /**< CONN_HULLS_AUTOMATIC, ... */
    int32_t skip_prune;             /**< 1: keep boxes without particles */
    int32_t bounding_box;           /**< 1: the root box is from box_lo to box_hi */
    double box_lo[3];               /**< a cube (to rounding) that holds all particles with their
                                         radii; along periodic axes only their centres */
    double box_hi[3];
    int32_t periodic[3];  /**< 1: the root box repeats along this axis */
    int32_t reserved;     /**< 0 */
    int64_t budget_bytes; /**< 0: that of the context */
} conn_tree_options;
#define CONN_TREE_OPTIONS_INIT                                                                    \
    {                                                                                             \
        sizeof(conn_tree_options), 0, -1, -1, 1, -1, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, \
            0, 0                                                                                  \
    }

/** Arrays of particles, read during the call only. Positions are one array [n, dim], or dim arrays
 * [n]; all positions and radii are CONN_FLOAT64, or all CONN_FLOAT32. Arrays that are no one array
 * with steps upwards are copied once. */
typedef struct conn_tree_input {
    size_t struct_size;
    int32_t dim;       /**< 1, 2 or 3 */
    int32_t n_sources; /**< arrays in sources: 1 or dim */
    int32_t n_targets; /**< arrays in targets: 1 or dim */
    int32_t reserved;  /**< 0 */
    const conn_array* sources;
    const conn_array* targets;        /**< NULL: the sources are the targets */
    const conn_array* source_radii;   /**< [n], >= 0; NULL: points. Radii of either kind need
                                           separate targets */
    const conn_array* target_radii;   /**< [n] */
    const conn_array* refine_weights; /**< [sources and targets], whole numbers in [0,
                                           max_leaf_refine_weight], sources first; NULL unless that
                                           is given */
} conn_tree_input;
#define CONN_TREE_INPUT_INIT \
    { sizeof(conn_tree_input), 3, 1, 1, 0, NULL, NULL, NULL, NULL, NULL }

/** The defaults, for hosts that cannot use CONN_TREE_OPTIONS_INIT; size: that of the struct. */
CONN_API conn_status conn_tree_options_init(conn_tree_options* options, size_t size);
/** Without boxes. */
CONN_API conn_status conn_tree_create(conn_context* context, conn_tree** tree);
/** Ends it; *tree becomes NULL. Views and interaction lists stay. NULL is fine, and so is *tree
 * NULL. */
CONN_API conn_status conn_tree_destroy(conn_tree** tree);
/** Builds the tree of these particles; if it fails, the old one stays. Options must give a limit.
 * CONN_E_ARGUMENT (sizes, limits, weights, coincident particles), CONN_E_NONFINITE, CONN_E_SUPPORT
 * (a radius), CONN_E_BOX (no cube, a particle outside), CONN_E_TOO_MANY (2^31 particles or boxes,
 * more than 254 levels), CONN_E_BUDGET, CONN_E_MEMORY. */
CONN_API conn_status conn_tree_build(conn_tree* tree, const conn_tree_input* input,
                                     const conn_tree_options* options);
/** Bytes of the tree, and of what it keeps for the next build. Either may be NULL. */
CONN_API conn_status conn_tree_memory(const conn_tree* tree, int64_t* bytes,
                                      int64_t* scratch_bytes);
/** Gives back what the tree keeps for the next build. */
CONN_API conn_status conn_tree_release_scratch(conn_tree* tree);
/** A table for people: milliseconds and bytes of the parts of the last build, *length bytes without
 * the final NUL. With text NULL only *length is set; CONN_E_BUFFER, which sets it too, if capacity
 * is not larger. */
CONN_API conn_status conn_tree_report_text(const conn_tree* tree, char* text, int64_t capacity,
                                           int64_t* length);
/**@}*/

/** @name Its arrays
 * A view is pinned: its arrays stay valid and unchanged until it is released, through builds and
 * the end of the tree. Arrays of length 0 may be NULL. */
/**@{*/
enum { /* Bits of box_flags. */
       CONN_BOX_HAS_OWN_SOURCES = 1,
       CONN_BOX_HAS_OWN_TARGETS = 2,
       CONN_BOX_HAS_CHILD_SOURCES = 4,
       CONN_BOX_HAS_CHILD_TARGETS = 8
};

/** A box's own particles are those that were not handed to a child. Particles are in depth-first
 * order, a box's own before those of its children. Child number of a box: bit d of dim from the
 * highest is axis d. Where the sources are the targets, both names have the same arrays. */
typedef struct conn_tree_view {
    size_t struct_size;
    int64_t n_sources;
    int64_t n_targets;
    int64_t n_boxes;
    int64_t aligned_n_boxes; /**< rounded up to 32 */
    uint64_t generation;     /**< of this build; no two of a process have the same */
    int32_t dim;
    int32_t n_levels;
    int32_t coordinates; /**< CONN_FLOAT64 or CONN_FLOAT32: the type that particles had; all arrays
                              here are double */
    int32_t sources_are_targets;
    int32_t extent_norm; /**< CONN_EXTENT_NONE, ... */
    int32_t space;
    int32_t device_id;
    int32_t periodic[3];
    double stick_out_factor;
    double root_extent;         /**< side of the root box; a box at level l has half width
                                     root_extent / 2^(l+1) */
    double bounding_box_min[3]; /**< of the root box */
    double bounding_box_max[3];

    const int32_t* level_start_box_nrs; /**< [n_levels + 1] */
    const int32_t* box_parent_ids;      /**< [n_boxes], 0 for the root too */
    const int32_t* box_child_ids;       /**< [2^dim][aligned_n_boxes], 0: no such child */
    const double* box_centers;          /**< [dim][aligned_n_boxes] */
    const uint8_t* box_levels;          /**< [n_boxes] */
    const uint8_t* box_flags;           /**< [n_boxes] bits of CONN_BOX_HAS_* */

    const double* sources;                     /**< [dim][n_sources] in tree order */
    const double* source_radii;                /**< [n_sources], NULL: points */
    const int32_t* user_source_ids;            /**< [n_sources] the host's index of each */
    const int32_t* box_source_starts;          /**< [n_boxes] sources before the box's first one */
    const int32_t* box_source_counts_nonchild; /**< [n_boxes] its own */
    const int32_t* box_source_counts_cumul;    /**< [n_boxes] those of boxes below, too */
    const double* box_source_bounding_box_min; /**< [dim][aligned_n_boxes] hull of the box centre,
                                                    of x - r and x + r of all these; NULL: none */
    const double* box_source_bounding_box_max;
    const double* targets; /**< the same of targets */
    const double* target_radii;
    const int32_t* sorted_target_ids; /**< [n_targets] tree index of each of the host's */
    const int32_t* box_target_starts;
    const int32_t* box_target_counts_nonchild;
    const int32_t* box_target_counts_cumul;
    const double* box_target_bounding_box_min;
    const double* box_target_bounding_box_max;
    void* owner; /**< private */
} conn_tree_view;
#define CONN_TREE_VIEW_INIT                                                                     \
    {                                                                                           \
        sizeof(conn_tree_view), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, {0, 0, 0}, 0, 0, {0, 0, 0}, \
            {0, 0, 0}, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,  \
            NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL                    \
    }

/** Pins the tree in the given space. view must be initialised and not hold another one.
 * CONN_E_NOT_BUILT before the first build. */
CONN_API conn_status conn_tree_acquire(const conn_tree* tree, int32_t space, conn_tree_view* view);
/** Lets go of the tree; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_tree_release(conn_tree_view* view);

/** Takes the boxes of another tree instead of building one: of a tree without particles, or one
 * that is spread over ranks. Read from boxes are dim, n_boxes, aligned_n_boxes, n_levels,
 * n_sources, n_targets, coordinates, sources_are_targets, extent_norm, periodic, stick_out_factor,
 * root_extent, bounding_box_min; the six arrays of boxes, all of them needed; and, where not NULL,
 * radii, counts and hulls of particles: what interaction lists look at. Copied; if it fails, the
 * old tree stays. CONN_E_ARGUMENT for arrays that contradict each other. */
CONN_API conn_status conn_tree_set_boxes(conn_tree* tree, const conn_tree_view* boxes);
/**@}*/

/** @name Lists of boxes
 * What lookups here and interaction lists of connectivity_lists.h come in: row r is
 * lists[starts[r] .. starts[r+1]). Pinned as the view of a tree. */
/**@{*/
typedef struct conn_box_list_view {
    size_t struct_size;
    int64_t n_rows;
    int64_t n_entries;
    uint64_t generation; /**< of the tree that the list was made from */
    int32_t is_none;     /**< 1: a tree like this has no such list; n_rows and n_entries are 0 */
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int64_t* starts;           /**< [n_rows + 1] */
    const int32_t* lists;            /**< [n_entries] */
    const uint8_t* images;           /**< [n_entries] which repetition of the root box the entry
                                          lies in: (sx+1)*9 + (sy+1)*3 + (sz+1) with shifts of -1, 0
                                          or 1 root extents; NULL: all 13, no shift */
    const int32_t* row_boxes;        /**< [n_rows] the box of each row; NULL: see the function */
    const int32_t* nonempty_indices; /**< [n_rows] of CONN_LIST_FROM_SEP_SMALLER: index of row_boxes
                                          in the target boxes; otherwise NULL */
    void* owner;                     /**< private */
} conn_box_list_view;
#define CONN_BOX_LIST_VIEW_INIT \
    { sizeof(conn_box_list_view), 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL }

/** Lets go of the list; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_box_list_release(conn_box_list_view* view);
/**@}*/

/** @name Lookups
 * Results are pinned as the view of a tree; CONN_E_NOT_BUILT before the first build. Balls are
 * those of the maximum norm: cubes around centers, one array [n, dim] or dim arrays [n], of half
 * width radii [n]; they may lie outside of the root box, and periodic faces do not wrap. A leaf is
 * a box that was never split. CONN_E_NONFINITE and CONN_E_SUPPORT name the first bad ball. */
/**@{*/
/** Row b: the peers of box b in depth-first order: the smallest boxes, none smaller than itself,
 * that touch or hold it and together cover what lies around it. */
CONN_API conn_status conn_tree_peers(const conn_tree* tree, conn_box_list_view* view);
/** Row k: the leaves that ball k touches or meets, in depth-first order. */
CONN_API conn_status conn_tree_area_query(const conn_tree* tree, const conn_array* centers,
                                          int32_t n_centers, const conn_array* radii,
                                          conn_box_list_view* view);
/** Row b: the balls, ascending, that touch or meet leaf b; none for other boxes. */
CONN_API conn_status conn_tree_leaves_to_balls(const conn_tree* tree, const conn_array* centers,
                                               int32_t n_centers, const conn_array* radii,
                                               conn_box_list_view* view);
/** distances [n_boxes]: how far the centres of the balls that touch a leaf are from its centre at
 * most, in the maximum norm; 0 without such balls and for other boxes. With distances NULL only
 * *count is set; CONN_E_BUFFER, which sets it too, if capacity is smaller. */
CONN_API conn_status conn_tree_space_invader(const conn_tree* tree, const conn_array* centers,
                                             int32_t n_centers, const conn_array* radii,
                                             double* distances, int64_t capacity, int64_t* count);
/** flags [n_flags], one for each target in the order of the host, not 0: keep. Row b: the host's
 * indices of the kept own targets of box b, in tree order. */
CONN_API conn_status conn_tree_filter_targets(const conn_tree* tree, const uint8_t* flags,
                                              int64_t n_flags, conn_box_list_view* view);

typedef struct conn_particles_view {
    size_t struct_size;
    int64_t n;
    int64_t n_boxes;
    int64_t n_sources;   /**< of starts and counts: sources of the tree, 0 where these are NULL */
    uint64_t generation; /**< of the tree */
    int32_t dim;
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int32_t* ids;                 /**< [n] kept targets: tree index of each; point sources:
                                             the host's index of each */
    const int32_t* box_starts;          /**< [n_boxes] as in conn_tree_view, and so on */
    const int32_t* box_counts_nonchild; /**< [n_boxes] */
    const int32_t* box_counts_cumul;    /**< [n_boxes]; NULL of kept targets */
    const double* positions;            /**< [dim][n]; NULL of kept targets */
    const int32_t* starts;              /**< [n_sources] first point source of each source in tree
                                             order; NULL of kept targets */
    const int32_t* counts;              /**< [n_sources]; NULL of kept targets */
    void* owner;                        /**< private */
} conn_particles_view;
#define CONN_PARTICLES_VIEW_INIT                                                                 \
    {                                                                                            \
        sizeof(conn_particles_view), 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, \
            NULL, NULL                                                                           \
    }

/** The kept targets of conn_tree_filter_targets, renumbered without gaps in tree order. */
CONN_API conn_status conn_tree_filter_targets_in_tree_order(const conn_tree* tree,
                                                            const uint8_t* flags, int64_t n_flags,
                                                            conn_particles_view* view);
/** Point sources that the sources of the tree stand for, in an order in which those of a source lie
 * side by side, sources in tree order. points: one array [n, dim] or dim arrays [n]; those of
 * source i of the host are user_starts[i] .. user_starts[i+1], n_starts = n_sources + 1. */
CONN_API conn_status conn_tree_link_point_sources(const conn_tree* tree, const int64_t* user_starts,
                                                  int64_t n_starts, const conn_array* points,
                                                  int32_t n_points, conn_particles_view* view);
/** Lets go of the particles; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_particles_release(conn_particles_view* view);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
