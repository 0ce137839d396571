#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks on the disassembly that registers of AVX and AVX-512 stand in no object but the kernels written for them.

Arguments: objdump, an archive. Every member named *_avx2.cpp.* or *_avx512.cpp.* must use them, no other may.
"""
import re
import subprocess
import sys
from collections import Counter

MEMBER = re.compile(r"^(\S+):\s+file format")
WIDE_REGISTER = re.compile(r"%[yz]mm\d|%k[1-7]\b")
WIDE_KERNEL = re.compile(r"_avx(2|512)\.cpp\.")


def wide_instructions(objdump: str, archive: str) -> Counter:
    """Number of wide instructions of every member."""
    found, member = Counter(), ""
    with subprocess.Popen([objdump, "-d", "--no-show-raw-insn", archive], stdout=subprocess.PIPE, text=True) as listing:
        for line in listing.stdout:
            if head := MEMBER.match(line):
                member = head[1]
                found[member] += 0
            elif WIDE_REGISTER.search(line):
                found[member] += 1
    return found


def main() -> int:
    found = wide_instructions(*sys.argv[1:])
    wrong = [member for member, n in found.items() if (n > 0) != bool(WIDE_KERNEL.search(member))]
    for member in wrong:
        print(f"{member}: {found[member]} wide instructions")
    print(f"{len(found)} members, {sum(found.values())} wide instructions, {len(wrong)} violations")
    return 1 if wrong or not found else 0


if __name__ == "__main__":
    sys.exit(main())
