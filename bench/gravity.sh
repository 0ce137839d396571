#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Measures time and error of gravity, and draws the charts:  sh bench/gravity.sh [options]
#   (default)        P4 and P5 on G1 and G5 with 2e4 particles, P6 on G1 up to 3e4: a minute or two
#   --full           all scenes with 1e5 particles, G1 and G2 with 1e6, P6 up to 1e6: hours
#   --tiny           a handful of cases: seconds, shows only that it works
#   --filter REGEX   these cases (names: see the head of bench/gravity.cpp)
#   --program FILE   the benchmark [build/bench/gravity]
#   --python FILE    [python3]
#   --out DIR        record.json and charts go there [build/bench/gravity_report]
# Threads: OMP_NUM_THREADS. A quiet machine is yours to provide. No other code takes part.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/bench/gravity out=$here/../build/bench/gravity_report python=python3
filter='^work/G[15]/20000/|^time/G1/(100|300|1000|3000|10000|30000)/'
options="--benchmark_min_time=0.02"
while [ $# -gt 0 ]; do
    case $1 in
    --full)
        filter='^work/G[1-6]/100000/|^work/G[12]/1000000/(walk|fmm)|^time/G[124]/(100|300|1000|3000|10000|30000|100000)/|^time/G[124]/(300000|1000000)/(walk|fmm|auto)'
        options="--benchmark_min_time=0.5" ;;
    --tiny) filter='^work/G1/20000/(direct|(walk|fmm)/[24]/field/float64/1/)|^time/G1/(100|1000)/' ;;
    --filter) filter=$2; shift ;;
    --program) program=$2; shift ;;
    --python) python=$2; shift ;;
    --out) out=$2; shift ;;
    *) echo "unknown argument $1; see the head of $0" >&2; exit 2 ;;
    esac
    shift
done

mkdir -p "$out"
"$program" --benchmark_filter="$filter" $options --benchmark_out="$out/record.json" >&2
"$python" "$here/gravity_charts.py" "$out/record.json" --out "$out" >&2
