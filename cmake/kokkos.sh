#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Finds a usable Kokkos, or builds one from source into a cache outside every build tree, and
# prints the directory of its KokkosConfig.cmake. Messages go to stderr. No root needed.
#
#   sh kokkos.sh [--cxx COMPILER] [--kind private|shared] [--sanitize thread] [--find-only]
#                [-DHINT=VALUE]...
#
# The order: what find_package finds; the cache; then sources: the pinned release, the sdist of
# pykokkos-base (3.5 MB), Debian's source package of trilinos (166 MB); both carry Kokkos 3.4.01.
# The cache is ${CONNECTIVITY_CACHE:-${XDG_CACHE_HOME:-~/.cache}}/libconnectivity. A build happens
# in a temporary folder there and is renamed when it is complete, so a killed one leaves no trace.
set -eu

release=4.6.01
release_commit=1b1383c6001f3bfe9fe309ca923c2d786600cc79
release_url=https://github.com/kokkos/kokkos/archive/$release_commit.tar.gz
sdist=pykokkos-base
sdist_version=0.0.7
sdist_sha256=6339daced1e81a2748f381847d8717cd77d824407da3c263b9491b5630c642b0

cxx=${CXX:-c++}
kind=private
sanitize=
find_only=no
here=$(cd "$(dirname "$0")" && pwd)

say() { echo "-- kokkos: $*" >&2; }

while [ $# -gt 0 ]; do
    case $1 in
    --cxx) cxx=$2; shift 2 ;;
    --kind) kind=$2; shift 2 ;;
    --sanitize) sanitize=$2; shift 2 ;;
    --find-only) find_only=yes; shift ;;
    -D*) break ;;
    *) say "unknown argument $1"; exit 2 ;;
    esac
done # what is left are hints for CMake

cache=${CONNECTIVITY_CACHE:-${XDG_CACHE_HOME:-${HOME:-/var/tmp}/.cache}}/libconnectivity
mkdir -p "$cache" && cache=$(cd "$cache" && pwd)
find "$cache" -maxdepth 1 -name 'work.*' -mtime +1 -exec rm -rf {} + # of killed runs
work=$(mktemp -d "$cache/work.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

compiler=$(printf '#ifdef __clang__\nclang __clang_major__\n#else\ngnu __GNUC__\n#endif\n' |
    "$cxx" -E -P -x c++ - | tr -d ' \n')
backends=serial-openmp
[ "$kind" = private ] || backends=$backends-shared
[ -z "$sanitize" ] || backends=$backends-$sanitize-sanitizer

# probe [-DHINT=VALUE]...: prints the directory of the Kokkos that CMake finds, if we can use it.
probe() {
    rm -rf "$work/probe"
    if cmake -S "$here/kokkos_probe" -B "$work/probe" -DCMAKE_CXX_COMPILER="$cxx" \
        -DKIND="$kind" "$@" > "$work/probe.log" 2>&1; then
        cat "$work/probe/answer"
    else
        sed -n 's/^CMake Error: /-- kokkos:     /p; s/^  */-- kokkos:     /p' "$work/probe.log" >&2
        return 1
    fi
}

find_cached() {
    for prefix in $(ls -d "$cache"/kokkos-*-"$compiler-$backends" 2>/dev/null | sort -rV); do
        case $kind:$prefix in shared:*/kokkos-[0-3].* | shared:*/kokkos-4.[0-3].*) continue ;; esac
        if [ -f "$prefix/lib/cmake/Kokkos/KokkosConfig.cmake" ]; then
            echo "$prefix/lib/cmake/Kokkos"
            return 0
        fi
    done
    return 1
}

# The sources below each put the Kokkos tree into $work/source or fail.

from_release() {
    say "source 1: the Kokkos release $release, by commit (newest; needs the open network)"
    cat > "$work/download.cmake" <<'END'
file(DOWNLOAD "${URL}" "${FILE}" INACTIVITY_TIMEOUT 10 TIMEOUT 300 TLS_VERIFY ON STATUS status)
list(GET status 0 code)
if(code)
    list(GET status 1 text)
    message(FATAL_ERROR "${text}")
endif()
END
    log=$work/download.log
    cmake -DURL="$release_url" -DFILE="$work/release.tar.gz" -P "$work/download.cmake" \
        > "$log" 2>&1 &&
        mkdir "$work/source" &&
        tar -xzf "$work/release.tar.gz" -C "$work/source" --strip-components=1
}

# pip asks a source distribution for its metadata even if it is only downloaded. This one's setup
# needs scikit-build for that; a one-line stand-in saves installing it, and if that is not enough
# pip may install the real one into an environment it throws away.
from_sdist() {
    say "source 2: the source distribution $sdist $sdist_version, which carries Kokkos 3.4.01"
    mkdir "$work/sdist" "$work/standin"
    echo 'from setuptools import setup' > "$work/standin/skbuild.py"
    set -- download --quiet --retries 1 --timeout 20 --no-deps --no-binary :all: \
        --dest "$work/sdist" "$sdist==$sdist_version"
    log=$work/pip.log
    PYTHONPATH=$work/standin python3 -m pip "$@" --no-build-isolation > "$log" 2>&1 ||
        python3 -m pip "$@" >> "$log" 2>&1 || return 1
    archive=$work/sdist/$sdist-$sdist_version.tar.gz
    echo "$sdist_sha256  $archive" | sha256sum --check --quiet >&2 || return 1
    mkdir "$work/source"
    tar -xzf "$archive" -C "$work/source" --strip-components=3 \
        "$sdist-$sdist_version/external/kokkos"
}

# The machine's apt lists, turned into source lists in a private folder: the system's own
# configuration and state stay as they are, and no root is needed.
from_trilinos() {
    say "source 3: Debian's source package trilinos, which carries Kokkos 3.4.01 (166 MB)"
    apt=$work/apt
    mkdir -p "$apt/sources" "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/download"
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
        [ -f "$list" ] || continue
        private=$apt/sources/$(basename "$list")
        case $list in
        *.list) sed -n 's/^deb[[:space:]]/deb-src /p' "$list" > "$private" ;;
        *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" > "$private" ;;
        esac
    done
    set -- -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$apt/sources" \
        -o Dir::State::Lists="$apt/lists" -o Dir::Cache="$apt/cache" -o APT::Sandbox::User=
    log=$work/apt.log
    apt-get "$@" update > "$log" 2>&1 || true # one dead list is no reason to stop
    (cd "$apt/download" && apt-get "$@" source --download-only trilinos) >> "$log" 2>&1 ||
        return 1
    mkdir "$work/source"
    tar -xf "$apt"/download/trilinos_*.orig.tar.* -C "$work/source" --strip-components=3 \
        --wildcards '*/packages/kokkos/*'
}

version_of_source() {
    sed -n 's/^ *set *( *Kokkos_VERSION_\(MAJOR\|MINOR\|PATCH\) *\([0-9]*\) *).*/\2/Ip' \
        "$work/source/CMakeLists.txt" | paste -s -d. -
}

# Serial and OpenMP, position independent; without what Kokkos has deprecated, so that code that
# compiles against this version does so against the next.
build() {
    prefix=$cache/kokkos-$(version_of_source)-$compiler-$backends
    [ "$kind" = shared ] && shared=ON || shared=OFF
    log=$work/build.log
    say "building $(basename "$prefix")"
    cmake -S "$work/source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_STANDARD=17 -DCMAKE_CXX_EXTENSIONS=OFF \
        ${sanitize:+"-DCMAKE_CXX_FLAGS=-fsanitize=$sanitize -g1"} \
        -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=$shared \
        -DKokkos_ENABLE_SERIAL=ON -DKokkos_ENABLE_OPENMP=ON -DKokkos_ENABLE_TESTS=OFF \
        -DKokkos_ENABLE_DEPRECATED_CODE_3=OFF -DKokkos_ENABLE_DEPRECATED_CODE_4=OFF \
        -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_PREFIX="$prefix" > "$log" 2>&1 &&
        cmake --build "$work/build" -j "$(nproc)" >> "$log" 2>&1 &&
        DESTDIR=$work/stage cmake --install "$work/build" >> "$log" 2>&1 || return 1
    [ -d "$prefix" ] || mv "$work/stage$prefix" "$prefix"
}

# Debian's cmake brings no make.
if command -v ninja > /dev/null; then
    CMAKE_GENERATOR=Ninja
    export CMAKE_GENERATOR
fi

# ThreadSanitizer must see every access, so an installed one will not do.
if [ -z "$sanitize" ]; then
    say "is one installed that we can use?"
    if probe "$@"; then exit 0; fi
fi

say "is one in the cache $cache?"
if find_cached; then exit 0; fi
if [ "$find_only" = yes ]; then
    say "no, and building one is switched off"
    exit 1
fi

say "no: taking its source and building it; this happens once"
sources="from_release from_sdist from_trilinos"
if [ "$kind" = shared ]; then
    sources=from_release
    say "    only the release: the others carry 3.4.01, and a shared Kokkos must be 4.4 or newer,"
    say "    as this library hides its symbols"
fi
for source in $sources; do
    rm -rf "$work/source" "$work/build" "$work/stage"
    log=/dev/null
    if "$source" && build; then
        find_cached
        exit 0
    fi
    say "    that failed; the end of its log:"
    tail -n 8 "$log" >&2
done
say "no source of Kokkos could be reached"
exit 1
