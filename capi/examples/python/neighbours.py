# SPDX-License-Identifier: BSD-3-Clause
"""Nodes in, rebuild, loop over pairs, values of pairs summed at the nodes, move, rebuild, patch: the
same digits as ../c/neighbours.c and ../fortran/neighbours.f90. Arrays of NumPy go in and the lists
come out without a copy. Usage: neighbours.py [PATH OF libconnectivity.so]"""
import ctypes as c
import sys
import numpy as np

INT, LONG, DOUBLE, POINTER = c.c_int32, c.c_int64, c.c_double, c.c_void_p


class Array(c.Structure):  # conn_array
    _fields_ = [("data", POINTER), ("space", INT), ("device_id", INT), ("dtype", INT),
                ("ndim", INT), ("extent", LONG * 2), ("stride", LONG * 2)]


class Pairs(c.Structure):  # conn_pairs_view
    _fields_ = [("struct_size", c.c_size_t), ("n_pairs", LONG), ("n_slots", LONG),
                ("generation", c.c_uint64), ("n_lists", INT), ("space", INT), ("device_id", INT),
                ("reserved", INT), ("offsets", c.POINTER(LONG)), ("i", c.POINTER(INT)),
                ("j", c.POINTER(INT)), ("coupling", c.POINTER(DOUBLE)), ("list_offset", POINTER),
                ("owner", POINTER), ("slots", POINTER), ("ranks", POINTER)]


library = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libconnectivity.so.0")
library.conn_last_error.restype = c.c_char_p
library.conn_abi_sizeof.restype = LONG
assert [library.conn_abi_sizeof(k) for k in (1, 6)] == [c.sizeof(Array), c.sizeof(Pairs)]


def call(name, *arguments):
    if getattr(library, "conn_" + name)(*arguments) != 0:
        raise RuntimeError(library.conn_last_error().decode())


def describe(a):  # of float64, with any strides
    shape, stride = a.shape + (1,), [s // a.itemsize for s in a.strides] + [1]
    return c.byref(Array(a.ctypes.data, 0, 0, 0, a.ndim, shape[:2], tuple(stride[:2])))


def rebuild():
    call("nodes_set_h", gas, LONG(n), describe(x), 1, describe(h))
    call("map_rebuild", map_, c.byref(gas), 1)


def interact():
    pairs, data = Pairs(c.sizeof(Pairs)), c.POINTER(DOUBLE)()
    call("map_pairs_acquire", map_, 0, 1, c.byref(pairs))
    call("pair_field_data", force, map_, c.byref(data), None, None)
    i, j = (np.ctypeslib.as_array(a, (pairs.n_pairs,)) for a in (pairs.i, pairs.j))
    f = np.ctypeslib.as_array(data, (pairs.n_pairs, 3))
    d = x[i] - x[j]
    q = np.sqrt(d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]) / 1.5
    t = (1 - q) * (1 - q)
    density = np.ones(n)  # a node sees itself; Wendland C2 over its value at distance 0
    for ends in (j, i):  # in the order of a loop over pairs: they are sorted, and i < j
        np.add.at(density, ends, t * t * (1 + 4 * q))
    f[:] = t[:, None] * d
    call("map_pairs_release", c.byref(pairs))
    print("density%24.16E%24.16E" % (density[0], density[n // 2 - 1]))
    report("rebuilt", len(f))


def report(what, n_pairs):
    call("pair_field_sum", force, map_, 1, 0, POINTER(push.ctypes.data), LONG(push.size))
    print("%s: %d pairs, force%24.16E%24.16E%24.16E" % (what, n_pairs, *push[left - 1]))


side = 10
n, left = side**3, side**3 - side**2
a = np.arange(n)
x = np.stack([a % side, a // side % side, a // side**2], axis=1).astype(float)
h, push = np.full(n, 0.75), np.empty((n, 3))  # supports reach 2 h = 1.5
context, gas, map_, force = POINTER(), POINTER(), POINTER(), POINTER()
call("context_create", None, c.byref(context))
call("nodes_create", context, b"gas", 3, DOUBLE(2.0), c.byref(gas))
call("map_create", context, None, c.byref(map_))
rebuild()
call("pair_field_create", map_, 3, c.byref(force))
interact()

x *= [1.25, 0.9, 1.0]  # stretched along x, squeezed along y
rebuild()
call("pair_field_reset", force, map_)
interact()

keep, old2new = (a < left).astype(np.int32), a.astype(np.int32)  # the last layer goes
call("map_patch", map_, POINTER(keep.ctypes.data), POINTER(old2new.ctypes.data), LONG(n),
     c.byref(force), 1)
n_pairs = LONG()
call("map_pairs_copy", map_, None, None, None, LONG(0), c.byref(n_pairs))
report("patched", n_pairs.value)
for kind, handle in (("pair_field", force), ("map", map_), ("nodes", gas), ("context", context)):
    call(kind + "_destroy", c.byref(handle))
