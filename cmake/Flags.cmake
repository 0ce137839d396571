# SPDX-License-Identifier: BSD-3-Clause
# How our own code is compiled: connectivity_flags is linked privately by every target of the
# project. The instruction set stays the baseline; wider kernels choose theirs file by file.

if(CONNECTIVITY_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

# Kokkos is half of what the compiler reads. Compiler caches do not work with precompiled headers.
set(precompile ${CONNECTIVITY_TOP_LEVEL})
if(CMAKE_CXX_COMPILER_LAUNCHER OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set(precompile OFF)
endif()
option(CONNECTIVITY_PCH "Precompile Kokkos once, which halves the build time" ${precompile})

add_library(connectivity_flags INTERFACE)
target_compile_features(connectivity_flags INTERFACE cxx_std_20)

# The predicate is symmetric bit for bit on every path only if no compiler fuses its products.
set(options -ffp-contract=off
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
target_compile_options(connectivity_flags INTERFACE
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:${options};-Wnon-virtual-dtor>"
    "$<$<COMPILE_LANG_AND_ID:C,GNU,Clang>:${options};-Wstrict-prototypes>")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bugs 105651 and 105329: `"text" + std::string` is said to overlap or overflow.
    target_compile_options(connectivity_flags INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)  # some warnings that are switched off are GCC's alone
    target_compile_options(connectivity_flags INTERFACE -Wno-unknown-warning-option)
endif()
if(CONNECTIVITY_WERROR)
    target_compile_options(connectivity_flags INTERFACE -Werror)
endif()

# Builds that look: what -fsanitize is given, empty in others. ThreadSanitizer must know the OpenMP
# runtime, which only clang's tells it; libFuzzer is clang's.
set(CONNECTIVITY_SANITIZERS "")
if(CONNECTIVITY_FUZZ)
    set(CONNECTIVITY_SANITIZERS fuzzer-no-link,address,undefined,float-cast-overflow)
elseif(CONNECTIVITY_SANITIZE STREQUAL thread)
    set(CONNECTIVITY_SANITIZERS thread)
elseif(CONNECTIVITY_SANITIZE STREQUAL address OR CONNECTIVITY_SANITIZE STREQUAL ON)
    set(CONNECTIVITY_SANITIZERS address,undefined)
elseif(CONNECTIVITY_SANITIZE)
    message(FATAL_ERROR "CONNECTIVITY_SANITIZE is '${CONNECTIVITY_SANITIZE}': OFF, address (or ON) "
        "or thread")
endif()
if(CONNECTIVITY_SANITIZERS MATCHES "fuzzer|thread" AND NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "CONNECTIVITY_FUZZ and CONNECTIVITY_SANITIZE=thread need clang, this is "
        "${CMAKE_CXX_COMPILER_ID}: configure with -DCMAKE_CXX_COMPILER=clang++ "
        "-DCMAKE_C_COMPILER=clang, or use sh cmake/test.sh --fuzz or --sanitize=thread")
endif()
if(CONNECTIVITY_SANITIZERS)
    # -O1 because stacks stay readable; asserts are on because this is the build that looks. Checked
    # code makes GCC see uninitialised values in the standard library's <regex>.
    target_compile_options(connectivity_flags INTERFACE -fsanitize=${CONNECTIVITY_SANITIZERS}
        -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1 -UNDEBUG
        -Wno-maybe-uninitialized)
    target_link_options(connectivity_flags INTERFACE -fsanitize=${CONNECTIVITY_SANITIZERS})
endif()

# Options every target of the project shares; a function, because properties do not travel.
function(connectivity_target target)
    target_link_libraries(${target} PRIVATE connectivity_flags)
    set_target_properties(${target} PROPERTIES
        CXX_EXTENSIONS OFF
        C_STANDARD 11
        C_EXTENSIONS OFF
        POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden
        C_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON)
endfunction()
