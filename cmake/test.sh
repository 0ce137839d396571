#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds everything and runs the tests, on a machine where nothing is installed yet.
#   sh cmake/test.sh              all tests but those labelled slow
#   sh cmake/test.sh --all        those too
#   sh cmake/test.sh --sanitize   with AddressSanitizer and UBSan, in build-sanitize/
set -eu

cd "$(dirname "$0")/.."
build=build
options="-DCONNECTIVITY_SANITIZE=OFF"
skip="-LE slow"
for argument in "$@"; do
    case $argument in
    --all) skip= ;;
    --sanitize) build=build-sanitize options="-DCONNECTIVITY_SANITIZE=ON" ;;
    *) echo "unknown argument $argument; known: --all, --sanitize" >&2; exit 2 ;;
    esac
done

echo "== 1/3 dependencies"
sh cmake/dependencies.sh --tests

echo "== 2/3 building everything into $build/"
[ -f "$build/CMakeCache.txt" ] || options="$options -G Ninja"
cmake -S . -B "$build" $options
cmake --build "$build" -j "$(nproc)"

echo "== 3/3 tests"
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" $skip
