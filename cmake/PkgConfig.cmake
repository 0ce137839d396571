# SPDX-License-Identifier: BSD-3-Clause
# Writes and installs connectivity.pc. Its prefix is told from where the file is.

if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
    file(RELATIVE_PATH to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    string(REGEX REPLACE "/$" "" to_prefix "${to_prefix}")
    set(pc_prefix "\${pcfiledir}/${to_prefix}")
endif()
foreach(name IN ITEMS LIBDIR INCLUDEDIR)
    if(IS_ABSOLUTE "${CMAKE_INSTALL_${name}}")
        set(pc_${name} "${CMAKE_INSTALL_${name}}")
    else()
        set(pc_${name} "\${prefix}/${CMAKE_INSTALL_${name}}")
    endif()
endforeach()

# What libconnectivity.a needs of a C compiler that links it: Kokkos has no .pc file to require.
set(pc_libs_private "")
foreach(library IN ITEMS containers simd core)
    set(target Kokkos::kokkos${library})
    if(TARGET ${target})
        get_target_property(type ${target} TYPE)
        if(type STREQUAL STATIC_LIBRARY)
            string(APPEND pc_libs_private " $<TARGET_FILE:${target}>")
        endif()
    endif()
endforeach()
if(Kokkos_ENABLE_OPENMP OR Kokkos_DEVICES MATCHES OPENMP)
    string(APPEND pc_libs_private " -fopenmp")
endif()
set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM runtime ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
foreach(library IN LISTS runtime CMAKE_DL_LIBS)
    string(APPEND pc_libs_private " -l${library}")
endforeach()

# connectivity_pkg_config(<name>): from cmake/<name>.pc.in.
function(connectivity_pkg_config name component)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in"
        "${PROJECT_BINARY_DIR}/package/${name}.pc.generate" @ONLY)
    file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/package/$<CONFIG>/${name}.pc"
        INPUT "${PROJECT_BINARY_DIR}/package/${name}.pc.generate")
    install(FILES "${PROJECT_BINARY_DIR}/package/$<CONFIG>/${name}.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${component})
endfunction()

connectivity_pkg_config(connectivity connectivity_development)
