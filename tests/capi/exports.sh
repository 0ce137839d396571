#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What libconnectivity.so shows to others: the functions of capi/symbols.txt and no more, and no
# dependency on Kokkos, MPI or HDF5. Functions of experimental headers are listed, too, but
# connectivity.h with its parts has at most 60.
# Usage: exports.sh symbols NM LIBRARY SYMBOLS_TXT | exports.sh limit CAPI | exports.sh needs LIBRARY
set -eu
export LC_ALL=C

case $1 in
symbols)
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    # Column 2 is the type; A is the version node. Data symbols would be a mistake of their own.
    "$2" -D --defined-only "$3" | awk '$2 != "A" { sub(/@.*/, "", $3); print $2, $3 }' |
        sort > "$work/found"
    sed 's/^/T /' "$4" | sort > "$work/expected"
    diff "$work/expected" "$work/found"
    ;;
limit)
    parts=$(sed -n 's/^#include "\(.*\)"$/\1/p' "$2/connectivity.h")
    n=$(cd "$2" && cat $parts | grep -c '^CONN_API ')
    echo "connectivity.h has $n functions"
    test "$n" -ge 1 && test "$n" -le 60
    ;;
needs)
    command -v ldd > /dev/null || { echo "no ldd on this machine"; exit 77; }
    if ldd "$2" | grep -i -e kokkos -e mpi -e hdf5; then
        echo "these must not be needed"
        exit 1
    fi
    ;;
*)
    exit 2
    ;;
esac
