# SPDX-License-Identifier: BSD-3-Clause
# Provides Kokkos::kokkos. kokkos.sh finds a usable Kokkos or builds one into the user's cache;
# this file asks it once and remembers the answer in Kokkos_DIR.

if(NOT CONNECTIVITY_KOKKOS MATCHES "^(private|shared)$")
    message(FATAL_ERROR "CONNECTIVITY_KOKKOS is '${CONNECTIVITY_KOKKOS}': private or shared")
endif()

# A project that contains this one may have its Kokkos already; then that is the one.
if(NOT TARGET Kokkos::kokkos)
    if(NOT CONNECTIVITY_KOKKOS_ANSWER STREQUAL "${CONNECTIVITY_KOKKOS}:${Kokkos_DIR}"
       OR NOT EXISTS "${Kokkos_DIR}/KokkosConfig.cmake")
        set(arguments --cxx "${CMAKE_CXX_COMPILER}" --kind "${CONNECTIVITY_KOKKOS}")
        if(CONNECTIVITY_SANITIZE STREQUAL thread)
            list(APPEND arguments --sanitize thread)
        endif()
        if(NOT CONNECTIVITY_FETCH_KOKKOS)
            list(APPEND arguments --find-only)
        endif()
        foreach(hint IN ITEMS CMAKE_PREFIX_PATH CMAKE_TOOLCHAIN_FILE Kokkos_ROOT Kokkos_DIR)
            if(${hint})
                string(REPLACE ";" "\\;" value "${${hint}}")
                list(APPEND arguments "-D${hint}=${value}")
            endif()
        endforeach()
        execute_process(COMMAND sh "${CMAKE_CURRENT_LIST_DIR}/kokkos.sh" ${arguments}
            OUTPUT_VARIABLE directory OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
        if(failed)
            message(FATAL_ERROR "no usable Kokkos (the lines above say why). Give one with "
                "-DKokkos_ROOT=<prefix>, or run: sh ${CMAKE_CURRENT_LIST_DIR}/dependencies.sh")
        endif()
        set(Kokkos_DIR "${directory}" CACHE PATH "Where KokkosConfig.cmake is" FORCE)
        set(CONNECTIVITY_KOKKOS_ANSWER "${CONNECTIVITY_KOKKOS}:${Kokkos_DIR}" CACHE INTERNAL "")
    endif()
    find_package(Kokkos REQUIRED CONFIG)
    if(NOT CONNECTIVITY_TOP_LEVEL)
        # connectivity::cxx names Kokkos to targets of the project around this one, which sees only
        # what is global. (find_package has an option for that from CMake 3.24 on.)
        get_property(imported DIRECTORY PROPERTY IMPORTED_TARGETS)
        list(FILTER imported INCLUDE REGEX "^(Kokkos|OpenMP|Threads)::")
        set_property(TARGET ${imported} PROPERTY IMPORTED_GLOBAL TRUE)
    endif()
endif()
# One that a project around this has, or that was given by Kokkos_DIR, kokkos.sh did not ask.
if(CONNECTIVITY_KOKKOS STREQUAL shared AND Kokkos_VERSION VERSION_LESS 4.4)
    message(FATAL_ERROR "CONNECTIVITY_KOKKOS=shared needs Kokkos 4.4 or newer, this is "
        "${Kokkos_VERSION} in ${Kokkos_DIR}: older ones lose track of what is allocated where a "
        "library that shares them hides its symbols")
endif()
message(STATUS
    "Kokkos ${Kokkos_VERSION} (${CONNECTIVITY_KOKKOS}; ${Kokkos_DEVICES}): ${Kokkos_DIR}")

# Device compilers fuse products and sums on their own; -ffp-contract=off of Flags.cmake reaches only
# clang and the host's half of nvcc, whose device half has a switch of its own.
if(Kokkos_ENABLE_CUDA AND NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    target_compile_options(connectivity_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:--fmad=false>)
endif()
