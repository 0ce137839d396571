#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that no instruction of a wider set can leak out of the kernels written for it.

The linker keeps one copy of a weak symbol (inline function, template) and drops the others. If an
object compiled for AVX defines one, that copy may serve the whole program and stop it on an older
processor. So these objects may define strong symbols only, or weak ones whose name says the
instruction set, which nobody else defines. Arguments: nm, then objects.
"""
import re
import subprocess
import sys


def weak_symbols(nm: str, path: str):
    listing = subprocess.run(
        [nm, "--defined-only", "--demangle", path], check=True, capture_output=True, text=True
    ).stdout
    for line in listing.splitlines():
        _, kind, name = line.split(maxsplit=2)
        if kind in "VvWwu" and not re.search(r"avx(2|512)", name, re.IGNORECASE):
            yield name


def main() -> int:
    nm, *objects = sys.argv[1:]
    found = [(path, name) for path in objects for name in weak_symbols(nm, path)]
    for path, name in found:
        print(f"{path}: defines {name}, which the baseline code may end up calling")
    print(f"{len(objects)} objects, {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
