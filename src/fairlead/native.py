"""Machine code of compiled functions: made once, kept on disk, loaded without the compiler.

    key = digest(source_text, ...)                 everything the code depends on
    native = load_or_compile(key, build)           build() runs on a miss only, and imports the compiler: numba
                                                   for the integrator, `kernels/lowering.py` for kernels
    native.address["rhs"]                          C function address, callable through ctypes

numba's own cache watches one file per function and goes stale when a called function in another
file changes, and reading it costs the import of numba (0.3 s). Here an entry is one file named by
the hash of everything it depends on; it holds the object code and whatever the builder wants to
remember (`meta`). Loading takes llvmlite only, about 20 ms.

The folder is private to the user, because what it holds is executed. An entry that is torn, foreign
or of another name (see `sealed.py`), and a folder that cannot be written, mean one warning and a compile in memory.

Code is made for the processor it runs on (`processor.py`), and the key says so, so that the builds
for two processors lie side by side.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import hashlib
import json
import os
import pathlib
import platform
import struct
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, cast

import fairlead.sealed as sealed
from fairlead.processor import processor

MAGIC = b"fairlead-native-3\n"
PATIENCE = 300.0
"""Seconds that a process waits for another that compiles the same; the loop takes a minute on a slow machine."""
# numba refers to these only on paths that raise or count references; compiled laws do neither.
UNREACHED = (
    "NRT_Free", "NRT_MemInfo_call_dtor", "NRT_decref", "NRT_incref", "numba_do_raise", "numba_gil_ensure",
    "numba_gil_release", "numba_runtime_build_excinfo_struct", "numba_unpickle",
)


class CacheWarning(UserWarning):
    """The kernel cache could not be used as it should; compiled code lives in memory instead."""


@dataclass(frozen=True)
class Optimised:
    """One function as LLVM bitcode that has been through LLVM's passes: its symbol, and the module that defines it."""

    native_name: str
    bitcode: bytes


@dataclass(frozen=True)
class Build:
    """What a builder returns: facts to remember (JSON) and functions by name.

    A function is a numba `cfunc`, or anything with its `inspect_llvm()` and `native_name`; or it is `Optimised`.
    Functions with the same text lie in one module, of which machine code is made once.
    """

    meta: dict[str, Any]
    functions: dict[str, Any]


@dataclass(frozen=True)
class Native:
    """Loaded machine code: C addresses by name, the builder's facts, and whether it came from disk."""

    address: dict[str, int]
    meta: dict[str, Any]
    cached: bool
    engines: list[Any] = field(repr=False, default_factory=list)  # keep the code alive


@dataclass(frozen=True)
class _ObjectCode:
    """A relocatable object, and the functions that it defines: symbols by name."""

    symbols: dict[str, str]
    code: bytes


def digest(*parts: str) -> str:
    """Hash of the parts together with everything else machine code depends on: tools and CPU."""
    state = hashlib.sha256()
    for part in (*_environment(), *parts):
        state.update(len(part).to_bytes(8, "little") + part.encode())
    return state.hexdigest()


@functools.cache
def _environment() -> tuple[str, ...]:
    import llvmlite
    import numpy

    versions = (llvmlite.__version__, numpy.__version__)
    chosen = processor()
    own = pathlib.Path(__file__).read_text(encoding="utf-8")
    return (*versions, chosen.cpu, chosen.features, platform.platform(), platform.machine(), sys.version, own)


def load_or_compile(key: str, build: Callable[[], Build]) -> Native:
    """Machine code under `key` from the cache, or from `build()` when it is not there.

    Of processes that ask for the same at once one compiles, the others wait for it. Never raises for a bad cache: it
    warns (CacheWarning) and compiles.
    """
    folder = cache_folder()
    entry = folder / f"{key}.native" if folder is not None else None
    stored = _read(entry) if entry is not None else None
    if stored is not None:
        return _load(*stored, cached=True)
    begun = time.perf_counter()
    try:
        return _made(key, build, folder)
    finally:
        _spent[0] += time.perf_counter() - begun


def spent_compiling() -> float:
    """Seconds that this process has spent compiling, or waiting for another that compiles the same."""
    return _spent[0]


_spent = [0.0]


def _made(key: str, build: Callable[[], Build], folder: pathlib.Path | None) -> Native:
    """Machine code that was not on disk a moment ago."""
    if folder is None:
        return _load(*_compiled(build()), cached=False)
    entry = folder / f"{key}.native"
    with _alone(folder / f"{key}.lock"):
        stored = _read(entry) if entry.exists() else None
        if stored is not None:
            return _load(*stored, cached=True)
        made = _compiled(build())
        _write(entry, *made)
    return _load(*made, cached=False)


@contextlib.contextmanager
def _alone(path: pathlib.Path) -> Iterator[None]:
    """Hold the lock of a file while compiling; without one where the folder has no locks, or another takes too long.

    The lock dies with its process. The file may be removed by whoever holds it: those that waited find the entry.
    """
    import filelock  # takes a quarter of a second, and is needed where something is compiled

    lock = filelock.FileLock(path, timeout=PATIENCE)
    try:
        lock.acquire()
    except (OSError, NotImplementedError):  # a Timeout is an OSError
        yield
        return
    try:
        yield
    finally:
        with contextlib.suppress(OSError):  # Windows does not remove an open file
            path.unlink()
        lock.release()


def _compiled(made: Build) -> tuple[dict[str, Any], list[_ObjectCode]]:
    symbols: dict[str | bytes, dict[str, str]] = {}
    for name, function in made.functions.items():
        source = function.bitcode if isinstance(function, Optimised) else function.inspect_llvm()
        symbols.setdefault(source, {})[name] = function.native_name
    return made.meta, [_ObjectCode(names, object_code(source)) for source, names in symbols.items()]


def cache_folder() -> pathlib.Path | None:
    """The private folder of compiled code, made when missing; None (and a warning) when unusable.

    FAIRLEAD_CACHE names another place. On POSIX the folder must belong to the user and be closed
    to others: machine code found in a folder that others may write to is not run.
    """
    import platformdirs

    chosen = os.environ.get("FAIRLEAD_CACHE")
    folder = pathlib.Path(chosen) if chosen else platformdirs.user_cache_path("fairlead") / "native"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.name == "posix":
            status = folder.stat()
            if status.st_uid != os.getuid() or status.st_mode & 0o022:
                raise PermissionError(f"{folder} belongs to or can be written by somebody else")
    except OSError as error:
        _warn_once(f"kernel cache not used: {error}; compiled code is kept in memory")
        return None
    return folder


def _read(path: pathlib.Path) -> tuple[dict[str, Any], list[_ObjectCode]] | None:
    """Entry at `path`, or None when it is absent or not whole."""
    try:
        body = sealed.read(path, MAGIC)
    except FileNotFoundError:
        return None
    except sealed.BrokenSealError as error:
        _warn_once(f"kernel cache entry {error}; compiling again")
        return None
    except OSError as error:
        _warn_once(f"kernel cache entry cannot be read: {error}; compiling again")
        return None
    (length,) = struct.unpack_from("<Q", body)
    header = json.loads(body[8 : 8 + length])
    objects, position = [], 8 + length
    for symbols, size in header["objects"]:
        objects.append(_ObjectCode(symbols, body[position : position + size]))
        position += size
    return header["meta"], objects


def _write(path: pathlib.Path, meta: dict[str, Any], objects: list[_ObjectCode]) -> None:
    """Store an entry; a disk that refuses means a warning."""
    header = json.dumps({"meta": meta, "objects": [(o.symbols, len(o.code)) for o in objects]}).encode()
    body = struct.pack("<Q", len(header)) + header + b"".join(o.code for o in objects)
    try:
        sealed.write(path, MAGIC, body)
    except OSError as error:
        _warn_once(f"kernel cache cannot be written: {error}; compiled code is kept in memory")


@functools.cache
def _prepare_llvm() -> None:
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    never = ctypes.cast(ctypes.pythonapi.PyErr_Clear, ctypes.c_void_p).value
    for name in UNREACHED:
        if llvm.address_of_symbol(name) is None:
            llvm.add_symbol(name, never)


def target_machine(cpu: str = "") -> Any:
    """A new LLVM target machine for the processor of that name, else the chosen one.

    Every execution engine takes over the one that it is given.
    """
    import llvmlite.binding as llvm

    _prepare_llvm()
    chosen = processor()
    name, features = (cpu, "") if cpu else (chosen.cpu, chosen.features)
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=name, features=features, opt=3, jit=True, codemodel="jitdefault"
    )


def object_code(source: str | bytes) -> bytes:
    """Machine code of a module, from optimised LLVM text such as numba publishes, or from bitcode."""
    import llvmlite.binding as llvm

    machine = target_machine()
    module = llvm.parse_assembly(source) if isinstance(source, str) else llvm.parse_bitcode(source)
    return cast(bytes, machine.emit_object(module))


def _load(meta: dict[str, Any], objects: list[_ObjectCode], *, cached: bool) -> Native:
    import llvmlite.binding as llvm

    addresses: dict[str, int] = {}
    engines = []
    for stored in objects:
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target_machine())
        engine.add_object_file(llvm.ObjectFileRef.from_data(stored.code))
        engine.finalize_object()
        addresses |= {name: engine.get_function_address(symbol) for name, symbol in stored.symbols.items()}
        engines.append(engine)
    return Native(addresses, meta, cached, engines)


@functools.cache
def _warn_once(text: str) -> None:
    warnings.warn(text, CacheWarning, stacklevel=3)
