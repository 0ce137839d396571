# SPDX-License-Identifier: BSD-3-Clause
"""Every struct of the headers, mirrored by ctypes, has the size that the loaded library says.

Usage: structs.py HEADERS LIBRARY, a folder and a path.
"""
import ctypes as c
import pathlib
import re
import sys

TYPES = {"int32_t": c.c_int32, "int64_t": c.c_int64, "uint64_t": c.c_uint64, "size_t": c.c_size_t,
         "double": c.c_double}


def mirror(name, body):
    fields = []
    for declaration in filter(None, (" ".join(part.split()) for part in body.split(";"))):
        kind, names = re.fullmatch(r"(?:const )?(\w+ ?\**) ?(.*)", declaration).groups()
        kind = c.c_void_p if "*" in kind else TYPES[kind.strip()]
        for field, extent in re.findall(r"(\w+)(?:\[(\d+)\])?", names):
            fields.append((field, kind * int(extent) if extent else kind))
    return type(name, (c.Structure,), {"_fields_": fields})


library = c.CDLL(sys.argv[2])
library.conn_abi_sizeof.restype = c.c_int64
structs, numbers = {}, {}
for header in pathlib.Path(sys.argv[1]).glob("connectivity*.h"):
    text = re.sub(r"/\*.*?\*/", " ", header.read_text(), flags=re.S)
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, flags=re.S):
        structs[name] = mirror(name, body)
    numbers.update(re.findall(r"CONN_STRUCT_(\w+) = (\d+)", text))

wrong = len(structs) != len(numbers) or len(structs) < 10
for name, number in numbers.items():
    struct = structs[f"conn_{name.lower()}"]
    size = library.conn_abi_sizeof(int(number))
    print(f"{struct.__name__}: {c.sizeof(struct)} bytes here, {size} in the library")
    wrong = wrong or size != c.sizeof(struct)
sys.exit(wrong)
