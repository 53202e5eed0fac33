"""The compiled loop as a C function: from the cache, or compiled by numba on a miss."""

from __future__ import annotations

import ctypes
import functools
import importlib
import importlib.resources
import os
from collections.abc import Callable
from typing import Any

import fairlead.native as native
from fairlead.integrate.codes import CHECK
from fairlead.integrate.engine import Advance, Engine
from fairlead.processor import tell_numba

SOURCES = (
    "memory.py", "foreign.py", "condensing.py", "condensed.py", "linear.py", "sparse.py", "perturbed_pivots.py",
    "interpolant.py", "defect.py", "meters.py", "even_steps.py", "controller.py", "curvature.py", "guards.py",
    "limits.py", "least_index.py", "balance.py", "position.py", "crossing.py", "rows_between.py", "record.py",
    "rebound.py", "impulse.py", "start.py", "release.py", "settling.py", "growth.py", "codes.py", "pace.py",
    "one_step.py", "arrival.py", "loop.py",
)  # fmt: skip
"""Every file of this folder whose text the machine code of every loop depends on."""


def compiled_loop(engine: Engine) -> Advance:
    """advance(address of the structs, attempts) -> status, as loop.py has it, with the method of this engine.

    Each engine is an entry of its own in the cache, so that only what is used gets compiled.
    """
    return _compiled_loop(engine.module, engine.sources)


@functools.cache
def _compiled_loop(module: str, sources: tuple[str, ...]) -> Advance:
    code = native.load_or_compile(_key(SOURCES + sources), lambda: _build(module))
    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_int64)(code.address["advance"])
    call.keep_alive = code  # type: ignore[attr-defined]
    return call


def _key(names: tuple[str, ...]) -> str:
    """Hash of what the machine code of these files depends on."""
    folder = importlib.resources.files("fairlead.integrate")
    texts = (folder.joinpath(name).read_text("utf-8") for name in names)
    return native.digest("integrate", os.environ.get(CHECK, ""), *texts)


def _build(module: str) -> native.Build:
    import numba

    tell_numba()
    from fairlead.integrate.loop import loop_of

    advance = loop_of(importlib.import_module(module).METHOD)
    signature = numba.int64(numba.int64, numba.int64)
    function = numba.cfunc(signature, error_model="numpy", _nrt=False)(advance)
    return native.Build(meta={}, functions={"advance": function})


SUNDIALS_SOURCES = ("sundials_kernels.py",)
"""What the ida engine adds to SOURCES."""
SUNDIALS_KERNELS = {
    "residual": "vidiii", "prepare": "iidid", "solve_prepared": "viii", "multiply": "vidii", "guards": "vidii",
    "judge_step": "iidiiiid", "find_culprit": "ii",
}  # fmt: skip
"""Functions of sundials_kernels.py with the types of their result and arguments: void, int64, double."""


@functools.cache
def compiled_sundials() -> dict[str, Callable[..., int]]:
    """The functions of sundials_kernels.py by name."""
    names = SOURCES + SUNDIALS_SOURCES
    code = native.load_or_compile(_key(names), _build_sundials)
    kinds: dict[str, Any] = {"v": None, "i": ctypes.c_int64, "d": ctypes.c_double}
    calls: dict[str, Callable[..., int]] = {}
    for name, types in SUNDIALS_KERNELS.items():
        call = ctypes.CFUNCTYPE(*(kinds[letter] for letter in types))(code.address[name])
        call.keep_alive = code  # type: ignore[attr-defined]
        calls[name] = call
    return calls


def _build_sundials() -> native.Build:
    import numba

    tell_numba()
    sundials_kernels = importlib.import_module("fairlead.integrate.sundials_kernels")

    kinds = {"v": numba.void, "i": numba.int64, "d": numba.float64}
    functions = {}
    for name, types in SUNDIALS_KERNELS.items():
        signature = kinds[types[0]](*(kinds[letter] for letter in types[1:]))
        make = numba.cfunc(signature, error_model="numpy", _nrt=False)
        functions[name] = make(getattr(sundials_kernels, name))
    return native.Build(meta={}, functions=functions)
