#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The examples print the same bytes, and the numbers of pairs that a lattice of 10 nodes a side has.
# Usage: examples.sh neighbours.py LIBRARY PYTHON PROGRAM...; PYTHON may be none, and the script is
# left out where neither it nor the python3 of the system has NumPy.
set -eu
script=$1 library=$2 python=$3
shift 3
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

for program in "$@"; do
    "$program" > "$dir/$(basename "$program")"
done
for interpreter in "$python" /usr/bin/python3; do
    if [ "$python" != none ] && "$interpreter" -c "import numpy" 2> /dev/null; then
        "$interpreter" "$script" "$library" > "$dir/python"
        break
    fi
done
[ -f "$dir/python" ] || echo "left out: the example in Python, which needs NumPy"

# Of m = 10: 3 m^2 (m-1) + 6 m (m-1)^2; stretched: 3 m^2 (m-1) + 2 m (m-1)^2; less one layer:
# 2 m (m-1)^2 + m^2 (m-2) + 2 m (m-1) (m-2).
expected="rebuilt: 7560 pairs
rebuilt: 4320 pairs
patched: 3860 pairs"
for output in "$dir"/*; do
    [ "$(sed -n 's/ pairs.*/ pairs/p' "$output")" = "$expected" ] || {
        echo "wrong numbers of pairs:"
        cat "$output"
        exit 1
    }
    cmp "$output" "$dir/$(basename "$1")"
done
cat "$output"
