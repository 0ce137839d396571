#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds the program and shows what it does, on a machine where nothing is installed yet:
# dependencies, build, neighbours and pairs of a generated clustered cloud, and a picture of it.
set -eu

cd "$(dirname "$0")/.."
say() { echo "== $*" >&2; }

say "1/3 dependencies"
sh cmake/dependencies.sh

say "2/3 building the program into build/"
generator=
[ -f build/CMakeCache.txt ] || generator="-G Ninja"
cmake -S . -B build $generator
cmake --build build -j "$(nproc)" --target connectivity_command

say "3/3 a clustered cloud of 100 000 nodes: neighbour rows, pairs, density, picture"
set -x
build/connectivity cloud --n 100000 --out build/cloud.h5
build/connectivity pairs build/cloud.h5 --density --out build/cloud_pairs.h5 --plot build/cloud.png
{ set +x; } 2> /dev/null

cat >&2 << 'END'
== Rows, pairs and density are in build/cloud_pairs.h5, the picture in build/cloud.png.
== On your own GADGET, SWIFT or H5Part file:
==     build/connectivity pairs FILE --density --out result.h5 --plot picture.png
== More: build/connectivity --help
END
