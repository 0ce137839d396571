# SPDX-License-Identifier: BSD-3-Clause
"""The lattice of ../c/pairs.c from Python, by dlopen and with nothing but ctypes.

Usage: pairs.py PATH_OF_LIBRARY. Prints the number of pairs and the version.
"""
import ctypes as c
import sys


class Array(c.Structure):  # conn_array
    _fields_ = [
        ("data", c.c_void_p), ("space", c.c_int32), ("device_id", c.c_int32), ("dtype", c.c_int32),
        ("ndim", c.c_int32), ("extent", c.c_int64 * 2), ("stride", c.c_int64 * 2),
    ]


STRUCT_ARRAY = 1
library = c.CDLL(sys.argv[1])
library.conn_last_error.restype = library.conn_version_string.restype = c.c_char_p
library.conn_abi_sizeof.restype = c.c_int64
assert library.conn_abi_sizeof(STRUCT_ARRAY) == c.sizeof(Array)


def call(name, *arguments):
    if getattr(library, name)(*arguments) != 0:
        raise RuntimeError(library.conn_last_error().decode())


m = 10
n = m**3
x = (c.c_double * (3 * n))(*(float(i // m**axis % m) for i in range(n) for axis in range(3)))
h = (c.c_double * n)(*[0.75] * n)
positions = Array(c.addressof(x), 0, 0, 0, 2, (n, 3), (3, 1))
lengths = Array(c.addressof(h), 0, 0, 0, 1, (n, 1), (1, 1))

context, nodes, map_ = c.c_void_p(), c.c_void_p(), c.c_void_p()
call("conn_context_create", None, c.byref(context))
call("conn_nodes_create", context, b"lattice", 3, c.c_double(2.0), c.byref(nodes))
call("conn_nodes_set_h", nodes, c.c_int64(n), c.byref(positions), 1, c.byref(lengths))
call("conn_map_create", context, None, c.byref(map_))
call("conn_map_rebuild", map_, c.byref(nodes), 1)

# Neighbours of every node, by the two-call pattern of conn_map_all_neighbours(i, i).
ends, count, found = 0, c.c_int64(), (c.c_int32 * n)()
for i in range(n):
    call("conn_map_all_neighbours", map_, i, i, found, c.c_int64(n), c.byref(count))
    ends += sum(1 for j in found[: count.value] if j != i)

print(f"{ends // 2} pairs, version {library.conn_version_string().decode()}")
for kind, handle in (("map", map_), ("nodes", nodes), ("context", context)):
    call(f"conn_{kind}_destroy", c.byref(handle))
sys.exit(ends != 2 * (3 * m * m * (m - 1) + 6 * m * (m - 1) ** 2))
