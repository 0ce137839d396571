# SPDX-License-Identifier: BSD-3-Clause
# cornerstone-octree, headers without a CMake package: cornerstone::cornerstone. cornerstone_ROOT
# points to its source folder, or wherever include/cstone is.
find_path(cornerstone_INCLUDE_DIR cstone/findneighbors.hpp)
mark_as_advanced(cornerstone_INCLUDE_DIR)
find_package(OpenMP QUIET COMPONENTS CXX)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(cornerstone REQUIRED_VARS
    cornerstone_INCLUDE_DIR OpenMP_CXX_FOUND)
if(cornerstone_FOUND AND NOT TARGET cornerstone::cornerstone)
    add_library(cornerstone::cornerstone INTERFACE IMPORTED)
    set_target_properties(cornerstone::cornerstone PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${cornerstone_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES OpenMP::OpenMP_CXX)
endif()
