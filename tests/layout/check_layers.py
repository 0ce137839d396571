#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rules that keep the layers apart, by reading every #include under include/, src/
and capi/. Prints one line per violation, `file:line: what`, and exits with 1 if there is any.

A file includes only its own layer or a lower one. Only io knows HDF5; only domain, io and
the MPI part of capi know MPI. Kernels for wider instruction sets include no library code, whose
inline functions would carry these instructions into the rest of the program.
"""
import re
import sys
from pathlib import Path

SPINE = ["base", "keys", "tree", "search", "map", "boundary", "sph"]
BELOW = {layer: set(SPINE[:k]) for k, layer in enumerate(SPINE)}
BELOW["lists"] = {"base", "keys", "tree"}
BELOW["gravity"] = BELOW["lists"] | {"lists"}
BELOW["domain"] = {"base", "keys", "tree", "search", "map", "lists", "gravity"}
CORE = set(BELOW)
BELOW["io"] = set(CORE)
BELOW["scene"] = CORE | {"io"}
BELOW["program"] = CORE | {"io", "scene"}
BELOW["capi"] = set(CORE)

MAX_LINES = 400
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
HDF5 = re.compile(r"^(hdf5|highfive/|H5)", re.IGNORECASE)
WIDE_KERNEL = re.compile(r"_avx(2|512)\.cpp$")
WIDE_KERNEL_MAY = {"immintrin.h", "cstddef", "cstdint", "stddef.h", "stdint.h"}


def layer_of(path: Path):
    """The layer a path relative to the root belongs to, or None if it is none of ours."""
    parts = path.parts
    if parts[0] == "capi":
        return "capi"
    if parts[:2] == ("include", "connectivity") and len(parts) > 3:
        return parts[2]
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    return None


def included_layer(root: Path, file: Path, quoted: bool, target: str):
    """The layer an include leads to, or None if it leaves the project."""
    if target.startswith("connectivity/"):
        return layer_of(Path("include") / target)
    places = [file.parent] if quoted else []
    for place in places + [root / "src", root / "include", root / "capi"]:
        found = (place / target).resolve()
        if found.is_file() and found.is_relative_to(root):
            return layer_of(found.relative_to(root))
    return None


def violations(root: Path, file: Path):
    """Yields (line number, text) for every broken rule of one file."""
    relative = file.relative_to(root)
    layer = layer_of(relative)
    if layer not in BELOW:
        yield 1, f"'{layer}' is not a layer; known: {', '.join(BELOW)}"
        return
    lines = file.read_text(encoding="utf-8").splitlines()
    if len(lines) > MAX_LINES:
        yield len(lines), f"a file of more than {MAX_LINES} lines"
    if not any("SPDX-License-Identifier: BSD-3-Clause" in line for line in lines[:3]):
        yield 1, "no SPDX line at the top"
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        target = match[2]
        other = included_layer(root, file, match[1] == '"', target)
        if other is not None and other != layer and other not in BELOW[layer]:
            yield number, f"{layer} may not include {other}: {target}"
        if HDF5.match(target) and layer != "io":
            yield number, f"only io knows HDF5: {target}"
        if target == "mpi.h" and layer not in ("domain", "io") and "mpi" not in file.stem:
            yield number, f"only domain, io and capi/*_mpi know MPI: {target}"
        if WIDE_KERNEL.search(file.name) and other is None and target not in WIDE_KERNEL_MAY:
            yield number, f"a kernel for a wider instruction set may not include {target}"


def main() -> int:
    root = Path(sys.argv[1]).resolve()
    files = [
        file
        for folder in ("include", "src", "capi")
        for file in sorted((root / folder).rglob("*"))
        if file.suffix in (".hpp", ".cpp", ".h", ".c") and "examples" not in file.parts
    ]
    found = [(file, line, text) for file in files for line, text in violations(root, file)]
    for file, line, text in found:
        print(f"{file.relative_to(root)}:{line}: {text}")
    print(f"{len(files)} files, {len(found)} violations")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
