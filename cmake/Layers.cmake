# SPDX-License-Identifier: BSD-3-Clause
# Layers: each folder src/<layer> becomes the object library connectivity_<layer>. Together with
# capi/ they are libconnectivity.so (only conn_* leaves it) and libconnectivity.a (C++ and C).

set(CONNECTIVITY_LAYERS "")
set(CONNECTIVITY_WIDE_LAYERS "")

# Kernels for wider instruction sets are files of their own, named for the set they need.
# Their headers in GCC 12 use "undefined" registers and warn about themselves (GCC bug 105593).
set(CONNECTIVITY_WIDE_FLAGS -mfma -mbmi -mbmi2 -mpopcnt -Wno-uninitialized -Wno-maybe-uninitialized)
set(CONNECTIVITY_AVX2_FLAGS -mavx2 ${CONNECTIVITY_WIDE_FLAGS})
set(CONNECTIVITY_AVX512_FLAGS -mavx512f -mavx512vl -mavx512bw -mavx512dq
    ${CONNECTIVITY_WIDE_FLAGS})

# Sets the options of the *_avx2.cpp and *_avx512.cpp among the sources, or drops those files
# where the processor is another; X86 tells whether any is left.
function(connectivity_wide_kernels sources_var x86_var)
    set(kept "")
    set(any OFF)
    foreach(source IN LISTS ${sources_var})
        set(flags "")
        if(source MATCHES "_avx2\\.cpp$")
            set(flags ${CONNECTIVITY_AVX2_FLAGS})
        elseif(source MATCHES "_avx512\\.cpp$")
            set(flags ${CONNECTIVITY_AVX512_FLAGS})
        endif()
        if(NOT flags)
            list(APPEND kept "${source}")
        elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
            set_source_files_properties("${source}" PROPERTIES
                COMPILE_OPTIONS "${flags}" SKIP_PRECOMPILE_HEADERS ON)
            list(APPEND kept "${source}")
            set(any ON)
        endif()
    endforeach()
    set(${sources_var} "${kept}" PARENT_SCOPE)
    set(${x86_var} ${any} PARENT_SCOPE)
endfunction()

# The first target precompiles Kokkos, the others use that.
function(connectivity_precompile target)
    if(CONNECTIVITY_PCH AND target STREQUAL connectivity_base)
        target_precompile_headers(${target} PRIVATE <Kokkos_Core.hpp>)
    elseif(CONNECTIVITY_PCH AND TARGET connectivity_base)
        target_precompile_headers(${target} REUSE_FROM connectivity_base)
    endif()
endfunction()

# Adds the layer if src/<layer> has sources, in folders of its own too. A layer that is headers only needs no library.
function(connectivity_layer layer)
    file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${layer}/*.cpp"
        "${PROJECT_SOURCE_DIR}/src/${layer}/*/*.cpp")
    if(NOT sources)
        return()
    endif()
    connectivity_wide_kernels(sources has_x86_kernels)
    set(target connectivity_${layer})
    add_library(${target} OBJECT ${sources})
    connectivity_target(${target})
    target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/include"
                               PRIVATE "${PROJECT_SOURCE_DIR}/src")
    target_link_libraries(${target} PUBLIC Kokkos::kokkos Eigen3::Eigen)
    target_compile_definitions(${target} PRIVATE CONNECTIVITY_VERSION="${PROJECT_VERSION}")
    connectivity_precompile(${target})
    if(has_x86_kernels)
        target_compile_definitions(${target} PRIVATE CONNECTIVITY_X86_KERNELS=1)
        set(CONNECTIVITY_WIDE_LAYERS ${CONNECTIVITY_WIDE_LAYERS} ${target} PARENT_SCOPE)
    endif()
    set(CONNECTIVITY_LAYERS ${CONNECTIVITY_LAYERS} ${target} PARENT_SCOPE)
endfunction()

# The C functions of capi/, as objects for both libraries.
function(connectivity_c_interface)
    file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/capi/*.cpp")
    if(NOT sources)
        return()
    endif()
    add_library(connectivity_capi OBJECT ${sources})
    connectivity_target(connectivity_capi)
    target_include_directories(connectivity_capi PRIVATE "${PROJECT_SOURCE_DIR}/capi"
        "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/src")
    target_link_libraries(connectivity_capi PRIVATE Kokkos::kokkos Eigen3::Eigen)
    target_compile_definitions(connectivity_capi PRIVATE CONNECTIVITY_VERSION="${PROJECT_VERSION}"
        CONNECTIVITY_KOKKOS_LINKAGE="${CONNECTIVITY_KOKKOS}")
    connectivity_precompile(connectivity_capi)
endfunction()

# The shared library exports the C functions of capi/ and nothing else. It is never unloaded
# (nodelete): Kokkos and OpenMP keep threads that would run in unmapped code.
function(connectivity_shared_library objects)
    set(map "${PROJECT_SOURCE_DIR}/capi/connectivity.map")
    add_library(connectivity SHARED ${objects})
    add_library(connectivity::connectivity ALIAS connectivity)
    connectivity_target(connectivity)
    target_include_directories(connectivity PUBLIC
        "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/capi;${PROJECT_SOURCE_DIR}/include>")
    target_link_libraries(connectivity PRIVATE Kokkos::kokkos)
    target_link_options(connectivity PRIVATE "LINKER:--version-script=${map}"
        LINKER:-z,nodelete LINKER:-Bsymbolic-functions)
    if(NOT CONNECTIVITY_SANITIZERS)  # clang has their runtime in the program alone
        target_link_options(connectivity PRIVATE LINKER:-z,defs)
    endif()
    set_target_properties(connectivity PROPERTIES VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR} LINK_DEPENDS "${map}" LINKER_LANGUAGE CXX
        LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}" INSTALL_RPATH_USE_LINK_PATH ON)
endfunction()

# Makes libconnectivity.so and libconnectivity.a of the layers added so far. The archive is for C++,
# and holds the C functions, too, for hosts that link everything statically.
function(connectivity_libraries)
    connectivity_c_interface()
    set(objects "")
    foreach(target IN LISTS CONNECTIVITY_LAYERS ITEMS connectivity_capi)
        list(APPEND objects $<TARGET_OBJECTS:${target}>)
    endforeach()
    connectivity_shared_library("${objects}")
    add_library(connectivity_static STATIC ${objects})
    add_library(connectivity::cxx ALIAS connectivity_static)
    set_target_properties(connectivity_static PROPERTIES OUTPUT_NAME connectivity
        LINKER_LANGUAGE CXX ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}" EXPORT_NAME cxx)
    target_include_directories(connectivity_static PUBLIC
        "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>")
    target_compile_features(connectivity_static PUBLIC cxx_std_20)
    target_link_libraries(connectivity_static PUBLIC Kokkos::kokkos)
    if(CONNECTIVITY_SANITIZERS)
        target_link_options(connectivity_static PUBLIC -fsanitize=${CONNECTIVITY_SANITIZERS})
    endif()
endfunction()
