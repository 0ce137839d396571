! SPDX-License-Identifier: BSD-3-Clause
! A map where node lists are wanted.
program handles
    use connectivity
    implicit none
    type(conn_map) :: map
    print *, conn_map_rebuild(map, [map])
end program handles
