#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The binary interface against the stored dump capi/abi/libconnectivity.abi: no function may go or
# change. What is dumped is a library of empty functions made from the headers alone, with debug
# information whatever the build type; that libconnectivity.so has exactly these functions is the
# test of exports, that C++ agrees with the headers is the compiler's and capi/layout.cpp's.
# Usage: abi.sh check|store CC SOURCE_DIR. Exit status 77: cannot be checked here.
set -eu
export LC_ALL=C
what=$1 cc=$2 root=$3
stored=$root/capi/abi/libconnectivity.abi

for tool in abidw abidiff; do
    command -v $tool > /dev/null || { echo "skipped: no $tool here (Debian: abigail-tools)"; exit 77; }
done
case $($cc -dumpmachine) in
x86_64*linux*) ;;
*) echo "skipped: the dump is of x86_64, this is another machine"; exit 77 ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

printf '#include <%s>\n' connectivity.h connectivity_boundary.h connectivity_query.h \
    connectivity_tree.h connectivity_lists.h connectivity_gravity.h > "$work/all.c"
"$cc" -std=c99 -E -P -I"$root/capi" -I"$root/include" "$work/all.c" |
    awk 'BEGIN { RS = ";" }
        /visibility\("default"\)/ { print $0 (/void conn_set_error/ ? " {}" : " { return 0; }"); next }
        NF { print $0 ";" }' > "$work/empty.c"
soname=libconnectivity.so.$(sed -n 's/^#define CONN_VERSION_MAJOR //p' \
    "$root/capi/connectivity_base.h")
(cd "$work" && "$cc" -std=c99 -w -g -O0 -fPIC -shared "-Wl,-soname,$soname" empty.c \
    -o libconnectivity.so)

if [ "$what" = store ]; then
    mkdir -p "$(dirname "$stored")"
    abidw --no-corpus-path --no-comp-dir-path --no-show-locs --type-id-style hash \
        --out-file "$stored" "$work/libconnectivity.so"
    exit 0
fi

status=0
abidiff --no-show-locs "$stored" "$work/libconnectivity.so" > "$work/changes" || status=$?
# Bit 8 is what abidiff is sure breaks hosts: a function or the soname has gone. Types that changed
# are bit 4, as are functions that came, which break nobody.
if [ $((status & 11)) -ne 0 ] ||
    ! { [ $status -eq 0 ] || grep -q '^Functions.*: 0 Removed, 0 Changed' "$work/changes"; }; then
    cat "$work/changes"
    echo "The binary interface changed. Before 1.0, or if all that changed is that a struct with a"
    echo "struct_size grew at its end, say so in capi/CHANGELOG.md and refresh the dump:"
    echo "    sh tests/capi/abi.sh store $cc $root"
    exit 1
fi
