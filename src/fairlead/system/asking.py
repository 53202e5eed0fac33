"""The callbacks of a System asked from Python, at a time and for unknowns."""

from __future__ import annotations

import ctypes

import numpy as np

from fairlead.system.driver import callbacks
from fairlead.system.moving import Following
from fairlead.system.rest import Floats
from fairlead.system.system import Instance

POINTER = ctypes.c_void_p
CALLS = {k: ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_double, *(k + 1) * [POINTER]) for k in (1, 2)}
"""Callbacks at (t, y), by how many vectors they fill."""


def call(system: Instance, name: str, t: float, y: Floats, *out: Floats) -> None:
    """Call one of the callbacks that fill vectors at (t, y)."""
    y = np.ascontiguousarray(y)
    CALLS[len(out)](callbacks().address[name])(system.context, t, y.ctypes.data, *(one.ctypes.data for one in out))


def aligned(system: Instance, what: Following, t: float, y: Floats) -> Floats:
    """Put all that is carried where its carrier is at t, and as fast; the unknowns [n] then."""
    call(system, "rhs", t, y, np.zeros(system.n))
    made, u = y.copy(), what.unknowns
    made[u] = what.ratio[u] * system.memory["z"][what.place[u]] + what.offset[u]
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
