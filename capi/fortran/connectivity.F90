! SPDX-License-Identifier: BSD-3-Clause
! The C interface for Fortran 2008: connectivity.h, and the experimental connectivity_boundary.h,
! connectivity_query.h, connectivity_tree.h, connectivity_lists.h and connectivity_gravity.h.
!
! Every function of the headers is here under its name, and means what the header says, with the
! types of Fortran: an array brings its length, texts are character strings, truth is logical, what
! may be NULL in C is optional (and therefore last). Functions return a status, CONN_OK or an error
! of which conn_error_text(status) says what, where, which value and what is allowed; on an error
! all arguments keep what they had, but for a size that is needed. Shorter ways are the generic names conn_set_h, conn_set_tensor,
! conn_rebuild, conn_acquire, conn_release, conn_destroy, and conn_*_pointers.
!
! Handles (conn_context, conn_nodes, conn_map, ...) are null before they are created; a copy is the
! same object. Structs have the members and defaults of C.
!
! Arrays of the host are taken where they are, also sections with a stride: x(3, n) by
! conn_array_matrix, x(n, 3) by conn_array_planar, x(n) by conn_array_vector. Such a description
! holds an address: what it describes must have the target attribute and be no expression, nor a
! component like particles%x, of which compilers make a copy: conn_array_strided is for these. The
! generic names that take arrays themselves work with anything. Arguments with the attribute
! contiguous are copied by the compiler if they are sections with a stride.
!
! Numbers. With options%index_base = 1 nodes and slots count from 1, so that they index ordinary
! arrays x(:, 1:n); with 0, the default, arrays x(:, 0:n-1). Positions (offsets, rows, pairs, ranks,
! lists) count from 0 in any case: pointers to them, made by conn_*_pointers, have lower bound 0.
!
! connectivity_status.inc, made from the list of statuses in C, stands beside this file when it is
! installed; c_*.inc are made from the headers.
module connectivity
    use, intrinsic :: iso_c_binding
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    implicit none
    private

    include 'connectivity_status.inc'
    include 'c_base.inc'
    include 'c_nodes.inc'
    include 'c_map.inc'
    include 'c_views.inc'
    include 'c_fields.inc'
    include 'c_traverse.inc'
    include 'c_report.inc'
    include 'c_boundary.inc'
    include 'c_query.inc'
    include 'c_tree.inc'
    include 'c_lists.inc'
    include 'c_gravity.inc'
    include 'interfaces.inc'

contains

    include 'base.inc'
    include 'arrays.inc'
    include 'nodes.inc'
    include 'set_h.inc'
    include 'map.inc'
    include 'orders.inc'
    include 'views.inc'
    include 'pointers.inc'
    include 'fields.inc'
    include 'traverse.inc'
    include 'boundary.inc'
    include 'query.inc'
    include 'tree.inc'
    include 'tree_pointers.inc'
    include 'lists.inc'
    include 'gravity.inc'
    include 'gravity_results.inc'

end module connectivity
