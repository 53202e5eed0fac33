"""Bitcode of the loops for any processor of this architecture, made with numba in processes of their own.

    loop_bitcode(engine) -> bytes                   of one engine: from the installed package, the cache, or made now
    python -m fairlead.integrate.bitcode FOLDER     all of them as files, for a wheel

numba has chosen its processor once it has compiled anything in a process, so this takes another one. It leaves the
vectors to the processor that the code is made native on.
"""

from __future__ import annotations

import gc
import os
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import fairlead.integrate.ahead as ahead
import fairlead.native as native
import fairlead.sealed as sealed
from fairlead.integrate.all_compiled import all_compiled
from fairlead.integrate.engine import Engine
from fairlead.integrate.machine_code import Compiled, loop_code, numba_or_reason
from fairlead.processor import VARIABLE

SETTINGS = {VARIABLE: "generic", "NUMBA_LOOP_VECTORIZE": "0", "NUMBA_SLP_VECTORIZE": "0", "NUMBA_CPU_NAME": "generic"}


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
        folder = native.cache_folder() or pathlib.Path(scratch)
        path = folder / f"{native.digest('bitcode', code.fingerprint())}.bitcode"
        try:
            return ahead.read(path)
        except (OSError, sealed.BrokenSealError):
            _make(code, path)
        return ahead.read(path)


def kept_with_native(code: Compiled) -> None:
    """Have bitcode and machine code in the cache, the latter made of the former if it is missing."""
    stored, reason = ahead.find(code.module, code.fingerprint())
    code.loaded((stored or _kept(code, reason)).for_here)


def _make(code: Compiled, path: pathlib.Path) -> None:
    """Have another process compile it. Raises CalledProcessError; what it said is on the standard error."""
    command = [sys.executable, "-m", "fairlead.integrate.bitcode", str(path), code.module, *code.sources]
    subprocess.run(command, env=os.environ | SETTINGS, check=True)


def make_here(code: Compiled, path: pathlib.Path) -> None:
    """Compile in this process, which was started with SETTINGS, and write the file."""
    import llvmlite.binding as llvm

    functions = {
        name: (made.native_name, llvm.parse_assembly(made.inspect_llvm()).as_bitcode())
        for name, made in code.build().functions.items()
    }
    system, version = ahead.this_system(), llvm.llvm_version_info[0]
    ahead.write(path, ahead.Bitcode(code.fingerprint(), system, version, functions))
    path.chmod(0o644)  # others read what is installed for all


def make_all(folder: pathlib.Path) -> None:
    """Bitcode of everything that fairlead compiles for its own engines, a process each, as many as there are cores."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda code: _make(code, folder / f"{code.module}.bitcode"), all_compiled()))


if __name__ == "__main__":
    gc.disable()  # what numba makes stays till the end
    target, *which = sys.argv[1:]
    if which:
        make_here(Compiled(which[0], tuple(which[1:])), pathlib.Path(target))
    else:
        make_all(pathlib.Path(target))
