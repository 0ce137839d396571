# SPDX-License-Identifier: BSD-3-Clause
# vesin, whose install has no CMake package: vesin::vesin. vesin_ROOT points to the prefix that it
# was installed into. Its static library keeps symbols of the dynamic loader and of threads open.
find_path(vesin_INCLUDE_DIR vesin.h)
find_library(vesin_LIBRARY vesin)
mark_as_advanced(vesin_INCLUDE_DIR vesin_LIBRARY)
find_package(Threads QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(vesin REQUIRED_VARS vesin_LIBRARY vesin_INCLUDE_DIR Threads_FOUND)
if(vesin_FOUND AND NOT TARGET vesin::vesin)
    add_library(vesin::vesin UNKNOWN IMPORTED)
    set_target_properties(vesin::vesin PROPERTIES
        IMPORTED_LOCATION "${vesin_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${vesin_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS}")
endif()
