"""The compiled loop as a C function: from the cache, or compiled by numba on a miss."""

from __future__ import annotations

import ctypes
import functools
import importlib
import os
import pathlib
from collections.abc import Callable
from typing import Any

import fairlead.native as native
from fairlead.integrate.engine import Advance, Engine
from fairlead.integrate.memory.layout import CHECK
from fairlead.processor import tell_numba

ROOMS = ("memory", "linear", "point", "record", "events")
"""Rooms that the machine code of every loop is made of."""
FILES = ("codes.py", "one_step.py", "loop.py", "link_once.py")
"""Files of this folder beside them."""


def compiled_loop(engine: Engine) -> Advance:
    """advance(address of the structs, attempts) -> status, as loop.py has it, with the method of this engine.

    Each engine is an entry of its own in the cache, so that only what is used gets compiled.
    """
    return _compiled_loop(engine.module, engine.sources)


@functools.cache
def _compiled_loop(module: str, sources: tuple[str, ...]) -> Advance:
    code = native.load_or_compile(_key(module, *sources), lambda: _build(module))
    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_int64)(code.address["advance"])
    call.keep_alive = code  # type: ignore[attr-defined]
    return call


def _key(module: str, *sources: str) -> str:
    """Hash of what the machine code of a module depends on: these rooms or files, and those of every loop."""
    texts = (file.read_text("utf-8") for name in (*ROOMS, *FILES, *sources) for file in sources_of(name))
    return native.digest("integrate", module, os.environ.get(CHECK, ""), *texts)


def sources_of(name: str) -> list[pathlib.Path]:
    """The files of a room, or the file of that name or path."""
    at = pathlib.Path(__file__).parent / name
    return sorted(at.glob("*.py")) if at.is_dir() else [at]


def _build(module: str) -> native.Build:
    import numba

    tell_numba()
    from fairlead.integrate.link_once import linked_once
    from fairlead.integrate.loop import loop_of

    advance = loop_of(importlib.import_module(module).METHOD)
    signature = numba.int64(numba.int64, numba.int64)
    with linked_once():
        function = numba.cfunc(signature, error_model="numpy", _nrt=False)(advance)
    return native.Build(meta={}, functions={"advance": function})


SUNDIALS_KERNELS = {
    "residual": "vidiii", "prepare": "iidid", "solve_prepared": "viii", "multiply": "vidii", "guards": "vidii",
    "judge_step": "iidiiiid", "find_culprit": "ii",
}  # fmt: skip
"""Functions of ida/kernels.py with the types of their result and arguments: void, int64, double."""


@functools.cache
def compiled_sundials() -> dict[str, Callable[..., int]]:
    """The functions of ida/kernels.py by name."""
    code = native.load_or_compile(_key("ida", "rodas", "ida/kernels.py"), _build_sundials)
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
    from fairlead.integrate.link_once import linked_once

    kernels = importlib.import_module("fairlead.integrate.ida.kernels")
    kinds = {"v": numba.void, "i": numba.int64, "d": numba.float64}
    functions = {}
    with linked_once():
        for name, types in SUNDIALS_KERNELS.items():
            signature = kinds[types[0]](*(kinds[letter] for letter in types[1:]))
            make = numba.cfunc(signature, error_model="numpy", _nrt=False)
            functions[name] = make(getattr(kernels, name))
    return native.Build(meta={}, functions=functions)
