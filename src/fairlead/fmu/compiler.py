"""The C compiler, which compiles the wrapper and links a library.

For this machine's system it is what the environment names as CC, else cc, gcc or clang, else the package `ziglang`. For
all others it is that package, which brings their C libraries.
"""

from __future__ import annotations

import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence

from fairlead.errors import UsageError
from fairlead.fmu.platforms import HERE, PLATFORMS, Platform, has_ziglang

NAMES = ("cc", "gcc", "clang")
FLAGS = ("-shared", "-fPIC", "-O2", "-std=gnu11", "-fvisibility=hidden", "-ffp-contract=off", "-fno-strict-aliasing")
PATIENCE = 1200.0
"""Seconds that a compiler may take: a few, but ziglang makes the C library of a system, once: minutes for Windows."""
LAST_LINES = 20
ANOTHER = "Name another one in the environment (CC), or none: then cc, gcc, clang or ziglang is taken."


def compiler_for(platform: Platform) -> list[str]:
    """The command of the C compiler for a system. Raises UsageError where there is none."""
    if platform.name == HERE:
        return compiler()
    if has_ziglang():
        return _ziglang(platform)
    raise UsageError(
        f"--platform {platform.name}: such a library is linked by ziglang, which is not installed.\n"
        f"    pip install 'fairlead[zig]', or leave it out: without it the library is for {HERE}."
    )


def compiler() -> list[str]:
    """The command of the C compiler of this machine. Raises UsageError where there is none."""
    if asked := shlex.split(os.environ.get("CC", "")):
        return asked
    if found := next(filter(None, map(shutil.which, NAMES)), None):
        return [found]
    if has_ziglang():
        return _ziglang(PLATFORMS[HERE])
    raise UsageError(
        f"There is no C compiler here ({', '.join(NAMES)}), which links an FMU.\n"
        "    Install one, name one in the environment (CC), or: pip install 'fairlead[zig]', which brings ziglang."
    )


def _ziglang(platform: Platform) -> list[str]:
    return [sys.executable, "-m", "ziglang", "cc", "-target", platform.target]


def linked(files: Mapping[str, bytes], name: str, platform: Platform) -> Mapping[str, bytes]:
    """A shared library of that name, of C files and objects: files by name.

    It is one file, but beside that for Windows is NAME.lib. Raises UsageError where the compiler fails.
    """
    command, library = compiler_for(platform), platform.file(name)
    with tempfile.TemporaryDirectory(prefix="fairlead-") as scratch:
        folder = pathlib.Path(scratch)
        for file, content in files.items():
            (folder / file).write_bytes(content)
        given = sorted(file for file in files if file.endswith((".c", ".o")))
        _call([*command, *FLAGS, "-o", library, *given, *platform.flags(name)], folder)
        made = folder / library
        if not made.exists():
            raise UsageError(f"The C compiler {command[0]} made no library.\n    {ANOTHER}")
        beside = folder / f"{name}.lib"
        return {file.name: file.read_bytes() for file in (made, beside) if file.exists()}


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
