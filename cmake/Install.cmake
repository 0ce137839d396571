# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` puts where, in components connectivity_runtime, _development (C), _cxx,
# _fortran, _program and _doc. Nothing installed names the prefix: the tree may be moved.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/connectivity")

# The C interface: shared library and headers. Its export names no other package.
install(TARGETS connectivity EXPORT connectivity-targets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT connectivity_runtime
        NAMELINK_COMPONENT connectivity_development
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
file(GLOB c_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/capi/connectivity*.h")
install(FILES ${c_headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    COMPONENT connectivity_development)
install(FILES "${PROJECT_SOURCE_DIR}/include/connectivity/base/status.h"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/connectivity/base"
    COMPONENT connectivity_development)
install(EXPORT connectivity-targets NAMESPACE connectivity:: DESTINATION "${package_dir}"
    COMPONENT connectivity_development)

# C++: archive and headers. Those of io belong to the program, which alone has their code.
install(TARGETS connectivity_static EXPORT connectivity-cxx-targets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT connectivity_cxx
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/connectivity"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT connectivity_cxx
    FILES_MATCHING PATTERN "*.hpp" PATTERN io EXCLUDE)
install(EXPORT connectivity-cxx-targets NAMESPACE connectivity:: DESTINATION "${package_dir}"
    COMPONENT connectivity_cxx)

# find_package. While the version is 0.x every minor version may break.
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
else()
    set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/connectivityConfigVersion.cmake"
    COMPATIBILITY ${compatibility})
foreach(file IN ITEMS connectivityConfig connectivity-cxx)
    configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/${file}.cmake.in"
        "${PROJECT_BINARY_DIR}/package/${file}.cmake" INSTALL_DESTINATION "${package_dir}"
        NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
endforeach()
install(FILES "${PROJECT_BINARY_DIR}/package/connectivityConfig.cmake"
    "${PROJECT_BINARY_DIR}/package/connectivityConfigVersion.cmake"
    DESTINATION "${package_dir}" COMPONENT connectivity_development)
install(FILES "${PROJECT_BINARY_DIR}/package/connectivity-cxx.cmake"
    DESTINATION "${package_dir}" COMPONENT connectivity_cxx)

include(PkgConfig)
include(InstallFortran)

if(TARGET connectivity_command)
    set_target_properties(connectivity_command PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
    install(TARGETS connectivity_command
        RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT connectivity_program)
endif()

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
    "${PROJECT_SOURCE_DIR}/capi/CHANGELOG.md"
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT connectivity_doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/capi/examples"
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT connectivity_doc)

# Pages that the target docs has made; those of struct members would be called h.3 and the like.
install(DIRECTORY "${PROJECT_BINARY_DIR}/docs/html" OPTIONAL
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT connectivity_doc)
install(DIRECTORY "${PROJECT_BINARY_DIR}/docs/man/man3" OPTIONAL
    DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT connectivity_doc
    FILES_MATCHING REGEX "/(conn_|CONN_|connectivity)[^/]*\\.3$")
