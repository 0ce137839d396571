/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_lists.h
 * EXPERIMENTAL: interaction lists of box trees, who interacts with whom in a fast multipole method.
 *
 * Not part of connectivity.h and of its promise: until hosts have used them, these functions may
 * change or go in any version. Hosts that want them include this header; errors, handles and
 * threads are as connectivity.h says.
 *
 * Two boxes touch if their closures meet. Boxes of one level, different ones, are near if at most
 * well_sep_is_n_away boxes apart in the maximum norm. Every target meets every source exactly once:
 * by list 1 or a close list (direct), list 2 (multipole to local), list 3 (multipole to target) or
 * list 4 (source to local), of boxes or of those above them. Names are those of boxtree,
 * https://documen.tician.de/boxtree/traversal.html
 */
#ifndef CONNECTIVITY_LISTS_H
#define CONNECTIVITY_LISTS_H

#include "connectivity_tree.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Building the lists of a tree */
/**@{*/
typedef struct conn_lists conn_lists;

enum { /* When a box is far enough from particles with radii, whose region is */
       CONN_CRIT_DEFAULT = 0,      /**< CONN_CRIT_PRECISE_LINF */
       CONN_CRIT_STATIC_LINF = 1,  /**< the enlarged cube of their box; not with CONN_EXTENT_L2 */
       CONN_CRIT_PRECISE_LINF = 2, /**< their hull */
       CONN_CRIT_STATIC_L2 = 3     /**< the ball around that cube */
};

typedef struct conn_lists_options {
    size_t struct_size;
    int32_t well_sep_is_n_away;                  /**< at least 1 */
    int32_t from_sep_smaller_crit;               /**< CONN_CRIT_DEFAULT, ... */
    int64_t from_sep_smaller_min_nsources_cumul; /**< boxes with fewer sources, those below counted,
                                                      go to the close lists instead of list 3 */
    int32_t same_level_non_well_sep_boxes;       /**< 1: build this list, and so on */
    int32_t neighbor_source_boxes;
    int32_t from_sep_siblings;
    int32_t from_sep_smaller;                /**< with its close list */
    int32_t from_sep_bigger;                 /**< with its close list */
    int32_t reserved;                        /**< 0 */
    const uint8_t* source_boxes_mask;        /**< [n_mask], NULL: all. Boxes with 0 are left out of
                                                  CONN_LIST_SOURCE_BOXES */
    const uint8_t* source_parent_boxes_mask; /**< [n_mask], the same of
                                                  CONN_LIST_SOURCE_PARENT_BOXES */
    int64_t n_mask;                          /**< boxes of the tree; 0 without masks */
    int64_t budget_bytes;                    /**< 0: that of the context */
} conn_lists_options;
#define CONN_LISTS_OPTIONS_INIT \
    { sizeof(conn_lists_options), 1, 0, 0, 1, 1, 1, 1, 1, 0, NULL, NULL, 0, 0 }

/** The defaults, for hosts that cannot use CONN_LISTS_OPTIONS_INIT; size: that of the struct. */
CONN_API conn_status conn_lists_options_init(conn_lists_options* options, size_t size);
/** Without lists. */
CONN_API conn_status conn_lists_create(conn_context* context, conn_lists** lists);
/** Ends them; *lists becomes NULL. Views stay. NULL is fine, and so is *lists NULL. */
CONN_API conn_status conn_lists_destroy(conn_lists** lists);
/** Builds the lists of the tree as it is now; if it fails, the old ones stay. They keep what they
 * need of the tree, which may be built anew or destroyed. options NULL: the defaults.
 * CONN_E_NOT_BUILT for a tree without boxes, CONN_E_ARGUMENT (options), CONN_E_NULL (hulls that
 * CONN_CRIT_PRECISE_LINF needs and the tree lacks), CONN_E_UNSUPPORTED (well_sep_is_n_away too
 * large for a deep tree), CONN_E_BUDGET, CONN_E_MEMORY. */
CONN_API conn_status conn_lists_rebuild(conn_lists* lists, const conn_tree* tree,
                                        const conn_lists_options* options);
/** Joins the rows of list 1, 3 close and 4 close, in this order, to list 1; there are no close
 * lists then. Nothing to do where there are none. CONN_E_NOT_BUILT unless list 1 was asked for. */
CONN_API conn_status conn_lists_merge_close(conn_lists* lists);
/** A table for people: bytes and milliseconds of each list, as conn_tree_report_text. */
CONN_API conn_status conn_lists_report_text(const conn_lists* lists, char* text, int64_t capacity,
                                            int64_t* length);
/**@}*/

/** @name The lists */
/**@{*/
enum { /* The first four are sets of boxes, ascending: a row for each level, row_boxes NULL. */
       CONN_LIST_SOURCE_BOXES = 0,                  /**< with own sources */
       CONN_LIST_TARGET_BOXES = 1,                  /**< with own targets */
       CONN_LIST_SOURCE_PARENT_BOXES = 2,           /**< with sources in boxes below */
       CONN_LIST_TARGET_OR_TARGET_PARENT_BOXES = 3, /**< with targets, own or below */
       /* A row for each box, row_boxes NULL. */
       CONN_LIST_SAME_LEVEL_NON_WELL_SEP_BOXES = 4, /**< near boxes */
       CONN_LIST_COLLEAGUES = 5, /**< the same; none unless well_sep_is_n_away is 1 */
       /* A row for each box of row_boxes: of LIST_TARGET_BOXES for 6, 9 and 11, of
          LIST_TARGET_OR_TARGET_PARENT_BOXES for 7 and 10. */
       CONN_LIST_NEIGHBOR_SOURCE_BOXES = 6,  /**< list 1: with own sources, touching, any level */
       CONN_LIST_FROM_SEP_SIBLINGS = 7,      /**< list 2: same level, not near, parents near */
       CONN_LIST_FROM_SEP_SMALLER = 8,       /**< list 3, of one source level: smaller ones, far
                                                  enough from the row's targets, parents not so; only
                                                  target boxes that have any have a row */
       CONN_LIST_FROM_SEP_CLOSE_SMALLER = 9, /**< not far enough; none without radii, or merged */
       CONN_LIST_FROM_SEP_BIGGER = 10,       /**< list 4: as large or larger, with own sources,
                                                  far enough from the row's box, not so for its
                                                  parent */
       CONN_LIST_FROM_SEP_CLOSE_BIGGER = 11  /**< not far enough; none without radii, or merged */
};
/** Pins a list: which is one of CONN_LIST_*, level that of the sources of
 * CONN_LIST_FROM_SEP_SMALLER, otherwise 0. view must be initialised and not hold another list;
 * conn_box_list_release lets go of it. A list that this tree cannot have is no error: is_none is 1.
 * CONN_E_NOT_BUILT for lists that were not asked for, and before the first rebuild. */
CONN_API conn_status conn_lists_acquire(const conn_lists* lists, int32_t which, int32_t level,
                                        int32_t space, conn_box_list_view* view);
/**@}*/

/** @name Classes of list 2
 * Entries with equal translations, or equal angles to the last axis, share precomputed operators.
 */
/**@{*/
enum {
    CONN_CLASSES_TRANSLATION_PER_LEVEL = 0, /**< pairs of different levels are different */
    CONN_CLASSES_TRANSLATION = 1,
    CONN_CLASSES_ROTATION = 2
};

typedef struct conn_classes_view {
    size_t struct_size;
    int64_t n_entries;   /**< of list 2 */
    uint64_t generation; /**< of the tree that the lists were made from */
    int32_t n_classes;
    int32_t n_levels; /**< of level_starts: levels of the tree, 1 of classes without levels, 0
                           of rotations */
    int32_t dim;
    int32_t space;
    int32_t device_id;
    int32_t reserved;
    const int32_t* classes;      /**< [n_entries] class of each */
    const int32_t* level_starts; /**< [n_levels + 1] first class of each level */
    const double* vectors;       /**< [dim][n_classes] centre of the target box minus centre of the
                                      source box; of classes without levels in boxes as large as the
                                      root; NULL of rotations */
    const double* angles;        /**< [n_classes] between that vector and the last axis, in [0, pi];
                                      NULL of translations */
    void* owner;                 /**< private */
} conn_classes_view;
#define CONN_CLASSES_VIEW_INIT \
    { sizeof(conn_classes_view), 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL }

/** Makes the classes, which is one of CONN_CLASSES_*, and pins them. view must be initialised and
 * not hold others. CONN_E_NOT_BUILT without list 2, CONN_E_ARGUMENT if (4n + 3)^dim exceeds 2^31-1
 * for n = well_sep_is_n_away, CONN_E_BUDGET, CONN_E_MEMORY. */
CONN_API conn_status conn_lists_classes_acquire(const conn_lists* lists, int32_t which,
                                                int32_t space, conn_classes_view* view);
/** Lets go of the classes; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_lists_classes_release(conn_classes_view* view);
/**@}*/

/** @name Work
 * Operations of a fast multipole method, counted at the box that receives them, P2M and M2M at the
 * one that holds the sources. Lists not asked for count 0. */
/**@{*/
enum {
    CONN_WORK_P2P = 0,       /**< pairs of target and source in list 1 */
    CONN_WORK_P2P_CLOSE = 1, /**< the same in close lists */
    CONN_WORK_M2L = 2,       /**< entries of list 2 */
    CONN_WORK_M2P = 3,       /**< entries of list 3 times own targets */
    CONN_WORK_P2L = 4,       /**< own sources of entries of list 4 */
    CONN_WORK_P2M = 5,       /**< own sources */
    CONN_WORK_L2P = 6,       /**< own targets */
    CONN_WORK_M2M = 7,       /**< 1: the multipole is shifted to the parent's */
    CONN_WORK_L2L = 8,       /**< 1: the local expansion comes from the parent's */
    CONN_WORK_FROM_SEP_SMALLER_ENTRIES = 9,
    CONN_WORK_FROM_SEP_BIGGER_ENTRIES = 10
};
/** Operations of one kind: of each box, counts [n_boxes], and *total of all (may be NULL). *n
 * receives the number of boxes. With counts NULL only the numbers are set; CONN_E_BUFFER, which
 * sets them too, if capacity is smaller. The first call after a rebuild counts all kinds, in one
 * pass over all lists. */
CONN_API conn_status conn_lists_work(const conn_lists* lists, int32_t kind, int64_t* counts,
                                     int64_t capacity, int64_t* n, int64_t* total);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
