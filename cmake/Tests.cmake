# SPDX-License-Identifier: BSD-3-Clause
# Tests mirror the layers: the *_test.cpp of tests/<folder> become the executable test_<folder>.
# A folder with a CMakeLists.txt of its own says itself what it builds.

find_package(GTest REQUIRED)
include(GoogleTest)

# What tests share: point clouds, brute force, reference data.
file(GLOB support CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/support/*.cpp")
if(support)
    add_library(connectivity_test_support STATIC ${support})
    connectivity_target(connectivity_test_support)
    target_include_directories(connectivity_test_support PUBLIC "${PROJECT_SOURCE_DIR}/tests")
    target_link_libraries(connectivity_test_support PUBLIC connectivity_static GTest::gtest
        PRIVATE conformance_scenes)
    if(CONNECTIVITY_PCH)
        target_precompile_headers(connectivity_test_support PRIVATE
            <Kokkos_Core.hpp> <gtest/gtest.h>)
    endif()
    # As test executables are, or they could not share the precompiled header.
    set_target_properties(connectivity_test_support PROPERTIES POSITION_INDEPENDENT_CODE OFF)
endif()

# Tests run side by side: threads that wait must not spin, and a test counts as two processors.
set(CONNECTIVITY_TEST_ENVIRONMENT OMP_PROC_BIND=false OMP_WAIT_POLICY=passive)
if(CONNECTIVITY_SANITIZERS)
    list(APPEND CONNECTIVITY_TEST_ENVIRONMENT
        "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/lsan.supp:print_suppressions=0"
        UBSAN_OPTIONS=print_stacktrace=1)
endif()
if(CONNECTIVITY_SANITIZERS STREQUAL thread)
    # LLVM's OpenMP tells ThreadSanitizer, by way of its library archer, what its threads wait for;
    # it is not instrumented itself.
    execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-resource-dir
        OUTPUT_VARIABLE resources OUTPUT_STRIP_TRAILING_WHITESPACE)
    find_library(CONNECTIVITY_ARCHER archer HINTS "${resources}/../..")
    if(NOT CONNECTIVITY_ARCHER)
        message(FATAL_ERROR "${CMAKE_CXX_COMPILER} has no libarcher.so (Debian: libomp-dev): "
            "without it ThreadSanitizer takes every barrier of OpenMP for a race")
    endif()
    list(APPEND CONNECTIVITY_TEST_ENVIRONMENT "OMP_TOOL_LIBRARIES=${CONNECTIVITY_ARCHER}"
        "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/tsan.supp:print_suppressions=0:ignore_noninstrumented_modules=1")
endif()

# connectivity_test(<folder> LABEL <label>): one executable from the folder's *_test.cpp.
function(connectivity_test folder)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "LABEL" "")
    file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cpp")
    if(NOT sources OR NOT TARGET connectivity_static)
        return()
    endif()
    set(target test_${folder})
    add_executable(${target} ${sources})
    connectivity_target(${target})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    if(CONNECTIVITY_PCH AND TARGET connectivity_test_support)
        target_precompile_headers(${target} REUSE_FROM connectivity_test_support)
    endif()
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests"
        "${PROJECT_SOURCE_DIR}/src" "${PROJECT_SOURCE_DIR}/capi")
    target_compile_definitions(${target} PRIVATE
        CONNECTIVITY_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(folder MATCHES "^(io|program)$")
        target_link_libraries(${target} PRIVATE connectivity_app)
    endif()
    if(folder STREQUAL capi)
        target_link_libraries(${target} PRIVATE connectivity)
    endif()
    target_link_libraries(${target} PRIVATE
        $<TARGET_NAME_IF_EXISTS:connectivity_test_support> connectivity_static GTest::gtest_main)
    gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST TEST_PREFIX "${folder}/"
        PROPERTIES LABELS ${arg_LABEL} TIMEOUT 600 PROCESSORS 2
        ENVIRONMENT "${CONNECTIVITY_TEST_ENVIRONMENT}")
    # Once more with the narrower kernels, in one process each.
    if(folder MATCHES "^(search|map|stability)$")
        foreach(isa IN ITEMS avx2 portable)
            add_test(NAME ${folder}/all_with_${isa}_kernels
                COMMAND ${target} --gtest_brief=1 --gtest_filter=-SameBits.*)
            set_tests_properties(${folder}/all_with_${isa}_kernels PROPERTIES LABELS slow TIMEOUT 1200
                ENVIRONMENT "${CONNECTIVITY_TEST_ENVIRONMENT};CONNECTIVITY_ISA=${isa}")
        endforeach()
    endif()
endfunction()

file(GLOB folders LIST_DIRECTORIES true CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/*")
foreach(path IN LISTS folders)
    cmake_path(GET path FILENAME folder)
    if(NOT IS_DIRECTORY "${path}" OR folder STREQUAL support)
        continue()
    endif()
    set(label unit)
    if(folder MATCHES "^(stability|capi|package|mpi)$")
        set(label ${folder})
    elseif(folder STREQUAL faults)
        set(label stability)
    endif()
    if(EXISTS "${path}/CMakeLists.txt")
        add_subdirectory("${path}" "${PROJECT_BINARY_DIR}/tests/${folder}")
    elseif((NOT folder MATCHES "^(io|program)$" OR TARGET connectivity_app)
           AND (NOT folder STREQUAL capi OR TARGET connectivity))
        connectivity_test(${folder} LABEL ${label})
    endif()
endforeach()
