"""The processor that machine code is made for: this one, or any of its architecture.

    FAIRLEAD_CPU=host       every instruction of this processor (the default)
    FAIRLEAD_CPU=generic    only the instructions that all processors of this architecture have: SSE2 on x86-64

The generic build answers the question whether a result depends on the processor. It is slower, and is
compiled once, as the other one is; both are kept. The choice holds for a whole process: it is read once. What is
exported is made for any processor whatever the choice (`for_any_processor`).
"""

from __future__ import annotations

import contextlib
import functools
import os
import platform
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass

from fairlead.errors import UsageError, did_you_mean

VARIABLE = "FAIRLEAD_CPU"
BUILDS = ("host", "generic")


@dataclass(frozen=True)
class Processor:
    """What LLVM compiles for: a name it knows, the instructions beside (`+avx2,-fma`), and which build that is."""

    build: str
    cpu: str
    features: str

    def __str__(self) -> str:
        return self.cpu if self.build == "host" else f"generic {platform.machine()}"


GENERIC = Processor("generic", "generic", "")
_EXPORTED: ContextVar[bool] = ContextVar("_EXPORTED", default=False)


@contextlib.contextmanager
def for_any_processor() -> Iterator[None]:
    """Code that is lowered inside is for any processor of this architecture; none of it may come from the cache."""
    before = _EXPORTED.set(True)
    try:
        yield
    finally:
        _EXPORTED.reset(before)


def processor() -> Processor:
    """The processor that code is made for here. Raises UsageError when FAIRLEAD_CPU is no known word."""
    return GENERIC if _EXPORTED.get() else chosen()


@functools.cache
def chosen() -> Processor:
    """The processor that this process compiles for. Raises UsageError when FAIRLEAD_CPU is no known word."""
    build = os.environ.get(VARIABLE) or "host"
    if build not in BUILDS:
        what = f"{VARIABLE}={build}: there is no such build. {did_you_mean(build, BUILDS)}".rstrip()
        raise UsageError(f"{what}\n    It is {' or '.join(BUILDS)}, or not set.")
    if build == "generic":
        return GENERIC
    import llvmlite.binding as llvm

    return Processor(build, llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten())


def tell_numba(cpu: str = "") -> None:
    """Have numba compile for `processor()`, or in the vectors of the processor that is named.

    It comes before the first function is compiled in a process.
    """
    from numba.core import config

    if cpu or processor().build == "generic":
        config.CPU_NAME, config.CPU_FEATURES = cpu or "generic", ""
