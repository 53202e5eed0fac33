"""What a measured time depends on: processor, load, versions, the commit; and clocks that a busy machine spares.

Times are CPU times of the process where two programs are compared: on a machine shared with others the wall
clock also counts their work. The wall time stands beside it. Threads of the linear algebra library are
switched off (before numpy is imported), or their spinning would count as work.
"""

from __future__ import annotations

import importlib.metadata
import os
import pathlib
import platform
import subprocess
import time
from collections.abc import Callable
from typing import NamedTuple

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

PACKAGES = ("fairlead", "numpy", "scipy", "numba", "scikit-sundae", "mujoco", "pathsim", "networkx", "matplotlib")


class Timed(NamedTuple):
    """Seconds that one call took."""

    cpu: float
    wall: float


def timed(work: Callable[[], object]) -> Timed:
    """CPU and wall time of one call."""
    cpu, wall = time.process_time(), time.perf_counter()
    work()
    return Timed(time.process_time() - cpu, time.perf_counter() - wall)


def machine() -> dict[str, object]:
    """Processor, load and versions, as they are written into every data file."""
    return {
        "date": time.strftime("%Y-%m-%d %H:%M"),
        "processor": _processor(),
        "processors": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}",
        "load_average": [round(load, 1) for load in os.getloadavg()] if hasattr(os, "getloadavg") else [],
        "python": platform.python_version(),
        "versions": {name: importlib.metadata.version(name) for name in PACKAGES},
        "commit": commit(),
    }


def sentence(found: dict) -> str:
    """The machine on one line."""
    versions = ", ".join(f"{name} {version}" for name, version in found["versions"].items())
    load = " ".join(map(str, found["load_average"]))
    return (
        f"{found['processors']} x {found['processor']}, {found['system']}, Python {found['python']}, {versions}, "
        f"commit {found['commit']}, load average at the start {load} ({found['date']})"
    )


def _processor() -> str:
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or "unknown processor"
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"


def commit() -> str:
    """The commit that is measured."""
    here = pathlib.Path(__file__).parent
    try:
        found = subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], cwd=here, capture_output=True, text=True, check=False
        )
    except OSError:
        return "unknown"
    return found.stdout.strip() or "unknown"
