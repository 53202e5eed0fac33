"""The examinations of `fairlead doctor`: each looks at one thing and names a cure when it is not well."""

import importlib
import importlib.metadata
import math
import os
import pathlib
import platform
import re
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from dataclasses import asdict, dataclass

REINSTALL = "Install again in a fresh environment (docs/start.md, Install)"

OSCILLATOR = """
schema: 1
name: doctor
description: A block on a spring, pushed from rest; x = (F/k) (1 - cos(sqrt(k/m) t)).
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg}
  push: {type: ForceSource, force: 1 N}
connections:
  - [wall.flange, spring.a]
  - [spring.b, block.flange, push.flange]
run: {stop: 1 s, accuracy: 1e-6}
record: {signals: [block.x]}
"""
OSCILLATOR_END = 0.01 * (1 - math.cos(10.0))
"""Closed form of the block's position at 1 s, in m (undamped oscillator under a step of force)."""
SELF_TEST_TOLERANCE = 1e-6  # m; 1e-4 of the amplitude, a hundred times the accuracy asked


@dataclass(frozen=True)
class Finding:
    """What one examination found; `cure` is empty when all is well."""

    subject: str
    detail: str
    cure: str = ""

    @property
    def well(self) -> bool:
        """True if there is nothing to mend."""
        return not self.cure

    def record(self) -> dict[str, object]:
        """The finding for JSON."""
        return {**asdict(self), "well": self.well}

    def __str__(self) -> str:
        mark = " " if self.well else "x"
        return f"{mark} {self.subject:<14}{self.detail}" + (f"\n    cure: {self.cure}" if self.cure else "")


def examine() -> Iterator[Finding]:
    """Every finding, as soon as it is made."""
    yield from (versions(), processor())
    yield from libraries()
    yield from (kernel_cache(), write_access())
    yield from self_test()


def versions() -> Finding:
    """Fairlead, Python and the operating system."""
    detail = (
        f"fairlead {importlib.metadata.version('fairlead')}, Python {platform.python_version()} "
        f"({sys.executable}), {platform.platform()}"
    )
    cure = "" if sys.version_info >= (3, 11) else "Install Python 3.11 or newer."
    return Finding("versions", detail, cure)


def processor() -> Finding:
    """The processor of this machine, and the one that laws and engine are compiled for."""
    from fairlead.errors import UsageError
    from fairlead.processor import BUILDS, VARIABLE, processor

    try:
        import llvmlite.binding as llvm

        chosen = processor()
    except (ImportError, OSError) as error:
        return Finding("processor", f"llvmlite does not load: {error}", REINSTALL)
    except UsageError as error:
        cure = f"Set {VARIABLE} to {' or '.join(BUILDS)}, or not at all."
        return Finding("processor", str(error).split("\n")[0], cure)
    here = f"{llvm.get_host_cpu_name()}, {platform.machine()}, {os.cpu_count()} cores"
    return Finding("processor", f"{here}; compiled for {'it' if chosen.build == 'host' else chosen}")


def libraries() -> Iterator[Finding]:
    """Whether each dependency is there and loads; a broken wheel shows here, not in the middle of a run."""
    loaded = []
    for requirement in importlib.metadata.requires("fairlead") or ():
        if "extra ==" in requirement:
            continue
        name = re.split(r"[^A-Za-z0-9_.-]", requirement, maxsplit=1)[0]
        try:
            loaded.append(f"{name} {importlib.metadata.version(name)}")
            importlib.import_module({"pyyaml": "yaml"}.get(name.lower(), name))
        except Exception as error:  # noqa: BLE001  (whatever a broken library raises is what to tell)
            yield Finding(name, f"does not load: {error}", REINSTALL)
    yield Finding("libraries", ", ".join(loaded))


def kernel_cache() -> Finding:
    """The folder of compiled kernels: private, writable, how full."""
    from fairlead import native

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        folder = native.cache_folder()
    cure = "Make it yours alone (chmod 700), or name another folder in the variable FAIRLEAD_CACHE."
    if folder is None:
        why = str(caught[-1].message) if caught else "kernel cache not used; compiled code is kept in memory"
        return Finding("kernel cache", why, cure)
    problem = unwritable(folder)
    if problem:
        return Finding("kernel cache", f"{folder} cannot be written: {problem}", cure)
    sizes = [file.stat().st_size for file in folder.glob("*.native")]
    return Finding("kernel cache", f"{folder}, {len(sizes)} entries, {sum(sizes) / 1e6:.1f} MB")


def write_access() -> Finding:
    """Whether results can be written here."""
    folder = pathlib.Path.cwd()
    problem = unwritable(folder)
    if problem:
        cure = "Work in another folder, or run with --out DIR."
        return Finding("results", f"{folder} cannot be written: {problem}", cure)
    return Finding("results", f"{folder} can be written")


def unwritable(folder: pathlib.Path) -> str:
    """Why no file can be made in `folder`; empty if one can."""
    try:
        with tempfile.TemporaryFile(dir=folder):
            return ""
    except OSError as error:
        return error.strerror or str(error)


def self_test() -> Iterator[Finding]:
    """Run an oscillator twice, the second time with warm kernels, and compare with its closed form."""
    with tempfile.TemporaryDirectory() as folder:
        netlist = pathlib.Path(folder) / "doctor.yaml"
        netlist.write_text(OSCILLATOR, encoding="utf-8")
        for number, subject in enumerate(("first run", "second run")):
            finding = _timed_run(subject, netlist, pathlib.Path(folder) / str(number))
            yield finding
            if not finding.well:
                return


def _timed_run(subject: str, netlist: pathlib.Path, out: pathlib.Path) -> Finding:
    import fairlead

    begin = time.perf_counter()
    try:
        result = fairlead.load(str(netlist)).run(out=out)
        end = float(result["block.x"][-1])
    except Exception as error:  # noqa: BLE001  (a doctor reports what it finds)
        return Finding(subject, f"failed: {error}", f"{REINSTALL}; if it stays, send this to the developers.")
    seconds = time.perf_counter() - begin
    wrong = abs(end - OSCILLATOR_END)
    detail = f"{seconds:.2f} s, {wrong:.0e} m from the closed form"
    cure = "" if wrong < SELF_TEST_TOLERANCE else "The result is wrong: send this to the developers."
    return Finding(subject, detail, cure)
