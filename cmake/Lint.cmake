# SPDX-License-Identifier: BSD-3-Clause
# Two targets for developers, made where the tools exist: `format` rewrites our files by
# .clang-format, `tidy` runs .clang-tidy over what is compiled. No build or test needs them.

find_program(CLANG_FORMAT clang-format)
find_program(RUN_CLANG_TIDY run-clang-tidy)
mark_as_advanced(CLANG_FORMAT RUN_CLANG_TIDY)
set(folders include src capi tests bench)

if(CLANG_FORMAT)
    set(globs ${folders})
    list(TRANSFORM globs REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/\\1/*.[ch]pp")
    set(c_globs ${folders})
    list(TRANSFORM c_globs REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/\\1/*.[ch]")
    file(GLOB_RECURSE files ${globs} ${c_globs})
    if(files)
        add_custom_target(format COMMAND "${CLANG_FORMAT}" -i ${files} VERBATIM)
    endif()
endif()
if(RUN_CLANG_TIDY)
    list(JOIN folders "|" any_folder)
    add_custom_target(tidy VERBATIM COMMAND "${RUN_CLANG_TIDY}" -quiet -p "${PROJECT_BINARY_DIR}"
        "${PROJECT_SOURCE_DIR}/(${any_folder})/.*")
endif()
