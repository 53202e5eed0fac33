"""The processor that machine code is made for: this one, or any of its architecture.

    FAIRLEAD_CPU=host       every instruction of this processor (the default)
    FAIRLEAD_CPU=generic    only the instructions that all processors of this architecture have: SSE2 on x86-64

The generic build answers the question whether a result depends on the processor. It is slower, and is
compiled once, as the other one is; both are kept. The choice holds for a whole process: it is read once.
"""

from __future__ import annotations

import functools
import os
import platform
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


@functools.cache
def processor() -> Processor:
    """The processor that this process compiles for. Raises UsageError when FAIRLEAD_CPU is no known word."""
    build = os.environ.get(VARIABLE) or "host"
    if build not in BUILDS:
        what = f"{VARIABLE}={build}: there is no such build. {did_you_mean(build, BUILDS)}".rstrip()
        raise UsageError(f"{what}\n    It is {' or '.join(BUILDS)}, or not set.")
    if build == "generic":
        return Processor(build, "generic", "")
    import llvmlite.binding as llvm

    return Processor(build, llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten())


def tell_numba() -> None:
    """Have numba compile for `processor()`. It comes before the first function is compiled in a process."""
    from numba.core import config

    if processor().build == "generic":
        config.CPU_NAME, config.CPU_FEATURES = "generic", ""
