"""One compiled function of a room, called from Python on a memory with nothing else in it."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import INDICES, VECTORS
from fairlead.native import target_machine
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
    import numba

    from fairlead.integrate.memory.foreign import memory_at

    names = [f"a{k}" for k in range(len(kinds))]
    given = ", ".join([*(f"m.{owner}" if owner else "m" for owner in owners), *names])
    text = f"def call({', '.join(['address', *names])}):\n    m = memory_at(address)\n    return function({given})\n"
    scope: dict[str, Any] = {"memory_at": memory_at, "function": function}
    exec(text, scope)
    types = {"i": numba.int64, "d": numba.float64, "v": numba.void, "b": numba.boolean}
    signature = types[result](numba.int64, *(types[kind] for kind in kinds))
    made = machine_code(signature, scope["call"])

    def call(at: Memory, *arguments: Any) -> Any:
        return made(at.address, *(a.ctypes.data if isinstance(a, np.ndarray) else a for a in arguments))

    return call


def machine_code(signature: Any, function: Callable[..., Any]) -> Any:
    """A function with all that it calls, made native as the loop is: linked and optimised once, in a third of the time.

    `signature` is one of numba; its whole numbers may be addresses, and are passed as such.
    """
    import llvmlite.binding as llvm
    import numba

    from fairlead.integrate.link_once import linked_once

    tell_numba()
    with linked_once():
        made = numba.cfunc(signature, error_model="numpy", _nrt=False)(function)
        module = llvm.parse_assembly(made.inspect_llvm())
    engine = llvm.create_mcjit_compiler(module, target_machine())
    engine.finalize_object()
    kinds = {numba.int64: ctypes.c_int64, numba.float64: ctypes.c_double}
    kinds |= {numba.boolean: ctypes.c_bool, numba.void: None}
    call = ctypes.CFUNCTYPE(kinds[signature.return_type], *(kinds[kind] for kind in signature.args))(
        engine.get_function_address(made.native_name)
    )
    call.keep_alive = engine  # type: ignore[attr-defined]
    return call


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
