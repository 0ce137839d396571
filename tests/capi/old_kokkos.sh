#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Configures the project with CONNECTIVITY_KOKKOS=shared and a package that calls itself Kokkos of
# some version: 3.4.01 and 4.3 must be refused with the reason, by kokkos.sh and where a project
# around this one has it; 4.4 must not be refused.
# Usage: old_kokkos.sh CMAKE GENERATOR CXX SOURCE_DIR WORK_DIR
set -eu
cmake=$1 generator=$2 cxx=$3 source=$4 work=$5
rm -rf "$work"
mkdir -p "$work/cache"

# package VERSION: a shared library without anything in it.
package() {
    mkdir -p "$work/$1"
    : > "$work/$1/libkokkoscore.so"
    cat > "$work/$1/KokkosConfig.cmake" <<END
set(Kokkos_DEVICES OPENMP SERIAL)
add_library(Kokkos::kokkoscore SHARED IMPORTED)
set_target_properties(Kokkos::kokkoscore PROPERTIES
    IMPORTED_LOCATION "\${CMAKE_CURRENT_LIST_DIR}/libkokkoscore.so")
add_library(Kokkos::kokkos INTERFACE IMPORTED)
END
    cat > "$work/$1/KokkosConfigVersion.cmake" <<END
set(PACKAGE_VERSION $1)
set(PACKAGE_VERSION_COMPATIBLE TRUE)
END
}

# configure VERSION [-DOPTION]...: what CMake says in $work/log, on one line.
configure() {
    version=$1
    shift
    rm -rf "$work/build"
    status=0
    CONNECTIVITY_CACHE=$work/cache "$cmake" -S "$source" -B "$work/build" -G "$generator" \
        -DCMAKE_CXX_COMPILER="$cxx" -DCONNECTIVITY_KOKKOS=shared \
        -DCONNECTIVITY_FETCH_KOKKOS=OFF -DKokkos_DIR="$work/$version" \
        -DCONNECTIVITY_BUILD_TESTS=OFF -DCONNECTIVITY_BUILD_BENCH=OFF \
        -DCONNECTIVITY_BUILD_PROGRAM=OFF "$@" > "$work/lines" 2>&1 || status=$?
    tr -s '\n ' ' ' < "$work/lines" | sed 's/ -- kokkos: / /g' > "$work/log"
    return $status
}

fail() { echo "$*"; cat "$work/lines"; exit 1; }

for version in 3.4.01 4.3.00; do
    package $version
    # The first asks kokkos.sh; the second has an answer already.
    for answer in "" "shared:$work/$version"; do
        if configure $version -DCONNECTIVITY_KOKKOS_ANSWER="$answer"; then
            fail "Kokkos $version was accepted"
        fi
        grep -q "$version.*4\.4.*hides its symbols\|4\.4.*$version.*hides its symbols" \
            "$work/log" || fail "the reason is missing"
    done
done
package 4.4.00
configure 4.4.00 || true # there is nothing in it to compile with
grep -q 'Kokkos 4\.4\.00 (shared' "$work/log" || fail "Kokkos 4.4 was refused"
