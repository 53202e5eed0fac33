"""One compiled function of a room, called from Python on a memory with nothing else in it."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import INDICES, VECTORS


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
    import numba

    from fairlead.integrate.memory.foreign import memory_at

    names = [f"a{k}" for k in range(len(kinds))]
    given = ", ".join([*(f"m.{owner}" if owner else "m" for owner in owners), *names])
    text = f"def call({', '.join(['address', *names])}):\n    m = memory_at(address)\n    return function({given})\n"
    scope: dict[str, Any] = {"memory_at": memory_at, "function": function}
    exec(text, scope)
    types = {"i": numba.int64, "d": numba.float64, "v": numba.void, "b": numba.boolean}
    signature = types[result](numba.int64, *(types[kind] for kind in kinds))
    made = numba.cfunc(signature, error_model="numpy", _nrt=False)(scope["call"])

    def call(at: Memory, *arguments: Any) -> Any:
        return made.ctypes(at.address, *(a.ctypes.data if isinstance(a, np.ndarray) else a for a in arguments))

    return call


def fields(at: Memory, n: int, **functions: tuple[Callable[..., Any], int]) -> list[Any]:
    """Have the problem of this memory call Python: name=(function(t, y [n], out), length of out).

    What is returned must be kept as long as the memory is in use.
    """
    kind = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_double, ctypes.c_int64, ctypes.c_int64)
    kept = []
    for name, (function, length) in functions.items():

        def called(_context: int, t: float, at_y: int, at_out: int, f: Any = function, size: int = length) -> None:
            f(t, _doubles(at_y, n), _doubles(at_out, size))

        kept.append(kind(called))
        at.number[f"call_{name}"] = ctypes.cast(kept[-1], ctypes.c_void_p).value
    return kept


def _doubles(address: int, length: int) -> Any:
    return np.ctypeslib.as_array((ctypes.c_double * length).from_address(address))
