#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds everything and runs the tests, on a machine where nothing is installed yet.
#   sh cmake/test.sh                    all tests but those labelled slow
#   sh cmake/test.sh --all              those too
#   sh cmake/test.sh --sanitize         with AddressSanitizer and UBSan, in build-sanitize/
#   sh cmake/test.sh --sanitize=thread  host threads, map and search under ThreadSanitizer, with
#                                       clang, in build-threads/
#   sh cmake/test.sh --fuzz[=N]         the fuzzers, N inputs each (2000), with clang, in
#                                       build-fuzz/; what they find is named build-fuzz/found-*
set -eu

cd "$(dirname "$0")/.."
build=build
options="-DCONNECTIVITY_SANITIZE=OFF"
clang="-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCONNECTIVITY_BUILD_BENCH=OFF"
dependencies=--tests
targets=all
select="-LE slow"
for argument in "$@"; do
    case $argument in
    --all) select= ;;
    --sanitize | --sanitize=address)
        build=build-sanitize options="-DCONNECTIVITY_SANITIZE=address" ;;
    --sanitize=thread)
        build=build-threads options="-DCONNECTIVITY_SANITIZE=thread $clang" dependencies=--clang
        targets="test_threads test_map test_search" select="-R ^(threads|map|search)/ -LE slow" ;;
    --fuzz | --fuzz=[1-9]*)
        n=${argument#--fuzz}
        n=${n#=}
        build=build-fuzz dependencies=--clang targets="fuzz_capi fuzz_files" select="-L fuzz"
        options="-DCONNECTIVITY_FUZZ=ON -DCONNECTIVITY_FUZZ_INPUTS=${n:-2000} $clang"
        options="$options -DCONNECTIVITY_PCH=ON" ;;
    *)
        echo "unknown argument $argument; known: --all, --sanitize, --sanitize=thread, --fuzz," \
            "--fuzz=N" >&2
        exit 2 ;;
    esac
done

echo "== 1/3 dependencies"
sh cmake/dependencies.sh "$dependencies"

echo "== 2/3 building $targets into $build/"
[ -f "$build/CMakeCache.txt" ] || options="$options -G Ninja"
cmake -S . -B "$build" $options
cmake --build "$build" -j "$(nproc)" --target $targets

echo "== 3/3 tests"
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" $select
