"""One compiled function of a room, called from Python on a memory with nothing else in it."""

from __future__ import annotations

import ctypes
import functools
import hashlib
import importlib
import importlib.metadata
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import numpy as np

import fairlead.integrate
from fairlead import native
from fairlead.integrate.codes import DONE
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import CHECK, INDICES, VECTORS
from fairlead.processor import tell_numba


def memory(numbers: dict[str, float] | None = None, **arrays: Any) -> Memory:
    """A memory with these arrays, by name, and single values; all other arrays have one entry."""
    given = {name: np.array(values, np.float64 if name in VECTORS else np.int64) for name, values in arrays.items()}
    made = Memory(dict.fromkeys([*VECTORS.values(), *INDICES.values()], 1), given)
    for name, value in (numbers or {}).items():
        made.number[name] = value
    made.spread()
    return made


def entry(function: Callable[..., Any], owners: tuple[str, ...], kinds: str = "", result: str = "v") -> Any:
    """call(memory, ...) -> what `function` says, given these structs, and then arguments of these kinds (i, d).

    An owner without a name is the memory with all of them. An array among the arguments is passed by its address.
    """
    names = [f"a{k}" for k in range(len(kinds))]
    given = ", ".join([*(f"m.{owner}" if owner else "m" for owner in owners), *names])
    text = f"def call({', '.join(['address', *names])}):\n    m = memory_at(address)\n    return function({given})\n"

    def written() -> Callable[..., Any]:
        from fairlead.integrate.memory.foreign import memory_at

        scope: dict[str, Any] = {"memory_at": memory_at, "function": function}
        exec(text, scope)
        return cast(Callable[..., Any], scope["call"])

    made = machine_code(f"{function.__module__}.{function.__qualname__} {text}", f"i{kinds}", result, written)

    def call(at: Memory, *arguments: Any) -> Any:
        return made(at.address, *(a.ctypes.data if isinstance(a, np.ndarray) else a for a in arguments))

    return call


@functools.cache
def room(name: str, owners: tuple[str, ...], kinds: str = "", result: str = "v") -> Any:
    """`entry` of a function of the integrator by its name, such as "point.illinois.shares_of_ends"."""
    module, _, function = name.rpartition(".")
    return entry(getattr(importlib.import_module(f"fairlead.integrate.{module}"), function), owners, kinds, result)


def factorise(at: Memory, scale: float) -> None:
    """Factorise scale M - J."""
    assert room("linear.systems.factorise_step", ("linear",), "d", "i")(at, scale) == DONE


def machine_code(name: str, kinds: str, result: str, function: Callable[[], Callable[..., Any]]) -> Any:
    """What `function()` gives with all that it calls, made native as the loop is, and kept in the cache as the loop is.

    So of the workers of a test one compiles it. `name` tells it from others of these tests; the whole numbers among
    its arguments may be addresses, and are passed as such.
    """

    def build() -> native.Build:
        import numba

        from fairlead.integrate.link_once import linked_once

        tell_numba()
        types = {"i": numba.int64, "d": numba.float64, "v": numba.void, "b": numba.boolean}
        signature = types[result](*(types[kind] for kind in kinds))
        with linked_once():
            made = numba.cfunc(signature, error_model="numpy", _nrt=False)(function())
        return native.Build(meta={}, functions={"call": made})

    key = native.digest("tests", sources(), os.environ.get(CHECK, ""), name, kinds, result)
    code = native.load_or_compile(key, build)
    types = {"i": ctypes.c_int64, "d": ctypes.c_double, "v": None, "b": ctypes.c_bool}
    call = ctypes.CFUNCTYPE(types[result], *(types[kind] for kind in kinds))(code.address["call"])
    call.keep_alive = code  # type: ignore[attr-defined]
    return call


@functools.cache
def sources() -> str:
    """All that these functions may be made of: the version of numba, the integrator and the tests beside this."""
    state = hashlib.sha256(importlib.metadata.version("numba").encode())
    for folder in (Path(fairlead.integrate.__file__).parent, Path(__file__).parent):
        for file in sorted(folder.rglob("*.py")):
            state.update(hashlib.sha256(file.read_bytes()).digest())
    return state.hexdigest()


def fields(at: Memory, n: int, **functions: tuple[Callable[..., Any], int]) -> list[Any]:
    """Have the problem of this memory call Python: name=(function(t, y [n], out), length of out).

    What is returned must be kept as long as the memory is in use.
    """
    taken = [ctypes.c_int64, ctypes.c_double, ctypes.c_int64, ctypes.c_int64]
    kept = []
    for name, (function, length) in functions.items():

        def called(_c: int, t: float, at_y: int, at_out: int, *_: int, f: Any = function, size: int = length) -> None:
            f(t, _doubles(at_y, n), _doubles(at_out, size))

        drift = [ctypes.c_int64] if name == "jacobian" else []  # where df/dt goes
        kept.append(ctypes.CFUNCTYPE(None, *taken, *drift)(called))
        at.number[f"call_{name}"] = ctypes.cast(kept[-1], ctypes.c_void_p).value
    return kept


def _doubles(address: int, length: int) -> Any:
    return np.ctypeslib.as_array((ctypes.c_double * length).from_address(address))
