#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# One check of the installed tree. Usage: package.sh CHECK, with the environment that CMakeLists.txt
# sets: SOURCE (this folder), ROOT (the clone), BUILD, PREFIX, WORK, CMAKE, GENERATOR, CC, CXX, FC,
# PYTHON, NM, KOKKOS_DIR, LIBDIR (below the prefix). Exit status 77: cannot be checked here.
set -eu

check=$1
dir=$WORK/$check
export LC_ALL=C CC CXX FC
unset LD_LIBRARY_PATH PKG_CONFIG_PATH CMAKE_PREFIX_PATH # only the prefix is to be found
rm -rf "$dir"
mkdir -p "$dir"

skip() { echo "skipped: $*"; exit 77; }
need() { command -v "$1" > /dev/null || skip "there is no $1 on this machine"; }
fail() { echo "$*" >&2; exit 1; }

# expect TEXT COMMAND...: runs it and compares its output.
expect() {
    text=$1
    shift
    found=$("$@")
    [ "$found" = "$text" ] || fail "expected '$text', got '$found'"
}

# configure NAME [-DOPTION]...: the project tests/package/NAME, in $dir/NAME.
configure() {
    project=$1
    shift
    "$CMAKE" -S "$SOURCE/$project" -B "$dir/$project" -G "$GENERATOR" "$@" > "$dir/log" 2>&1 || {
        cat "$dir/log"
        return 1
    }
}

# build NAME [-DOPTION]...: configures it with the prefix and builds it.
build() {
    configure "$@" -DCMAKE_PREFIX_PATH="$PREFIX" -DCMAKE_BUILD_TYPE=Release
    "$CMAKE" --build "$dir/$1"
}

use_pkg_config() {
    need pkg-config
    export PKG_CONFIG_LIBDIR="$PREFIX/$LIBDIR/pkgconfig" # instead of the system's
}

pairs_text="7560 pairs, version $VERSION" # 3 m²(m-1) + 6 m (m-1)² for m = 10

c_by_find_package() {
    build c -DCMAKE_DISABLE_FIND_PACKAGE_Kokkos=ON
    expect "$pairs_text" "$dir/c/pairs"
}

c_by_pkg_config() {
    use_pkg_config
    expect "$VERSION" pkg-config --modversion connectivity
    $CC "$SOURCE/c/pairs.c" -o "$dir/pairs" $(pkg-config --cflags --libs connectivity)
    expect "$pairs_text" env LD_LIBRARY_PATH="$PREFIX/$LIBDIR" "$dir/pairs"
}

need_fortran() {
    [ -n "$FC" ] || skip "the build has no Fortran module"
}

fortran_by_find_package() {
    build fortran "$@"
    expect "$pairs_text" "$dir/fortran/pairs"
}

fortran_by_pkg_config() {
    use_pkg_config
    expect "$VERSION" pkg-config --modversion connectivity-fortran
    $FC "$SOURCE/fortran/pairs.F90" -o "$dir/pairs" \
        $(pkg-config --cflags --libs connectivity-fortran)
    expect "$pairs_text" env LD_LIBRARY_PATH="$PREFIX/$LIBDIR" "$dir/pairs"
}

configure_subproject() {
    configure subproject -DCONNECTIVITY_SOURCE="$ROOT" -DKokkos_DIR="$KOKKOS_DIR" "$@"
}

case $check in
install)
    rm -rf "$PREFIX"
    "$CMAKE" --install "$BUILD" --prefix "$PREFIX" > "$dir/log"
    for file in LICENSE README.md examples/c/neighbours.c; do
        [ -f "$PREFIX/share/doc/connectivity/$file" ] || fail "$file is not installed"
    done
    [ ! -x "$BUILD/connectivity" ] || expect "connectivity $VERSION" "$PREFIX/bin/connectivity" --version
    ;;
c_by_find_package) c_by_find_package ;;
c_by_pkg_config) c_by_pkg_config ;;
c_linked_statically)
    use_pkg_config
    # -static makes the linker take the archive, so that Libs.private is needed.
    $CC -static "$SOURCE/c/pairs.c" -o "$dir/pairs" \
        $(pkg-config --static --cflags --libs connectivity) 2> "$dir/log" || fail "$(cat "$dir/log")"
    expect "$pairs_text" "$dir/pairs"
    ;;
cxx_by_find_package)
    build cxx
    expect "7560 pairs" "$dir/cxx/pairs"
    ;;
fortran_by_find_package)
    need_fortran
    fortran_by_find_package
    ;;
fortran_by_pkg_config)
    need_fortran
    fortran_by_pkg_config
    ;;
fortran_from_source)
    # A module file of another compiler is one that this compiler cannot read.
    need_fortran
    cp -a "$PREFIX" "$dir/prefix"
    PREFIX=$dir/prefix
    for module in "$PREFIX/$LIBDIR"/connectivity/fortran/*/*.mod; do
        echo "of another compiler" > "$module"
    done
    fortran_by_find_package -DFROM_SOURCE=ON
    # A library that was installed where there was no Fortran compiler.
    rm "$PREFIX/$LIBDIR"/cmake/connectivity/connectivity-fortran-targets*.cmake
    rm -r "$PREFIX/$LIBDIR/connectivity/fortran" "$PREFIX/$LIBDIR/libconnectivity_fortran.a"
    rm -r "$dir/fortran"
    fortran_by_find_package -DFROM_SOURCE=ON
    ;;
examples)
    "$CMAKE" -S "$PREFIX/share/doc/connectivity/examples" -B "$dir/build" -G "$GENERATOR" \
        -DCMAKE_PREFIX_PATH="$PREFIX" > "$dir/log" || fail "$(cat "$dir/log")"
    "$CMAKE" --build "$dir/build"
    set -- "$dir/build/neighbours_c"
    [ -z "$FC" ] || set -- "$@" "$dir/build/neighbours_fortran"
    sh "$ROOT/tests/fortran/examples.sh" \
        "$PREFIX/share/doc/connectivity/examples/python/neighbours.py" \
        "$PREFIX/$LIBDIR/libconnectivity.so.${VERSION%%.*}" "$PYTHON" "$@"
    ;;
python_by_dlopen)
    expect "$pairs_text" "$PYTHON" "$SOURCE/python/pairs.py" "$PREFIX/$LIBDIR/libconnectivity.so.${VERSION%%.*}"
    "$PYTHON" "$SOURCE/python/structs.py" "$PREFIX/include" "$PREFIX/$LIBDIR/libconnectivity.so"
    ;;
moved)
    # A copy elsewhere works, and nothing in it names the place it was made for.
    cp -a "$PREFIX" "$dir/elsewhere"
    if grep -rlF "$PREFIX" "$dir/elsewhere"; then fail "these name the prefix"; fi
    PREFIX=$dir/elsewhere
    c_by_find_package
    [ -z "$FC" ] || fortran_by_find_package
    if command -v pkg-config > /dev/null; then
        c_by_pkg_config
        [ -z "$FC" ] || fortran_by_pkg_config
    fi
    ;;
headers) build headers ;;
exports)
    library=$PREFIX/$LIBDIR/libconnectivity.so
    sh "$ROOT/tests/capi/exports.sh" symbols "$NM" "$library" "$ROOT/capi/symbols.txt"
    [ "$KOKKOS" = shared ] || sh "$ROOT/tests/capi/exports.sh" needs "$library"
    ;;
the_c_package_names_no_other)
    package=$PREFIX/$LIBDIR/cmake/connectivity
    if grep -i -e kokkos -e eigen -e hdf5 "$package"/connectivityConfig*.cmake \
        "$package"/connectivity-targets*.cmake; then
        fail "these need another package"
    fi
    ;;
reference)
    # Once more, and elsewhere: warnings of Doxygen are errors.
    [ -f "$BUILD/docs/Doxyfile" ] || skip "there was no doxygen when the build was configured"
    { cat "$BUILD/docs/Doxyfile"; echo "OUTPUT_DIRECTORY = \"$dir\""; } | doxygen -
    for page in connectivity.h conn_map_rebuild conn_array; do
        [ -f "$dir/man/man3/$page.3" ] || fail "there is no man page of $page"
    done
    ;;
components)
    set -- -DCMAKE_PREFIX_PATH="$PREFIX"
    configure components "$@" -DARGUMENTS="0.1;COMPONENTS;c;cxx" -DEXPECT=ON
    rm -r "$dir/components"
    configure components "$@" -DARGUMENTS="COMPONENTS;banana" -DMESSAGE="'banana' is unknown"
    rm -r "$dir/components"
    configure components "$@" -DARGUMENTS="OPTIONAL_COMPONENTS;banana" -DEXPECT=ON
    rm -r "$dir/components"
    configure components "$@" -DARGUMENTS="COMPONENTS;cxx" \
        -DCMAKE_DISABLE_FIND_PACKAGE_Kokkos=ON -DMESSAGE="needs the Kokkos"
    rm -r "$dir/components"
    configure components "$@" -DARGUMENTS="COMPONENTS;fortran" -DMESSAGE="with Fortran among"
    for version in 0.2 1 99; do
        rm -r "$dir/components"
        configure components "$@" -DARGUMENTS="$version"
    done
    ;;
subproject_is_configured)
    for fetch in ON OFF; do
        configure_subproject -DFETCH=$fetch
        if find "$dir/subproject" -name cmake_install.cmake -exec grep -l libconnectivity {} + |
            grep .; then
            fail "the library would be installed with its host"
        fi
        rm -r "$dir/subproject"
    done
    ;;
subproject_is_built)
    configure_subproject -DCMAKE_BUILD_TYPE=Release ${FC:+-DFORTRAN=ON}
    "$CMAKE" --build "$dir/subproject"
    expect "$pairs_text" "$dir/subproject/pairs"
    [ -z "$FC" ] || expect "$pairs_text" "$dir/subproject/fortran_pairs"
    expect "7560 pairs" "$dir/subproject/cxx_pairs"
    ;;
*) fail "unknown check $check" ;;
esac
