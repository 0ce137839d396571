# SPDX-License-Identifier: BSD-3-Clause
# Installs the Fortran module in component connectivity_fortran: its source always, so that a host
# builds it where no compiler was at hand here; archive, .mod and connectivity-fortran.pc if built.

set(fortran_source_dir "${CMAKE_INSTALL_DATADIR}/connectivity/fortran")
string(REGEX MATCH "^[0-9]+" major "${CMAKE_Fortran_COMPILER_VERSION}")
string(TOLOWER "${CMAKE_Fortran_COMPILER_ID}-${major}" compiler)
set(fortran_module_dir "${CMAKE_INSTALL_LIBDIR}/connectivity/fortran/${compiler}")

install(DIRECTORY "${CONNECTIVITY_FORTRAN_DIR}/" DESTINATION "${fortran_source_dir}"
    COMPONENT connectivity_fortran)
install(FILES "${CONNECTIVITY_FORTRAN_STATUS}" DESTINATION "${fortran_source_dir}"
    COMPONENT connectivity_fortran)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/connectivity-fortran.cmake.in"
    "${PROJECT_BINARY_DIR}/package/connectivity-fortran.cmake" INSTALL_DESTINATION "${package_dir}"
    PATH_VARS fortran_source_dir NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
install(FILES "${PROJECT_BINARY_DIR}/package/connectivity-fortran.cmake"
    DESTINATION "${package_dir}" COMPONENT connectivity_fortran)

if(TARGET connectivity_fortran)
    install(TARGETS connectivity_fortran EXPORT connectivity-fortran-targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT connectivity_fortran
        INCLUDES DESTINATION "${fortran_module_dir}")
    install(DIRECTORY "${PROJECT_BINARY_DIR}/fortran/modules/"
        DESTINATION "${fortran_module_dir}" COMPONENT connectivity_fortran)
    install(EXPORT connectivity-fortran-targets NAMESPACE connectivity::
        DESTINATION "${package_dir}" COMPONENT connectivity_fortran)
    connectivity_pkg_config(connectivity-fortran connectivity_fortran)
endif()
