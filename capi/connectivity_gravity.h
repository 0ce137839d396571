/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity_gravity.h
 * EXPERIMENTAL: accelerations and potentials of particles that attract each other, to a tolerance.
 *
 * Not part of connectivity.h and of its promise: until hosts have used them, these functions may
 * change or go in any version. Hosts that want them include this header; errors, handles and
 * threads are as connectivity.h says.
 *
 * a_i = G sum m_j (x_j - x_i) / r^3, phi_i = -G sum m_j / r, softened where lengths are given; in
 * the units of the host, in double precision, with the same bits for any number of threads. A pair
 * at r = 0 without softening contributes nothing.
 */
#ifndef CONNECTIVITY_GRAVITY_H
#define CONNECTIVITY_GRAVITY_H

#include "connectivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Forces */
/**@{*/
typedef struct conn_gravity conn_gravity;

enum {
    CONN_GRAVITY_AUTOMATIC = 0, /**< direct or fmm, whichever is faster */
    CONN_GRAVITY_DIRECT = 1,    /**< every pair */
    CONN_GRAVITY_WALK = 2,      /**< multipoles of cells at particles (tree walk) */
    CONN_GRAVITY_FMM = 3        /**< multipoles of cells at cells (fast multipole method) */
};
enum { /* When the multipole of a cell B may act on a cell or group A. */
       CONN_ACCEPT_AUTOMATIC = 0,
       CONN_ACCEPT_FIELD = 1,        /**< its error is below epsilon M_B / R^2, R the distance of
                                          the centres: that of a particle is below epsilon times
                                          sum m / r^2 */
       CONN_ACCEPT_ACCELERATION = 2, /**< below epsilon times the smallest |a| in A */
       CONN_ACCEPT_GEOMETRIC = 3     /**< the radii of both add up to less than epsilon R */
};
enum {                             /* The law of a pair at distance r with lengths e. */
       CONN_SOFTENING_PLUMMER = 0, /**< m r / (r^2 + e^2)^(3/2), e the larger of the two;
                                        potential -m / sqrt(r^2 + e^2) */
       CONN_SOFTENING_SPH_EXA = 1  /**< m r / max(r, e_i + e_j)^3, potential -m r^2 / max(...)^3,
                                        not the integral of the force inside e_i + e_j */
};
enum { /* Of sums over near pairs, in coordinates about their cell. */
       CONN_NEAR_AUTOMATIC = 0,
       CONN_NEAR_FLOAT32 = 1,
       CONN_NEAR_FLOAT64 = 2
};

/** What is not given is chosen so that the tolerance is reached. */
typedef struct conn_gravity_options {
    size_t struct_size;
    int32_t method;         /**< CONN_GRAVITY_AUTOMATIC, ... */
    int32_t order;          /**< of expansions, 1 to 20; -1: not given */
    double tolerance;       /**< wanted 99th percentile of |error of a| / |a|, in
                                 [1e-12, 0.5]; checked on a sample */
    double epsilon;         /**< of the acceptance, > 0, with order; -1: not given */
    int32_t acceptance;     /**< CONN_ACCEPT_AUTOMATIC, ... */
    int32_t leaf;           /**< most particles in a leaf; -1: not given */
    int32_t near_precision; /**< CONN_NEAR_AUTOMATIC, ... */
    int32_t symmetric;      /**< 1: momentum is kept to round-off; not with a walk */
    int32_t softening;      /**< CONN_SOFTENING_PLUMMER, ... */
    int32_t n_samples;      /**< particles summed directly to measure the error, at
                                 most 100000; 0: it is not measured */
    int32_t error_bound;    /**< 1: keep a bound of the error of each particle */
    int32_t periodic[3];    /**< none or all three 1: images of the box without end, and
                                 a background that makes the mean density 0 (Ewald's
                                 sum, conducting surroundings) */
    double constant;        /**< of gravity, > 0 */
    double box_lo[3];       /**< of periodic axes; particles may lie outside */
    double box_hi[3];
    uint64_t seed;                       /**< of the sample */
    const double* previous_acceleration; /**< [n_previous] lengths of the accelerations of the step
                                              before, for CONN_ACCEPT_ACCELERATION; NULL: found by
                                              a rough solution. Read during the call only */
    int64_t n_previous;                  /**< particles; 0 with NULL */
    int64_t budget_bytes;                /**< 0: that of the context */
} conn_gravity_options;
#define CONN_GRAVITY_OPTIONS_INIT                                                            \
    {                                                                                        \
        sizeof(conn_gravity_options), 0, -1, 1e-4, -1, 0, -1, 0, 0, 0, 300, 0, {0, 0, 0}, 1, \
            {0, 0, 0}, {0, 0, 0}, 1, NULL, 0, 0                                              \
    }

/** The defaults, for hosts that cannot use CONN_GRAVITY_OPTIONS_INIT; size: that of the struct. */
CONN_API conn_status conn_gravity_options_init(conn_gravity_options* options, size_t size);
/** Without forces; nothing is allocated before the first solution. */
CONN_API conn_status conn_gravity_create(conn_context* context, conn_gravity** gravity);
/** Ends it; *gravity becomes NULL. Views stay. NULL is fine, and so is *gravity NULL. */
CONN_API conn_status conn_gravity_destroy(conn_gravity** gravity);
/** Forces of these particles on each other; if it fails, the old ones stay. positions: one array
 * [n, dim] or dim arrays [n], dim 1, 2 or 3, missing coordinates being 0; masses [n], of any sign;
 * softening [n], lengths >= 0, NULL: none. All CONN_FLOAT64 or all CONN_FLOAT32; read during the
 * call only. options NULL: the defaults. Arrays that are no one array with steps upwards are copied
 * once. CONN_E_ARGUMENT (options, sizes, a length < 0), CONN_E_NULL, CONN_E_NONFINITE (the first
 * such particle, or forces that overflow), CONN_E_BOX, CONN_E_UNSUPPORTED (some axes periodic and
 * others not), CONN_E_TOO_MANY (2^31 particles), CONN_E_BUDGET, CONN_E_MEMORY. */
CONN_API conn_status conn_gravity_solve(conn_gravity* gravity, const conn_array* positions,
                                        int32_t n_positions, const conn_array* masses,
                                        const conn_array* softening,
                                        const conn_gravity_options* options);
/** A table for people: milliseconds and bytes of the parts of the last solution, *length bytes
 * without the final NUL. With text NULL only *length is set; CONN_E_BUFFER, which sets it too, if
 * capacity is not larger. */
CONN_API conn_status conn_gravity_report_text(const conn_gravity* gravity, char* text,
                                              int64_t capacity, int64_t* length);
/** Gives back what is kept for the next solution. */
CONN_API conn_status conn_gravity_release_scratch(conn_gravity* gravity);
/**@}*/

/** @name Results
 * CONN_E_NOT_BUILT before the first solution. */
/**@{*/

/** What was done and how well. Errors are those of the sample: of the acceleration relative to
 * |a|; field: the same relative to sum m / r^2, which has no zeros; of the potential relative to
 * sum m / r. */
typedef struct conn_gravity_info {
    size_t struct_size;
    int64_t n;
    uint64_t generation;    /**< of this solution; no two of a process have the same */
    int32_t method;         /**< CONN_GRAVITY_DIRECT, ...; never automatic */
    int32_t order;          /**< of expansions, 0 for direct */
    int32_t acceptance;     /**< CONN_ACCEPT_FIELD, ... */
    int32_t near_precision; /**< CONN_NEAR_FLOAT32 or CONN_NEAR_FLOAT64 */
    double epsilon;
    int64_t n_samples; /**< 0: errors are unknown, or 0 by method */
    int64_t n_near;    /**< pairs of particles */
    int64_t n_far;     /**< pairs of cells (fmm), or of particle and cell (walk) */
    double acceleration_rms;
    double acceleration_p99;
    double acceleration_max;
    double field_rms;
    double field_p99;
    double field_max;
    double potential_rms;
    double potential_p99;
    double potential_max;
    int32_t reached;       /**< 1: acceleration_p99 is at most the tolerance */
    int32_t dim;           /**< of the positions */
    int64_t scratch_bytes; /**< kept for the next solution */
} conn_gravity_info;
#define CONN_GRAVITY_INFO_INIT \
    { sizeof(conn_gravity_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }

CONN_API conn_status conn_gravity_get_info(const conn_gravity* gravity, conn_gravity_info* info);

/** Pinned: the arrays stay valid and unchanged until released, through solutions and the end of
 * the object. Particles are in the order of the host. Arrays of length 0 may be NULL. */
typedef struct conn_gravity_view {
    size_t struct_size;
    int64_t n;
    uint64_t generation;
    int32_t space;
    int32_t device_id;
    const double* acceleration; /**< [n][3] */
    const double* potential;    /**< [n] per unit mass, negative near masses > 0 */
    const double* error_bound;  /**< [n] no error of |a| is above it; NULL unless asked for */
    void* owner;                /**< private */
} conn_gravity_view;
#define CONN_GRAVITY_VIEW_INIT \
    { sizeof(conn_gravity_view), 0, 0, 0, 0, NULL, NULL, NULL, NULL }

/** Pins the forces in the given space. view must be initialised and not hold others. */
CONN_API conn_status conn_gravity_acquire(const conn_gravity* gravity, int32_t space,
                                          conn_gravity_view* view);
/** Lets go of the forces; the arrays of the view become NULL. Twice is fine. */
CONN_API conn_status conn_gravity_release(conn_gravity_view* view);
/** Writes the forces into arrays of the host, which conn_array describes although its data is
 * const: acceleration as positions were given, one array [n, dim] or dim arrays [n]; potential and
 * error_bound [n]. Each may be NULL, and CONN_FLOAT64 or CONN_FLOAT32, with any steps that give
 * every number a place of its own. Nothing is written on an error: CONN_E_ARGUMENT (sizes, steps),
 * CONN_E_NONFINITE (a number too large for CONN_FLOAT32), CONN_E_NOT_BUILT (error_bound, too, that
 * was not asked for). */
CONN_API conn_status conn_gravity_copy(const conn_gravity* gravity, const conn_array* acceleration,
                                       int32_t n_acceleration, const conn_array* potential,
                                       const conn_array* error_bound);
/**@}*/

#ifdef __cplusplus
}
#endif

#endif
