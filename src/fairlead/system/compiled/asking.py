"""The callbacks and kernels of a System called from Python."""

from __future__ import annotations

import ctypes

import numpy as np

from fairlead.system.callbacks.table import callbacks
from fairlead.system.compiled.system import Booleans, Floats, Instance

POINTER = ctypes.c_void_p
CALLS = {k: ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_double, *(k + 1) * [POINTER]) for k in (1, 2)}
"""Callbacks at (t, y), by how many vectors they fill."""
KERNEL = ctypes.CFUNCTYPE(None, *(ctypes.c_int64, POINTER), *2 * (ctypes.c_int64,), *4 * (POINTER,))


def call(system: Instance, name: str, t: float, y: Floats, *out: Floats) -> None:
    """Call one of the callbacks that fill vectors at (t, y)."""
    y = np.ascontiguousarray(y)
    CALLS[len(out)](callbacks().address[name])(system.context, t, y.ctypes.data, *(one.ctypes.data for one in out))


def mass_of(system: Instance) -> Floats:
    """M along its pattern, in the zones in force."""
    made = np.zeros(len(system.mass_pattern.rows))
    ctypes.CFUNCTYPE(None, ctypes.c_int64, POINTER)(callbacks().address["mass"])(system.context, made.ctypes.data)
    return made


def partials_at(system: Instance, t: float, y: Floats) -> Floats:
    """All partial derivatives of laws at (t, y)."""
    call(system, "jacobian", t, y, np.zeros(len(system.pattern.rows)), np.zeros(system.n))
    return system.memory["partials"].copy()


def guards_at(system: Instance, t: float, y: Floats) -> Floats:
    """All guards at (t, y)."""
    made = np.zeros(len(system.guard_tolerance))
    call(system, "guards", t, y, made)
    return made


def ask(system: Instance, block: int, mode: int, which: Booleans, out: Floats) -> None:
    """Ask these instances of a block what they give in a mode (layout.py), for what stands in z."""
    memory = system.memory
    kernel, row = KERNEL(system.blocks[block].kernel.address), memory["blocks"][block].ctypes.data
    last = [*(memory[name].ctypes.data for name in ("z", "zones", "tables")), out.ctypes.data]
    borders = np.flatnonzero(np.diff(np.concatenate([[False], which, [False]]).astype(np.int8)))
    for start, stop in borders.reshape(-1, 2).tolist():
        kernel(mode, row, start, stop, *last)
