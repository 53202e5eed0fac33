"""Bitcode of the loops for any processor of this architecture, made with numba in a process of its own.

    loop_bitcode(engine) -> bytes                   of one engine: from the installed package, the cache, or made now
    keep(codes)                                     of all these into the cache, made together
    python -m fairlead.integrate.bitcode FOLDER     all of them as files, for a wheel

numba has chosen its processor once it has compiled anything in a process, so this takes another one.

Loops over the unknowns are in vectors already, since no pass of LLVM runs when the code is made native. Vectors are
part of the bitcode's language, whatever the processor: one that has none of this width takes them in pieces. So their
width is that of the processors in use, and each element is computed as without them. (Rows of a hundred blocks took
1.17 times as long without, `guidance_route` 1.09.)

The loops share most of their functions, and to type those takes most of the time. What is made together is typed in
one process, once; LLVM then optimises each module in a copy of that process, where processes can be copied (fork).
"""

from __future__ import annotations

import gc
import multiprocessing
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence

import fairlead.integrate.ahead as ahead
import fairlead.native as native
import fairlead.sealed as sealed
from fairlead.integrate.all_compiled import all_compiled
from fairlead.integrate.engine import Engine
from fairlead.integrate.machine_code import Compiled, loop_code, numba_or_reason
from fairlead.processor import VARIABLE

SETTINGS = {VARIABLE: "generic", "NUMBA_LOOP_VECTORIZE": "1", "NUMBA_SLP_VECTORIZE": "0"}
WIDE = {"x86_64": "x86-64-v3", "AMD64": "x86-64-v3"}
"""Processor whose vectors are laid out, by architecture; elsewhere those that every processor has."""
ONE_VECTOR, ONE_TURN = "-force-vector-interleave=1", "-unroll-runtime=false"
"""One vector a turn of a loop, and no loop of unknown length is written out several times. Several vectors made the
machine code a tenth larger and nothing faster; turns written out doubled the time it takes to make the code native.
"""


def loop_bitcode(engine: Engine) -> bytes:
    """LLVM bitcode of `loop.py` with the method of this engine; it defines the function `loop_symbol(engine)`.

    The function is `int64 advance(int64 address_of_the_structs, int64 attempts)`. Beside libc and libm the code names
    what numba refers to on paths that are never reached (`native.UNREACHED`, and `Py...`): give it stubs. It holds no
    instruction that another processor of the architecture lacks. Takes a minute when it is not at hand, and needs
    numba for that: raises UsageError where numba is missing.
    """
    return _loop(engine)[1]


def loop_symbol(engine: Engine) -> str:
    """Name of the function that `loop_bitcode` defines."""
    return _loop(engine)[0]


def _loop(engine: Engine) -> tuple[str, bytes]:
    code = loop_code(engine)
    stored, reason = ahead.find(code.module, code.fingerprint())
    return (stored or _kept(code, reason)).functions["advance"]


def _kept(code: Compiled, reason: str) -> ahead.Bitcode:
    """Bitcode from the cache, or made now and put there."""
    numba_or_reason(code.module, reason)
    with tempfile.TemporaryDirectory() as scratch:
        path = _place(code, native.cache_folder() or pathlib.Path(scratch))
        try:
            return ahead.read(path)
        except (OSError, sealed.BrokenSealError):
            _make(code, path)
        return ahead.read(path)


def _place(code: Compiled, folder: pathlib.Path) -> pathlib.Path:
    return folder / f"{native.digest('bitcode', code.fingerprint())}.bitcode"


def keep(codes: Iterable[Compiled]) -> None:
    """Have bitcode of all these in the cache, if it can be used; what is missing is made together."""
    folder = native.cache_folder()
    if folder is not None:
        wanted = [code for code in codes if ahead.find(code.module, code.fingerprint())[0] is None]
        missing = [(code, path) for code in wanted if not (path := _place(code, folder)).exists()]
        if missing:
            _make_together(missing)


def kept_with_native(code: Compiled) -> None:
    """Have bitcode and machine code in the cache, the latter made of the former if it is missing."""
    stored, reason = ahead.find(code.module, code.fingerprint())
    code.loaded((stored or _kept(code, reason)).for_here)


def _make(code: Compiled, path: pathlib.Path) -> None:
    """Have another process compile it. Raises CalledProcessError; what it said is on the standard error."""
    _make_together([(code, path)])


SEPARATOR = "--"
"""Between what is made together, on the command line of the process that makes it."""


def _make_together(targets: Sequence[tuple[Compiled, pathlib.Path]]) -> None:
    """The same for several, in one process."""
    told = [word for code, path in targets for word in (SEPARATOR, str(path), code.module, *code.sources)]
    subprocess.run([sys.executable, "-m", "fairlead.integrate.bitcode", *told], env=os.environ | SETTINGS, check=True)


def make_here(targets: Iterable[tuple[Compiled, pathlib.Path]]) -> None:
    """Compile in this process, which was started with SETTINGS, and write the files. Raises OSError."""
    copied = multiprocessing.get_context("fork") if "fork" in multiprocessing.get_all_start_methods() else None
    begun = []
    for code, path in targets:
        made = code.build(cpu=WIDE.get(platform.machine(), "generic"))  # typed and lowered
        if copied is None:
            _optimise(code, made, path)
        else:
            begun.append(copied.Process(target=_optimise, args=(code, made, path)))
            begun[-1].start()
    for process in begun:
        process.join()
    if any(process.exitcode for process in begun):
        raise OSError("bitcode could not be made; what went wrong is told above")


def _optimise(code: Compiled, made: native.Build, path: pathlib.Path) -> None:
    """Link and optimise the functions that numba lowered, and write the file."""
    import llvmlite.binding as llvm

    functions = {
        name: (one.native_name, llvm.parse_assembly(one.inspect_llvm()).as_bitcode())
        for name, one in made.functions.items()
    }
    system, version = ahead.this_system(), llvm.llvm_version_info[0]
    ahead.write(path, ahead.Bitcode(code.fingerprint(), system, version, functions))
    path.chmod(0o644)  # others read what is installed for all


def make_all(folder: pathlib.Path) -> None:
    """Bitcode of everything that fairlead compiles for its own engines."""
    _make_together([(code, folder / f"{code.module}.bitcode") for code in all_compiled()])


def _told(words: Sequence[str]) -> list[tuple[Compiled, pathlib.Path]]:
    """What `_make_together` asks for."""
    starts = [k for k, word in enumerate(words) if word == SEPARATOR]
    groups = [words[k + 1 : end] for k, end in zip(starts, [*starts[1:], len(words)], strict=True)]
    return [(Compiled(module, tuple(sources)), pathlib.Path(path)) for path, module, *sources in groups]


if __name__ == "__main__":
    import llvmlite.binding as llvm

    gc.disable()  # what numba makes stays till the end
    for option in (ONE_VECTOR, ONE_TURN):
        llvm.set_option("", option)
    if sys.argv[1] == SEPARATOR:
        make_here(_told(sys.argv[1:]))
    else:
        make_all(pathlib.Path(sys.argv[1]))
