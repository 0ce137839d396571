#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Measures, and makes the table and the charts:  sh bench/run.sh [--quick|--tiny] [options]
#   --quick          sizes up to 1e5, rows and pairs, 2 threads: some minutes; the default takes
#                    one to three hours and 12 GB
#   --tiny           sizes up to 1e3, one repetition: seconds, shows only that it works
#   --program FILE   the benchmark [build/bench/rebuild]
#   --python FILE    [python3]
#   --out DIR        record.json, table.md and charts go there [build/bench/report]
# A quiet machine is yours to provide. CONNECTIVITY_YARDSTICK=<program> adds a yardstick, see
# bench/yardstick.hpp.
#
# Peers take part that were found when the build was configured: nanoflann, TreeNSearch, ArborX,
# vesin, cornerstone (cornerstone-octree), Cabana. <package>_ROOT points to the prefix that it was
# installed into, for cornerstone to its source folder:
#   cmake -B build -DKokkos_ROOT=$HOME/kokkos -DArborX_ROOT=$HOME/arborx ...
# ArborX and Cabana have to be built with the Kokkos of this build, 4.5 or later. What each of them
# delivers, and what it is left out of, stands in bench/peers/<name>.cpp.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/bench/rebuild out=$here/../build/bench/report python=python3
any='^[a-z_]+'
standard="$any/W[1-7]/(rows|pairs|both)/[12](/(3lists|tensor|step|reordered))?\$|^(ours|yardstick)/W[1-7]/[a-z]+/[12]/first"
sizes='^ours/W[1-7]/(rows|pairs)/2/[134]e[3-6]$'
hard="$any/A[0-9a-z]+/rows/2|^ours/W[1-7]/rows/2/1e4"
reuse='^ours/W1/pairs/2/1e4-skin|^ours/W[13]/pairs/[12]/(1e4-)?sum'
features='^ours/W[13]/both/2/1e4(-(key|overlap|intersection))?$'
small="$any/W1/rows/[12]/(1|10|100|1e3|1e4)(-(brute|groups))?\$"
filter="$standard|$sizes|$hard|$small|$reuse|$features|^ours/W1/both/2/(key|overlap|intersection)\$" options=
while [ $# -gt 0 ]; do
    case $1 in
    --quick)
        filter="$any/W[1-7]/(rows|pairs)/2/(1e4|1e5)\$|$any/W2/(rows|pairs)/2\$|$hard|$small|$reuse|$features"
        options="--benchmark_repetitions=3 --benchmark_min_time=0.05" ;;
    --tiny)
        filter="$any/W[13467]/rows/2/1e3|^ours/W[13]/both/2/1e3|$any/W[17]/pairs/2/1e3|^ours/W1/rows/[12]/100|$any/A(4|8|10)/rows/2"
        options="--benchmark_repetitions=1 --benchmark_min_time=0.001" ;;
    --program) program=$2; shift ;;
    --python) python=$2; shift ;;
    --out) out=$2; shift ;;
    *) echo "unknown argument $1; see the head of $0" >&2; exit 2 ;;
    esac
    shift
done

mkdir -p "$out"
"$program" --benchmark_filter="$filter" $options --benchmark_out="$out/record.json" >&2
"$python" "$here/table.py" "$out/record.json" > "$out/table.md"
cat "$out/table.md"
"$python" "$here/charts.py" "$out/record.json" --out "$out" >&2
