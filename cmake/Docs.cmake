# SPDX-License-Identifier: BSD-3-Clause
# Target docs, where Doxygen is: docs/html and docs/man in the build directory, from the C headers.
# A warning of Doxygen is an error. Pages that were made are installed.

set(docs_dir "${PROJECT_BINARY_DIR}/docs")
find_program(DOXYGEN doxygen)
mark_as_advanced(DOXYGEN)
if(DOXYGEN)
    file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/capi/connectivity*.h")
    list(JOIN headers "\" \"" docs_input)
    set(docs_input "\"${docs_input}\"")
    configure_file("${PROJECT_SOURCE_DIR}/cmake/Doxyfile.in" "${docs_dir}/Doxyfile" @ONLY)
    add_custom_target(docs COMMAND "${DOXYGEN}" "${docs_dir}/Doxyfile" VERBATIM
        COMMENT "Reference of the C interface: docs/html/index.html, docs/man")
endif()
