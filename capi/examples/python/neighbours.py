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

def show(what):  # sums: symmetric, deterministic
    call("pair_field_data", weights, map_, None, c.byref(n_pairs), None)
    call("pair_field_sum", weights, map_, 2, 0, POINTER(density.ctypes.data), LONG(n))
    print("%s: %d pairs\n%24.16E%24.16E" % (what, n_pairs.value, density[0], density[left - 1]))

def step():
    call("nodes_set_h", gas, LONG(n), c.byref(positions), 1, c.byref(lengths))
    call("map_rebuild", map_, c.byref(gas), 1)
    call("pair_field_destroy", c.byref(weights))
    call("pair_field_create", map_, 1, c.byref(weights))
    call("pair_field_data", weights, map_, c.byref(data), None, None)
    call("map_pairs_acquire", map_, 0, 1, c.byref(pairs))
    i, j, weight = (np.ctypeslib.as_array(a, (pairs.n_pairs,)) for a in (pairs.i, pairs.j, data))
    d = x[i] - x[j]  # of all pairs, each once
    weight[:] = 1 - (d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]) / 2.25
    call("map_pairs_release", c.byref(pairs))
    show("rebuilt")

library = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libconnectivity.so.0")
library.conn_last_error.restype = c.c_char_p
context, gas, map_, weights = (POINTER() for _ in range(4))
data, n_pairs, pairs = c.POINTER(DOUBLE)(), LONG(), Pairs(c.sizeof(Pairs))
side, n, left, a = 10, 1000, 900, np.arange(1000, dtype=np.int32)
x = np.stack([a % side, a // side % side, a // side**2], axis=1).astype(float)
h, density = np.full(n, 0.75), np.empty(n)  # a unit lattice; supports reach 2 h = 1.5
positions = Array(x.ctypes.data, 0, 0, 0, 2, (n, 3), (3, 1))
lengths = Array(h.ctypes.data, 0, 0, 0, 1, (n, 1), (1, 1))
call("context_create", None, c.byref(context))
call("nodes_create", context, b"gas", 3, DOUBLE(2.0), c.byref(gas))
call("map_create", context, None, c.byref(map_))
step()
x *= [1.25, 0.9, 1.0]  # stretched and squeezed
step()
keep = (a < left).astype(np.int32)  # without the last layer
call("map_patch", map_, *(POINTER(k.ctypes.data) for k in (keep, a)), LONG(n), c.byref(weights), 1)
show("patched")
