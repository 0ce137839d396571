/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Every status of the library, once: the C enum, the texts, the Fortran parameters and the C++ `Status` are all
 * generated from this list. Valid C99.
 *
 * Positive: the caller's arguments, state or memory; the object is as it was before the call.
 * Negative: a defect inside the library. */
#ifndef CONNECTIVITY_BASE_STATUS_H
#define CONNECTIVITY_BASE_STATUS_H

/*  X(NAME, name, value, text) */
#define CONN_STATUS_LIST(X)                                                                    \
    X(OK, ok, 0, "success")                                                                    \
    X(E_ARGUMENT, argument, 1, "an argument is out of its allowed range")                      \
    X(E_NULL, null, 2, "a required pointer is NULL")                                           \
    X(E_HANDLE, handle, 3, "the handle is dead or of another kind")                            \
    X(E_STRUCT_SIZE, struct_size, 4, "the struct size is not one this library knows")          \
    X(E_UNSUPPORTED, unsupported, 5, "this build does not support what was asked for")         \
    X(E_NONFINITE, nonfinite, 6, "a coordinate is NaN or infinite")                            \
    X(E_SUPPORT, support, 7, "a smoothing length is negative, NaN or infinite")                \
    X(E_NOT_SPD, not_spd, 8, "an H tensor is not symmetric positive definite")                 \
    X(E_BOX, box, 9, "the box is inverted, empty or not finite")                               \
    X(E_HALF_BOX, half_box, 10, "a support is larger than half a periodic box")                \
    X(E_TOO_MANY, too_many, 11, "a count is larger than the library can index")                \
    X(E_MEMORY, memory, 12, "memory could not be allocated")                                   \
    X(E_BUDGET, budget, 13, "the result would not fit the memory budget")                      \
    X(E_NOT_BUILT, not_built, 14, "this product was not asked for in the last rebuild")        \
    X(E_STALE, stale, 15, "the view belongs to an older generation of the map")                \
    X(E_BUFFER, buffer, 16, "the caller's buffer is too small")                                \
    X(E_FINALIZED, finalized, 17, "Kokkos was finalised; it cannot be started again")          \
    X(E_FORKED, forked, 18, "the process was forked after the library started its threads")    \
    X(E_FILE, file, 19, "a file could not be opened, read or written")                         \
    X(E_FORMAT, format, 20, "a file is not of a known format or lacks a required part")        \
    X(E_CALLBACK, callback, 21, "the host's callback stopped the call, or called the library") \
    X(E_INTERNAL, internal, -1, "internal error: please report it")

#endif
