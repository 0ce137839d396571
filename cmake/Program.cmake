# SPDX-License-Identifier: BSD-3-Clause
# The command line program and the readers and writers it uses: build/connectivity. Only these
# two layers link HDF5. All of the program but main.cpp is a library, so that tests reach it.

connectivity_layer(io)
connectivity_layer(program)
if(NOT TARGET connectivity_program OR NOT TARGET connectivity_io)
    message(STATUS "src/io or src/program has no sources: the program is not built")
    return()
endif()

find_package(HDF5 REQUIRED COMPONENTS C)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3 REQUIRED)

target_link_libraries(connectivity_io PUBLIC hdf5::hdf5 fmt::fmt
    PRIVATE nlohmann_json::nlohmann_json)
target_link_libraries(connectivity_program PUBLIC hdf5::hdf5 fmt::fmt CLI11::CLI11)

add_library(connectivity_app STATIC $<TARGET_OBJECTS:connectivity_io>
            $<FILTER:$<TARGET_OBJECTS:connectivity_program>,EXCLUDE,/main\\.cpp\\.o$>)
set_target_properties(connectivity_app PROPERTIES LINKER_LANGUAGE CXX)
target_include_directories(connectivity_app PUBLIC "${PROJECT_SOURCE_DIR}/src")
target_link_libraries(connectivity_app PUBLIC connectivity_static hdf5::hdf5 fmt::fmt CLI11::CLI11)

add_executable(connectivity_command
    $<FILTER:$<TARGET_OBJECTS:connectivity_program>,INCLUDE,/main\\.cpp\\.o$>)
set_target_properties(connectivity_command PROPERTIES OUTPUT_NAME connectivity LINKER_LANGUAGE CXX
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
target_link_libraries(connectivity_command PRIVATE connectivity_app connectivity_flags)
