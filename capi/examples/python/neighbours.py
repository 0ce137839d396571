# SPDX-License-Identifier: BSD-3-Clause
"""Nodes in, rebuild, loop over pairs, sums of pair values at nodes, move, rebuild, patch: the same
digits as ../c/neighbours.c and ../fortran/neighbours.f90. Arrays of NumPy go in and the lists
come out without a copy. Usage: neighbours.py [PATH OF libconnectivity.so]"""
import ctypes as c
import sys
import numpy as np

INT, LONG, DOUBLE, POINTER = c.c_int32, c.c_int64, c.c_double, c.c_void_p


class Array(c.Structure):  # conn_array
    _fields_ = [("data", POINTER), ("space", INT), ("device_id", INT), ("dtype", INT),
                ("ndim", INT), ("extent", LONG * 2), ("stride", LONG * 2)]


class Pairs(c.Structure):  # conn_pairs_view, not all by its name
    _fields_ = [("struct_size", c.c_size_t), ("n_pairs", LONG), ("numbers", LONG * 4),
                ("offsets", c.POINTER(LONG)), ("i", c.POINTER(INT)), ("j", c.POINTER(INT)),
                ("others", POINTER * 5)]


def call(name, *arguments):
    if getattr(library, "conn_" + name)(*arguments) != 0:
        raise RuntimeError(library.conn_last_error().decode())


def describe(a):  # float64, with any strides
    shape, strides = a.shape + (1,), a.strides + (a.itemsize,)
    strides = [stride // a.itemsize for stride in strides]
    return c.byref(Array(a.ctypes.data, 0, 0, 0, a.ndim, shape[:2], tuple(strides[:2])))


def step():
    pairs, data = Pairs(c.sizeof(Pairs)), c.POINTER(DOUBLE)()
    call("nodes_set_h", gas, LONG(n), describe(x), 1, describe(h))
    call("map_rebuild", map_, c.byref(gas), 1)
    call("pair_field_destroy", c.byref(field))
    call("pair_field_create", map_, 3, c.byref(field))
    call("pair_field_data", field, map_, c.byref(data), None, None)
    call("map_pairs_acquire", map_, 0, 1, c.byref(pairs))
    i, j = (np.ctypeslib.as_array(ends, (pairs.n_pairs,)) for ends in (pairs.i, pairs.j))
    force = np.ctypeslib.as_array(data, (pairs.n_pairs, 3))
    d = x[i] - x[j]
    q = np.sqrt(d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]) / 1.5
    t = (1 - q) * (1 - q)
    density = np.ones(n)  # a node sees itself; Wendland C2 over its value at distance 0
    for ends in (j, i):  # in the order of a loop over pairs: they are sorted, and i < j
        np.add.at(density, ends, t * t * (1 + 4 * q))
    force[:] = t[:, None] * d
    call("map_pairs_release", c.byref(pairs))
    print(f"rebuilt: {len(force)} pairs\ndensity{density[0]:24.16E}{density[n // 2 - 1]:24.16E}")
    print("force%24.16E%24.16E%24.16E" % sums())


def sums():  # antisymmetric, deterministic
    call("pair_field_sum", field, map_, 1, 0, POINTER(push.ctypes.data), LONG(push.size))
    return tuple(push[left - 1])


library = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libconnectivity.so.0")
library.conn_last_error.restype, library.conn_abi_sizeof.restype = c.c_char_p, LONG
assert [library.conn_abi_sizeof(k) for k in (1, 6)] == [c.sizeof(Array), c.sizeof(Pairs)]
context, gas, map_, field = (POINTER() for _ in range(4))
side, n, left = 10, 1000, 900
a = np.arange(n, dtype=np.int32)
x = np.stack([a % side, a // side % side, a // side**2], axis=1).astype(float)
h, push = np.full(n, 0.75), np.empty((n, 3))  # supports reach 2 h = 1.5
call("context_create", None, c.byref(context))
call("nodes_create", context, b"gas", 3, DOUBLE(2.0), c.byref(gas))
call("map_create", context, None, c.byref(map_))
step()
x *= [1.25, 0.9, 1.0]  # stretched along x, squeezed along y
step()
keep, n_pairs = (a < left).astype(np.int32), LONG()  # the last layer goes
call("map_patch", map_, *(POINTER(k.ctypes.data) for k in (keep, a)), LONG(n), c.byref(field), 1)
call("map_pairs_copy", map_, None, None, None, LONG(0), c.byref(n_pairs))
print(f"patched: {n_pairs.value} pairs\nforce%24.16E%24.16E%24.16E" % sums())
for kind, handle in (("pair_field", field), ("map", map_), ("nodes", gas), ("context", context)):
    call(kind + "_destroy", c.byref(handle))
