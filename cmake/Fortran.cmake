# SPDX-License-Identifier: BSD-3-Clause
# The Fortran module: connectivity::fortran. Static, because only one compiler reads its .mod and
# nothing promises the names inside: a shared one would have a soname for every compiler. Hosts of
# other compilers build the source that is installed beside it.

set(CONNECTIVITY_FORTRAN_DIR "${PROJECT_SOURCE_DIR}/capi/fortran")
if(CONNECTIVITY_TOP_LEVEL AND NOT CMAKE_Fortran_COMPILER)
    unset(CMAKE_Fortran_COMPILER CACHE) # there may be one by now
    include(CheckLanguage)
    check_language(Fortran)
endif()
if(CMAKE_Fortran_COMPILER)
    option(CONNECTIVITY_FORTRAN "Build the Fortran module" ON)
endif()

# The statuses as Fortran parameters, from their one list.
file(READ "${PROJECT_SOURCE_DIR}/include/connectivity/base/status.h" text)
string(REGEX MATCHALL "X\\([A-Z_]+, [a-z_0-9]+, -?[0-9]+" statuses "${text}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    "${PROJECT_SOURCE_DIR}/include/connectivity/base/status.h")
list(TRANSFORM statuses REPLACE "X\\(([A-Z_]+), [a-z_0-9]+, (-?[0-9]+)"
    "    integer(c_int32_t), parameter, public :: CONN_\\1 = \\2\n")
list(JOIN statuses "" text)
set(CONNECTIVITY_FORTRAN_STATUS "${PROJECT_BINARY_DIR}/fortran/connectivity_status.inc")
file(CONFIGURE OUTPUT "${CONNECTIVITY_FORTRAN_STATUS}"
    CONTENT "    ! Made from connectivity/base/status.h\n${text}" @ONLY)

if(NOT CONNECTIVITY_FORTRAN)
    message(STATUS "The Fortran module is not built; its source is installed")
    return()
endif()
enable_language(Fortran)
file(GLOB sources CONFIGURE_DEPENDS "${CONNECTIVITY_FORTRAN_DIR}/*.F90")
add_library(connectivity_fortran STATIC ${sources})
add_library(connectivity::fortran ALIAS connectivity_fortran)
set(modules "${PROJECT_BINARY_DIR}/fortran/modules")
set_target_properties(connectivity_fortran PROPERTIES EXPORT_NAME fortran
    POSITION_INDEPENDENT_CODE ON Fortran_MODULE_DIRECTORY "${modules}"
    ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
target_include_directories(connectivity_fortran PUBLIC "$<BUILD_INTERFACE:${modules}>"
    PRIVATE "${PROJECT_BINARY_DIR}/fortran" "${CONNECTIVITY_FORTRAN_DIR}")
target_link_libraries(connectivity_fortran PUBLIC connectivity)
set(options -Wall -Wextra -pedantic -std=f2018)
if(CONNECTIVITY_WERROR)
    list(APPEND options -Werror)
endif()
target_compile_options(connectivity_fortran PRIVATE
    "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:${options}>")
