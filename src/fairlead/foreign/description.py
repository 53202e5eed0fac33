"""What an FMU says of itself: read from its zip archive with FMPy, without running anything of it.

    fmu = read_fmu(path)      Raises Refused for what is no FMU that fairlead can take.

The file may come from anybody: its size is bounded, and its XML may define no entities of its own.
"""

from __future__ import annotations

import functools
import math
import pathlib
import re
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from fairlead.errors import listing, shown
from fairlead.foreign.clocks import Clock, as_fmu, clocks_of
from fairlead.foreign.refusals import Refused
from fairlead.foreign.variables import Variable, variable_of

DESCRIPTION = "modelDescription.xml"
MOST_XML = 50_000_000  # bytes of the description; the largest of the standard's cross-check have some 10 MB
MOST_BYTES = 2_000_000_000  # of all that is unpacked
VERSIONS = {"2.0": 2, "3.0": 3}
PACKAGE = "An FMU is read with the package FMPy; install it with  pip install 'fairlead[fmu]'"


@dataclass(frozen=True)
class BaseUnit:
    """A unit in SI: factor * value + offset, with the exponents of m, kg, s, A, K, rad, and of mol and cd together."""

    exponents: tuple[int, ...]
    others: int
    factor: float
    offset: float


@dataclass(frozen=True, eq=False)
class Fmu:
    """An FMU for co-simulation that this machine can run."""

    file: pathlib.Path
    version: int
    name: str
    token: str
    identifier: str
    variables: Mapping[str, Variable]
    units: Mapping[str, BaseUnit]
    step: float | None  # s, of its default experiment
    fixed_step: float | None  # s; communication steps are multiples of it
    keeps_state: bool
    events: bool = False  # it has an event mode
    splits: bool = False  # its steps may have any length, and may end early
    clocks: Mapping[str, Clock] = field(default_factory=dict)  # the time-based ones

    def of(self, *causalities: str) -> list[Variable]:
        """Variables that can be signals, of these causalities."""
        return [one for one in self.variables.values() if one.causality in causalities and one.numeric]


@functools.lru_cache(maxsize=256)
def shaped(fmu: Fmu, sizes: tuple[tuple[str, int], ...]) -> Fmu:
    """The FMU with arrays as large as structural parameters make them: their start, or what `sizes` says."""
    given = dict(sizes)

    def size(one: int | str) -> int:
        return one if isinstance(one, int) else given.get(one, int(fmu.variables[one].start or 1))

    arrays = {one.name: replace(one, dimensions=tuple(map(size, one.dimensions)))
              for one in fmu.variables.values() if one.dimensions}  # fmt: skip
    return replace(fmu, variables={**fmu.variables, **arrays}) if arrays else fmu


def read_fmu(file: pathlib.Path) -> Fmu:
    """The FMU in a file. Raises Refused."""
    found = file.stat()
    return _read(file, found.st_mtime_ns, found.st_size)


@functools.lru_cache(maxsize=64)
def _read(file: pathlib.Path, written: int, size: int) -> Fmu:
    """Once for every content, so that one file is one class of block."""
    names, text = _archive(file)
    try:
        import fmpy
        from fmpy.model_description import read_model_description
    except ImportError as missing:
        raise Refused(f"cannot be read without a package ({missing})", f"{PACKAGE}.") from None
    try:
        clocks, text = clocks_of(text)
        told = read_model_description(as_fmu(text), validate=False)
        variables = {one.name: variable_of(one) for one in told.modelVariables}
        variables |= {name: replace(variables[name], most=most) for name, most in _largest_sizes(text)}
    except Refused:
        raise
    except Exception as error:  # what FMPy and lxml raise for damaged descriptions has no common base
        raise Refused(f"has a {DESCRIPTION} that cannot be read: {shown(str(error))}", "Export it again.") from error
    of_run = told.coSimulation
    if of_run is None:
        kind = "scheduled execution" if told.scheduledExecution is not None else "model exchange"
        raise Refused(f"is for {kind} only", "Export it for co-simulation.")
    if not of_run.hasEventMode and (ticking := [one.name for one in variables.values() if one.kind == "Clock"]):
        raise Refused(f"has clocks ({listing(ticking)}) and no event mode (hasEventMode), in which they tick",
                      "Export it with an event mode, or without clocks.")  # fmt: skip
    version = VERSIONS[told.fmiVersion]
    _platform(names, of_run.modelIdentifier, fmpy.platform if version == 2 else fmpy.platform_tuple)
    step = told.defaultExperiment.stepSize if told.defaultExperiment is not None else None
    return Fmu(
        file, version, told.modelName or file.stem, told.guid, of_run.modelIdentifier,
        variables,
        {unit.name: _base(unit.baseUnit) for unit in told.unitDefinitions if unit.baseUnit is not None},
        _positive(step), _positive(of_run.fixedInternalStepSize), bool(of_run.canGetAndSetFMUstate),
        bool(of_run.hasEventMode), bool(of_run.canHandleVariableCommunicationStepSize), clocks,
    )  # fmt: skip


def _archive(file: pathlib.Path) -> tuple[list[str], bytes]:
    """Names of the files in it, and its description, of an archive of a version that is known. Raises Refused."""
    try:
        with zipfile.ZipFile(file) as archive:
            held = {info.filename: info for info in archive.infolist()}
            if DESCRIPTION not in held:
                raise Refused(f"is no FMU: it holds no {DESCRIPTION}", "Export it again.")
            if held[DESCRIPTION].file_size > MOST_XML or sum(one.file_size for one in held.values()) > MOST_BYTES:
                most = f"{MOST_BYTES / 1e9:g} GB, its description {MOST_XML / 1e6:g} MB"
                raise Refused("is too large when unpacked", f"An FMU may have {most}.")
            text = archive.read(DESCRIPTION)
    except (OSError, zipfile.BadZipFile, NotImplementedError, RuntimeError) as error:
        raise Refused(f"is no FMU: {shown(str(error))}", "An FMU is a zip archive; export it again.") from None
    if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
        raise Refused(f"has a {DESCRIPTION} that defines entities", "No FMU needs them; do not use the file.")
    found = re.search(rb"fmiVersion\s*=\s*[\"']([^\"']*)", text)
    version = found[1].decode(errors="replace") if found else ""
    if version not in VERSIONS:
        raise Refused(f"is of FMI version {shown(version) or 'unknown'}", f"Export it for FMI {listing(VERSIONS)}.")
    return list(held), text


def _platform(names: list[str], identifier: str, here: str) -> None:
    """Whether it has code for this machine."""
    found = sorted({name.split("/")[1] for name in names if re.match(r"binaries/[^/]+/.", name)})
    extension = {"win": ".dll", "dar": ".dylib"}.get(here.partition("-")[2][:3] or here[:3], ".so")
    if f"binaries/{here}/{identifier}{extension}" in names:
        return
    has = f"it has {listing(found)}" if found else "it has none"
    source = any(name.startswith("sources/") for name in names)
    compiled = ", or compile its sources:  fmpy compile FILE" if source else ""
    raise Refused(f"has no code for this machine ({here}); {has}", f"Export it for {here}{compiled}.")


def _largest_sizes(text: bytes) -> Iterator[tuple[str, int]]:
    """Structural parameters with their `max`, which FMPy does not read."""
    if b"structuralParameter" in text:
        for one in ET.fromstring(text).iterfind("ModelVariables/UInt64"):
            if one.get("causality") == "structuralParameter" and "max" in one.attrib:
                yield one.attrib["name"], int(one.attrib["max"])


def _base(unit: Any) -> BaseUnit:
    exponents = tuple(int(getattr(unit, name)) for name in ("m", "kg", "s", "A", "K", "rad"))
    others = abs(int(unit.mol)) + abs(int(unit.cd))
    return BaseUnit(exponents, others, float(unit.factor), float(unit.offset))


def _positive(number: Any) -> float | None:
    """A time of the description; None where it says nothing sensible."""
    try:
        value = float(number)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) and value > 0 else None
