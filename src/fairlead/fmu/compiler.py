"""The C compiler of this machine, which compiles the wrapper and links a library.

Taken is what the environment names as CC, else cc, gcc or clang, else the package `ziglang`.
"""

from __future__ import annotations

import importlib.util
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence

from fairlead.errors import UsageError

NAMES = ("cc", "gcc", "clang")
FLAGS = ("-shared", "-fPIC", "-O2", "-std=gnu11", "-fvisibility=hidden", "-ffp-contract=off", "-fno-strict-aliasing")
LINKED = ("-Wl,--build-id=none", "-Wl,--no-undefined", "-s", "-lm")
"""Nothing in the library tells when or where it was made."""
PATIENCE = 300.0
"""Seconds that a compiler may take; the wrapper takes about one."""
LAST_LINES = 20
ANOTHER = "Name another one in the environment (CC), or none: then cc, gcc, clang or ziglang is taken."


def compiler() -> list[str]:
    """The command of the C compiler. Raises UsageError where there is none."""
    if asked := shlex.split(os.environ.get("CC", "")):
        return asked
    if found := next(filter(None, map(shutil.which, NAMES)), None):
        return [found]
    if importlib.util.find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-linux-gnu.2.17"]
    raise UsageError(
        f"There is no C compiler here ({', '.join(NAMES)}), which links an FMU.\n"
        "    Install one, name one in the environment (CC), or: pip install 'fairlead[zig]', which brings ziglang."
    )


def linked(files: Mapping[str, bytes]) -> bytes:
    """A shared library of C files and objects, by name. Raises UsageError where the compiler fails."""
    command = compiler()
    with tempfile.TemporaryDirectory(prefix="fairlead-") as scratch:
        folder = pathlib.Path(scratch)
        for name, content in files.items():
            (folder / name).write_bytes(content)
        given = sorted(name for name in files if name.endswith((".c", ".o")))
        _call([*command, *FLAGS, "-o", "library.so", *given, *LINKED], folder)
        made = folder / "library.so"
        if not made.exists():
            raise UsageError(f"The C compiler {command[0]} made no library.\n    {ANOTHER}")
        return made.read_bytes()


def compiles(files: Mapping[str, bytes], program: str) -> bool:
    """Whether a program of these files is one in C."""
    with tempfile.TemporaryDirectory(prefix="fairlead-") as scratch:
        folder = pathlib.Path(scratch)
        for name, content in files.items():
            (folder / name).write_bytes(content)
        try:
            _call([*compiler(), "-std=gnu11", "-fsyntax-only", program], folder)
        except UsageError:
            return False
    return True


def _call(command: Sequence[str], folder: pathlib.Path) -> None:
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=PATIENCE, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise UsageError(f"The C compiler cannot be called: {error}.\n    {ANOTHER}") from error
    if done.returncode:
        said = "\n    ".join(done.stderr.strip().splitlines()[-LAST_LINES:]) or ANOTHER
        raise UsageError(f"The C compiler {command[0]} failed with code {done.returncode}:\n    {said}")
