! SPDX-License-Identifier: BSD-3-Clause
! The C interface of connectivity.h for Fortran 2008: functions of the same names, bound one to one,
! and strings of Fortran. Handles are type(c_ptr), and null before they are created.
!
! Node numbers are those of C, from 0. Arrays x(3, n) are taken as they are (conn_matrix).
! connectivity_status.inc, made from the list of statuses in C, stands beside this file when it is
! installed.
module connectivity
    use, intrinsic :: iso_c_binding
    implicit none
    private
    public :: conn_version, conn_version_string, conn_status_text, conn_last_error, conn_abi_sizeof
    public :: conn_vector, conn_matrix
    public :: conn_context_create, conn_context_destroy
    public :: conn_nodes_create, conn_nodes_destroy, conn_nodes_set_h
    public :: conn_map_create, conn_map_destroy, conn_map_rebuild, conn_map_all_neighbours

    include 'connectivity_status.inc'

    integer(c_int32_t), parameter, public :: CONN_STRUCT_ARRAY = 1

    !> Array of the host, read during a call only; extents and strides count elements.
    type, bind(c), public :: conn_array
        type(c_ptr) :: data = c_null_ptr
        integer(c_int32_t) :: space = 0, device_id = 0, dtype = 0, ndim = 1
        integer(c_int64_t) :: extent(2) = 0, stride(2) = 1
    end type conn_array

    interface
        !> major*10000 + minor*100 + patch of the library that is loaded
        function conn_version() bind(c) result(version)
            import :: c_int32_t
            integer(c_int32_t) :: version
        end function conn_version

        !> Bytes of a struct in C, to compare with c_sizeof
        function conn_abi_sizeof(which) bind(c) result(bytes)
            import :: c_int32_t, c_int64_t
            integer(c_int32_t), value :: which
            integer(c_int64_t) :: bytes
        end function conn_abi_sizeof

        !> options: c_null_ptr for the defaults
        function conn_context_create(options, context) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), value :: options
            type(c_ptr), intent(inout) :: context
            integer(c_int32_t) :: status
        end function conn_context_create

        function conn_context_destroy(context) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), intent(inout) :: context
            integer(c_int32_t) :: status
        end function conn_context_destroy

        function conn_nodes_destroy(nodes) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), intent(inout) :: nodes
            integer(c_int32_t) :: status
        end function conn_nodes_destroy

        !> positions: one array [n, dim], or dim arrays [n]
        function conn_nodes_set_h(nodes, n_internal, positions, n_positions, h) bind(c) &
            result(status)
            import :: c_int32_t, c_int64_t, c_ptr, conn_array
            type(c_ptr), value :: nodes
            integer(c_int64_t), value :: n_internal
            type(conn_array), intent(in) :: positions(*)
            integer(c_int32_t), value :: n_positions
            type(conn_array), intent(in) :: h
            integer(c_int32_t) :: status
        end function conn_nodes_set_h

        !> options: c_null_ptr for the defaults
        function conn_map_create(context, options, map) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), value :: context, options
            type(c_ptr), intent(inout) :: map
            integer(c_int32_t) :: status
        end function conn_map_create

        function conn_map_destroy(map) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), intent(inout) :: map
            integer(c_int32_t) :: status
        end function conn_map_destroy

        function conn_map_rebuild(map, lists, n_lists) bind(c) result(status)
            import :: c_int32_t, c_ptr
            type(c_ptr), value :: map
            type(c_ptr), intent(in) :: lists(*)
            integer(c_int32_t), value :: n_lists
            integer(c_int32_t) :: status
        end function conn_map_rebuild

        !> Neighbours of a or b, ascending, in slots(1:count)
        function conn_map_all_neighbours(map, a, b, slots, capacity, count) bind(c) result(status)
            import :: c_int32_t, c_int64_t, c_ptr
            type(c_ptr), value :: map
            integer(c_int32_t), value :: a, b
            integer(c_int32_t), intent(inout) :: slots(*)
            integer(c_int64_t), value :: capacity
            integer(c_int64_t), intent(out) :: count
            integer(c_int32_t) :: status
        end function conn_map_all_neighbours
    end interface

contains

    !> Version of the library that is loaded, as "0.1.0"
    function conn_version_string() result(text)
        character(:), allocatable :: text
        interface
            function version_string() bind(c, name='conn_version_string') result(address)
                import :: c_ptr
                type(c_ptr) :: address
            end function version_string
        end interface
        text = fortran_text(version_string())
    end function conn_version_string

    function conn_status_text(status) result(text)
        integer(c_int32_t), intent(in) :: status
        character(:), allocatable :: text
        interface
            function status_text(status) bind(c, name='conn_status_text') result(address)
                import :: c_int32_t, c_ptr
                integer(c_int32_t), value :: status
                type(c_ptr) :: address
            end function status_text
        end interface
        text = fortran_text(status_text(status))
    end function conn_status_text

    !> What went wrong in the last call on this thread; empty after a success
    function conn_last_error() result(text)
        character(:), allocatable :: text
        interface
            function last_error() bind(c, name='conn_last_error') result(address)
                import :: c_ptr
                type(c_ptr) :: address
            end function last_error
        end interface
        text = fortran_text(last_error())
    end function conn_last_error

    function conn_nodes_create(context, name, dim, kernel_extent, nodes) result(status)
        type(c_ptr), intent(in) :: context
        character(*), intent(in) :: name
        integer(c_int32_t), intent(in) :: dim
        real(c_double), intent(in) :: kernel_extent
        type(c_ptr), intent(inout) :: nodes
        integer(c_int32_t) :: status
        interface
            function nodes_create(context, name, dim, kernel_extent, nodes) &
                bind(c, name='conn_nodes_create') result(status)
                import :: c_char, c_double, c_int32_t, c_ptr
                type(c_ptr), value :: context
                character(kind=c_char), intent(in) :: name(*)
                integer(c_int32_t), value :: dim
                real(c_double), value :: kernel_extent
                type(c_ptr), intent(inout) :: nodes
                integer(c_int32_t) :: status
            end function nodes_create
        end interface
        status = nodes_create(context, trim(name)//c_null_char, dim, kernel_extent, nodes)
    end function conn_nodes_create

    !> One value for each node
    function conn_vector(values) result(array)
        real(c_double), intent(in), target, contiguous :: values(:)
        type(conn_array) :: array
        array%extent = [size(values, kind=c_int64_t), 1_c_int64_t]
        if (size(values) > 0) array%data = c_loc(values)
    end function conn_vector

    !> values(components, nodes)
    function conn_matrix(values) result(array)
        real(c_double), intent(in), target, contiguous :: values(:, :)
        type(conn_array) :: array
        array%ndim = 2
        array%extent = [size(values, 2, c_int64_t), size(values, 1, c_int64_t)]
        array%stride = [size(values, 1, c_int64_t), 1_c_int64_t]
        if (size(values) > 0) array%data = c_loc(values)
    end function conn_matrix

    function fortran_text(address) result(text)
        type(c_ptr), intent(in) :: address
        character(:), allocatable :: text
        character(kind=c_char), pointer :: bytes(:)
        integer :: i, n
        interface
            function strlen(address) bind(c) result(length)
                import :: c_ptr, c_size_t
                type(c_ptr), value :: address
                integer(c_size_t) :: length
            end function strlen
        end interface
        n = int(strlen(address))
        call c_f_pointer(address, bytes, [n])
        allocate (character(n) :: text)
        do i = 1, n
            text(i:i) = bytes(i)
        end do
    end function fortran_text

end module connectivity
