"""The compiled loop as a C function: from the cache; else from bitcode compiled ahead, or compiled by numba.

    compiled_loop(engine)       the loop with the method of an engine
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
import importlib.util
import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import fairlead.integrate.ahead as ahead
import fairlead.native as native
from fairlead.errors import UsageError
from fairlead.integrate.engine import Advance, Engine
from fairlead.integrate.memory.layout import CHECK
from fairlead.processor import tell_numba

ROOMS = ("memory", "linear", "point", "record", "events")
"""Rooms that the machine code of every loop is made of."""
FILES = ("codes.py", "one_step.py", "loop.py", "link_once.py", "bitcode.py")
"""Files of this folder beside them."""


@dataclass(frozen=True)
class Compiled:
    """A module that is compiled on its own, and an entry of its own in the cache: only what is used gets compiled."""

    module: str
    """Where `METHOD` of a loop is; or KERNELS, whose functions are called one by one."""
    sources: tuple[str, ...]
    """What it is made of beside that of every loop."""

    def fingerprint(self) -> str:
        """Hash of the sources of the machine code: these rooms or files, and those of every loop."""
        state = hashlib.sha256(self.module.encode())
        for name in (*ROOMS, *FILES, *self.sources):
            for file in sources_of(name):
                state.update(hashlib.sha256(file.read_bytes().replace(b"\r\n", b"\n")).digest())
        return state.hexdigest()

    def loaded(self, build: Callable[[], native.Build] | None = None) -> native.Native:
        """Machine code from the cache, else from bitcode compiled ahead, else from what `build` gives, else by numba.

        `build` knows no checks of indices: where they are asked for, numba compiles.
        Raises UsageError where it has to be compiled and numba is missing.
        """
        sources, check = self.fingerprint(), os.environ.get(CHECK, "")
        stored, reason = (None, f"{CHECK} is set") if check else ahead.find(self.module, sources)
        if stored:
            return native.load_or_compile(native.digest("ahead", str(stored.llvm), sources), stored.for_here)
        key = native.digest("integrate", _version_of_numba(), sources, check)
        return native.load_or_compile(key, build if build and not check else lambda: self.build(reason))

    def is_cached(self) -> bool:
        """Have the machine code in the cache; True if it was."""
        return self.loaded().cached

    def build(self, reason: str = "", *, cpu: str = "") -> native.Build:
        """The functions, compiled by numba now (`reason`: why) for the processor of that name, else the chosen one."""
        numba_or_reason(self.module, reason)
        tell_numba(cpu)
        return _build_sundials() if self.module == KERNELS else _build(self.module)


def numba_or_reason(module: str, reason: str) -> None:
    """Nothing, where numba is installed. Raises UsageError that names the module, and why it has to be compiled."""
    if importlib.util.find_spec("numba") is None:
        raise UsageError(
            f"{module} has to be compiled, and numba is not installed: {reason or 'it is compiled anew'}.\n"
            "    Install it with: pip install 'fairlead[compile]'."
        )


@functools.cache
def _version_of_numba() -> str:
    """Read off the name of the folder that pip leaves beside numba; "" without numba. Importing it takes 0.3 s."""
    found = importlib.util.find_spec("numba")
    if found is None or found.origin is None:
        return ""
    beside = pathlib.Path(found.origin).parents[1].glob("numba-*.dist-info")
    told = [folder.name.removesuffix(".dist-info").partition("-")[2] for folder in beside]
    if len(told) == 1:
        return told[0]
    from importlib.metadata import PackageNotFoundError, version  # parses what pip knows of a package: some 20 ms

    try:
        return version("numba")
    except PackageNotFoundError:
        return ""


def loop_code(engine: Engine) -> Compiled:
    """What the loop with the method of this engine is compiled from."""
    return Compiled(engine.module, engine.sources)


def compiled_loop(engine: Engine) -> Advance:
    """advance(address of the structs, attempts) -> status, as loop.py has it, with the method of this engine."""
    return _compiled_loop(loop_code(engine))


@functools.cache
def _compiled_loop(loop: Compiled) -> Advance:
    code = loop.loaded()
    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_int64)(code.address["advance"])
    call.keep_alive = code  # type: ignore[attr-defined]
    return call


def sources_of(name: str) -> list[pathlib.Path]:
    """The files of a room, or the file of that name or path."""
    at = pathlib.Path(__file__).parent / name
    return sorted(at.glob("*.py")) if at.is_dir() else [at]


def _build(module: str) -> native.Build:
    import numba

    from fairlead.integrate.link_once import linked_once
    from fairlead.integrate.loop import loop_of

    advance = loop_of(importlib.import_module(module).METHOD)
    signature = numba.int64(numba.int64, numba.int64)
    with linked_once():
        function = numba.cfunc(signature, error_model="numpy", _nrt=False)(advance)
    return native.Build(meta={}, functions={"advance": function})


KERNELS = "fairlead.integrate.ida.kernels"
SUNDIALS = Compiled(KERNELS, ("rodas", "ida/kernels.py"))
SUNDIALS_KERNELS = {
    "residual": "vidiii", "prepare": "iidid", "solve_prepared": "viii", "multiply": "vidii", "guards": "vidii",
    "judge_step": "iidiiiid", "find_culprit": "ii",
}  # fmt: skip
"""Functions of ida/kernels.py with the types of their result and arguments: void, int64, double."""


@functools.cache
def compiled_sundials() -> dict[str, Callable[..., int]]:
    """The functions of ida/kernels.py by name."""
    code = SUNDIALS.loaded()
    kinds: dict[str, Any] = {"v": None, "i": ctypes.c_int64, "d": ctypes.c_double}
    calls: dict[str, Callable[..., int]] = {}
    for name, types in SUNDIALS_KERNELS.items():
        call = ctypes.CFUNCTYPE(*(kinds[letter] for letter in types))(code.address[name])
        call.keep_alive = code  # type: ignore[attr-defined]
        calls[name] = call
    return calls


def _build_sundials() -> native.Build:
    import numba

    from fairlead.integrate.link_once import linked_once

    kernels = importlib.import_module(KERNELS)
    kinds = {"v": numba.void, "i": numba.int64, "d": numba.float64}
    functions = {}
    with linked_once():
        for name, types in SUNDIALS_KERNELS.items():
            signature = kinds[types[0]](*(kinds[letter] for letter in types[1:]))
            make = numba.cfunc(signature, error_model="numpy", _nrt=False)
            functions[name] = make(getattr(kernels, name))
    return native.Build(meta={}, functions=functions)
