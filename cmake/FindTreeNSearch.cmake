# SPDX-License-Identifier: BSD-3-Clause
# TreeNSearch, whose install has no CMake package: TreeNSearch::TreeNSearch. TreeNSearch_ROOT points
# to the prefix that it was installed into.
find_path(TreeNSearch_INCLUDE_DIR TreeNSearch.h)
find_library(TreeNSearch_LIBRARY TreeNSearch)
mark_as_advanced(TreeNSearch_INCLUDE_DIR TreeNSearch_LIBRARY)
find_package(OpenMP QUIET COMPONENTS CXX)
find_package(Threads QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TreeNSearch REQUIRED_VARS
    TreeNSearch_LIBRARY TreeNSearch_INCLUDE_DIR OpenMP_CXX_FOUND Threads_FOUND)
if(TreeNSearch_FOUND AND NOT TARGET TreeNSearch::TreeNSearch)
    add_library(TreeNSearch::TreeNSearch UNKNOWN IMPORTED)
    set_target_properties(TreeNSearch::TreeNSearch PROPERTIES
        IMPORTED_LOCATION "${TreeNSearch_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${TreeNSearch_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "OpenMP::OpenMP_CXX;Threads::Threads")
endif()
