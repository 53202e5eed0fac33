"""What all workers need, made once: compiled code that tests share, and the files of the tests.

    python -m tests.compiling         the loops, and beside them the functions of rooms that tests of rooms call

With cold caches every worker would otherwise wait for the first loop, and again for the second: whoever comes later
waits until the entry is there (native.py). Functions of a room call most of the engine, which numba would type in every
worker. And each would have pytest rewrite the assertions of all files.
"""

from __future__ import annotations

import ast
import contextlib
import functools
import gc
import importlib
import inspect
import multiprocessing
from collections.abc import Callable
from pathlib import Path

import pytest

from fairlead.integrate.compile_all import compile_all
from fairlead.integrate.engines import RODAS, STEPPING
from fairlead.integrate.machine_code import compiled_loop, compiled_sundials

SHARES: tuple[tuple[Callable[[], object], ...], ...] = (
    (lambda: compiled_loop(RODAS),),
    (lambda: compiled_loop(STEPPING), compiled_sundials),
)
"""What each worker compiles: of about the same length."""
MANY = 3000
"""From so many tests on, all loops are needed."""


def compile_share(session: pytest.Session) -> None:
    """Compile the share of this worker, if it is one of several that run a large part of the tests."""
    worker = getattr(session.config, "workerinput", None)
    if worker is None or worker["workercount"] < len(SHARES) or len(session.items) < MANY:
        return
    number = int(worker["workerid"].removeprefix("gw"))
    for compiled in SHARES[number] if number < len(SHARES) else ():
        compiled()


def read_share(config: pytest.Config) -> None:
    """Import the tests from the share of this worker on; what comes before, the others have left behind for it."""
    worker = getattr(config, "workerinput", None)
    tests = Path(__file__).parent
    if worker is None or [Path(given).resolve() for given in config.args] != [tests]:
        return
    files = sorted(tests.rglob("test_*.py"))
    begin = len(files) * int(worker["workerid"].removeprefix("gw")) // worker["workercount"]
    for file in files[begin:] if begin else ():
        with contextlib.suppress(Exception, pytest.skip.Exception):  # told when it is collected
            importlib.import_module(".".join(file.relative_to(tests.parent).with_suffix("").parts))


def compile_rooms() -> None:
    """Have machine code of the functions of rooms that tests call in the cache, typed in one process."""
    gc.disable()  # what numba makes stays till the end
    room = importlib.import_module("tests.integrate.rooms").room
    for file in sorted((Path(__file__).parent / "integrate").glob("test_*.py")):
        text = file.read_text(encoding="utf-8")
        if "tests.integrate.rooms" not in text:
            continue
        for made in vars(importlib.import_module(f"tests.integrate.{file.stem}")).values():
            if isinstance(made, functools._lru_cache_wrapper) and not inspect.signature(made).parameters:
                made()
        for call in ast.walk(ast.parse(text)):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "room":
                room(*map(ast.literal_eval, call.args))


if __name__ == "__main__":
    rooms = multiprocessing.get_context("spawn").Process(target=compile_rooms)
    rooms.start()
    compile_all(["rodas"])
    rooms.join()
