/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file connectivity.h
 * Who interacts with whom: neighbour rows and the list of interacting pairs of particles.
 * C99 and later, C++; this header carries the ABI promise (none while the version is 0.x).
 *
 * Errors. Functions return a conn_status: 0 is success; positive means arguments, state or memory,
 * and the object is as it was before the call; negative means a defect in the library.
 * conn_last_error() says what, where, which value and what is allowed. Nothing here ever aborts,
 * exits or prints. Outputs are written on success only, except where a needed size is returned.
 *
 * Handles. Created through an out-parameter, destroyed through a pointer to the handle, which
 * becomes NULL; NULL is accepted and does nothing. A context may be destroyed before what was
 * created with it. Destroying and releasing work at any time, also after conn_shutdown().
 *
 * Threads. Different handles may be used from different threads at once, one handle only from one
 * thread at a time; calls wait for each other inside. The last error belongs to the calling thread.
 *
 * Kokkos. The first conn_context_create() starts it (MPI hosts: after MPI_Init) and nothing stops
 * it but conn_shutdown() or the host, if the host shares it. Then all arrays of acquired views are
 * gone, and calls return CONN_E_FINALIZED. After a fork the child gets CONN_E_FORKED if the
 * library had more than one thread. All arrays are in host memory in this version.
 *
 * Callbacks must not throw, jump out or fork; nor call this library but for conn_set_error,
 * conn_last_error, texts and versions (CONN_E_CALLBACK); nor wait for a thread that does.
 *
 * Hosts include this header alone. Its parts are files beside it, each complete in itself;
 * connectivity_boundary.h (ghosts behind boundaries), connectivity_query.h (single nodes, checks),
 * connectivity_tree.h (box trees), connectivity_lists.h (interaction lists of them) and
 * connectivity_gravity.h (gravity) are not among them: they are experimental, for hosts that ask
 * for them.
 */
#ifndef CONNECTIVITY_H
#define CONNECTIVITY_H

#include "connectivity_base.h"
#include "connectivity_fields.h"
#include "connectivity_map.h"
#include "connectivity_nodes.h"
#include "connectivity_report.h"
#include "connectivity_traverse.h"
#include "connectivity_views.h"

#endif
