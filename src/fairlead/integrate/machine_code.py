"""The compiled loop as a C function: from the cache, or compiled by numba on a miss."""

from __future__ import annotations

import ctypes
import functools
import importlib.resources
from collections.abc import Callable

import fairlead.native as native

SOURCES = (
    "memory.py", "foreign.py", "linear.py", "sparse.py", "rosenbrock.py", "interpolant.py", "controller.py",
    "guards.py", "crossing.py", "record.py", "start.py", "settling.py", "codes.py", "trial.py", "arrival.py",
    "loop.py",
)  # fmt: skip
"""Every file of this folder whose text the machine code depends on."""


@functools.cache
def compiled_loop() -> Callable[[int, int], int]:
    """advance(address of the struct, attempts) -> status; see loop.py."""
    folder = importlib.resources.files("fairlead.integrate")
    key = native.digest("integrate", *(folder.joinpath(name).read_text("utf-8") for name in SOURCES))
    code = native.load_or_compile(key, _build)
    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_int64)(code.address["advance"])
    call.keep_alive = code  # type: ignore[attr-defined]
    return call


def _build() -> native.Build:
    import numba

    from fairlead.integrate.loop import advance

    signature = numba.int64(numba.int64, numba.int64)
    function = numba.cfunc(signature, error_model="numpy", _nrt=False)(advance)
    return native.Build(meta={}, functions={"advance": function})
