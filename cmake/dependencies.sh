#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is needed on Debian and its relatives: packages that are missing, then a Kokkos with
# OpenMP if there is none. Safe to run again: what is there is left alone. Elsewhere install the
# same things by hand; nothing else here is Debian's.
#   sh cmake/dependencies.sh           for the libraries, the program, unit tests and benchmarks
#   sh cmake/dependencies.sh --tests   also for hosts in other languages, the reference, ABI checks
#   sh cmake/dependencies.sh --clang   also clang with its fuzzer, sanitizers and OpenMP
set -eu

here=$(cd "$(dirname "$0")" && pwd)
say() { echo "== $*" >&2; }

packages="
    g++ cmake ninja-build
    libeigen3-dev
    libhdf5-dev libfmt-dev libcli11-dev nlohmann-json3-dev gnuplot-nox
    libgtest-dev libbenchmark-dev libnanoflann-dev python3
    ca-certificates python3-pip python3-setuptools"
# First line: compiler and build. Then small dense algebra, the program, the tests and the
# benchmarks, and what kokkos.sh downloads with.

cxx=
case ${1:-} in
--tests) packages="$packages gfortran pkg-config python3-numpy doxygen abigail-tools" ;;
--clang) packages="$packages clang libclang-rt-dev libomp-dev" cxx=clang++ ;;
'') ;;
*) echo "unknown argument $1; known: --tests, --clang" >&2; exit 2 ;;
esac

as_root() {
    if [ "$(id -u)" = 0 ]; then
        env LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"
    elif command -v sudo > /dev/null; then
        sudo env LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"
    else
        say "these packages need root or sudo; as root: apt-get install$missing"
        exit 1
    fi
}

is_installed() {
    dpkg-query -W -f '${Status}' "$1" 2> /dev/null | grep -q 'ok installed'
}

install_missing() {
    as_root apt-get install --yes --no-install-recommends \
        -o DPkg::Lock::Timeout=120 $missing > "$log" 2>&1
}

log=$(mktemp)
trap 'rm -f "$log"' EXIT

if command -v apt-get > /dev/null; then
    missing=
    for package in $packages; do
        is_installed "$package" || missing="$missing $package"
    done
    if [ -n "$missing" ]; then
        say "installing packages:$missing"
        # The lists may be absent or stale; refreshing them is needed only then.
        install_missing || { as_root apt-get update > "$log" 2>&1 && install_missing; } || {
            cat "$log" >&2
            exit 1
        }
    else
        say "all packages are installed"
    fi
    # Distributions that package Kokkos itself, newer than the one inside trilinos.
    candidate=$(LC_ALL=C apt-cache policy libkokkos-dev 2> /dev/null |
        sed -n 's/^ *Candidate: *//p')
    if [ -n "$candidate" ] && [ "$candidate" != "(none)" ] && ! is_installed libkokkos-dev; then
        say "installing the distribution's Kokkos $candidate"
        missing=" libkokkos-dev"
        install_missing || cat "$log" >&2
    fi
else
    say "no apt-get here: assuming that$(echo $packages | sed 's/^/ /') or their like are installed"
fi

say "looking for Kokkos"
kokkos=$(sh "$here/kokkos.sh" ${cxx:+--cxx "$cxx"})
say "Kokkos: $kokkos"
