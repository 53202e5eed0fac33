"""modelDescription.xml of an FMU, for version 3 or 2 of the standard.

Value references: 0 is time, then come inputs, outputs and tunable parameters, in order. Every variable is a real
number in an SI unit.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from fairlead.fmu.tuned import BEFORE, Tuned
from fairlead.outer import Variable
from fairlead.quantities import BASES, ENERGY, parse_unit

NOT_IN_XML = re.compile("[^\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
CATEGORIES = ("logStatusWarning", "logStatusError")
TIME = ("time", "simulation_time", "independent_time")
"""Names of the independent variable, of which the first is taken that no other variable has."""
SHARED = {
    "canHandleVariableCommunicationStepSize": "true", "canBeInstantiatedOnlyOncePerProcess": "false",
    "needsExecutionTool": "false",
}  # fmt: skip
OF_COSIMULATION = {
    2: SHARED | {"canGetAndSetFMUstate": "true", "canSerializeFMUstate": "true", "canInterpolateInputs": "false",
                 "maxOutputDerivativeOrder": "0", "canRunAsynchronuously": "false",
                 "canNotUseMemoryManagementFunctions": "true", "providesDirectionalDerivative": "false"},
    3: SHARED | {"canGetAndSetFMUState": "true", "canSerializeFMUState": "true", "hasEventMode": "true",
                 "mightReturnEarlyFromDoStep": "true", "providesIntermediateUpdate": "false",
                 "canReturnEarlyAfterIntermediateUpdate": "false", "maxOutputDerivativeOrder": "0"},
}  # fmt: skip


@dataclass(frozen=True)
class About:
    """What an FMU is, beside its variables."""

    name: str
    identifier: str
    description: str
    token: str
    digest: str
    """Of the netlist."""
    version: str
    """Of fairlead."""
    licence: str
    start: float
    stop: float
    accuracy: float


DEVICES = frozenset(("con", "prn", "aux", "nul", *(f"{port}{k}" for port in ("com", "lpt") for k in range(1, 10))))
"""What Windows takes for a device, whatever the ending: a file of that name cannot be unpacked there."""


def identifier(name: str, longest: int = 60) -> str:
    """A name in C for a model, which is that of its library as well: letters of ASCII, digits, underscores."""
    safe = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)[:longest]
    free = safe and not safe[0].isdigit() and safe.lower() not in DEVICES
    return safe if free else f"model_{safe}"


def description(about: About, variables: Sequence[Variable], tuned: Sequence[Tuned], version: int) -> bytes:
    """The text."""
    root = ET.Element("fmiModelDescription", _head(about, version))
    ET.SubElement(root, "CoSimulation", {"modelIdentifier": about.identifier} | OF_COSIMULATION[version])
    _units(root, variables)
    categories = ET.SubElement(root, "LogCategories")
    for category in CATEGORIES:
        ET.SubElement(categories, "Category", name=category)
    ET.SubElement(
        root, "DefaultExperiment", startTime=_number(about.start), stopTime=_number(about.stop),
        tolerance=_number(about.accuracy),
    )  # fmt: skip
    if version == 2:
        annotated = ET.SubElement(ET.SubElement(root, "VendorAnnotations"), "Tool", name="fairlead")
        ET.SubElement(annotated, "netlist", digest=about.digest)
    _variables(root, variables, {one.name: one for one in tuned}, version)
    _structure(root, variables, version)
    if version == 3:
        annotated = ET.SubElement(ET.SubElement(root, "Annotations"), "Annotation", type="fairlead")
        ET.SubElement(annotated, "netlist", digest=about.digest)
    ET.indent(root)
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="utf-8") + b"\n"


def _head(about: About, version: int) -> dict[str, str]:
    return {
        "fmiVersion": f"{version}.0", "modelName": _clean(about.name),
        "instantiationToken" if version == 3 else "guid": about.token,
        "description": _clean(about.description), "version": about.digest[:12], "license": about.licence,
        "generationTool": f"fairlead {about.version}", "variableNamingConvention": "flat",
    }  # fmt: skip


def _units(root: ET.Element, variables: Sequence[Variable]) -> None:
    found = ET.SubElement(root, "UnitDefinitions")
    for unit in sorted({"s", *(one.unit for one in variables if one.unit != "1")}):
        made = ET.SubElement(found, "Unit", name=unit)
        exponents = {base: Fraction(power) for base, power in zip(BASES, parse_unit(unit).dimension, strict=True)}
        exponents.pop(BASES[ENERGY])  # J is kg*m^2/s^2 besides
        if all(power.denominator == 1 for power in exponents.values()):
            ET.SubElement(made, "BaseUnit", {base: str(power) for base, power in exponents.items() if power})


def _variables(root: ET.Element, variables: Sequence[Variable], tuned: Mapping[str, Tuned], version: int) -> None:
    found, names = ET.SubElement(root, "ModelVariables"), {one.name for one in variables}
    time = next(name for name in TIME if name not in names)
    _variable(found, {"name": time, "valueReference": "0", "causality": "independent", "variability": "continuous",
                      "description": "Time."}, {"unit": "s"}, version)  # fmt: skip
    for k, one in enumerate(variables, start=1):
        said = {"name": _clean(one.name), "valueReference": str(k), "causality": one.causality,
                "variability": "continuous", "description": _clean(one.description or one.of)}  # fmt: skip
        kind = {"nominal": _number(one.nominal)} | ({"unit": one.unit} if one.unit != "1" else {})
        if one.causality == "input":
            kind["start"] = _number(one.start or 0.0)
        elif one.causality == "parameter":
            own = tuned[one.name]
            said |= {"variability": "fixed" if own.when == BEFORE else "tunable", "initial": "exact"}
            kind |= {"min": _number(own.low), "max": _number(own.high), "start": _number(own.value)}
        else:
            said["initial"] = "calculated"
        _variable(found, said, kind, version)


def _variable(found: ET.Element, said: dict[str, str], kind: dict[str, str], version: int) -> None:
    if version == 3:
        ET.SubElement(found, "Float64", said | kind)
    else:
        ET.SubElement(ET.SubElement(found, "ScalarVariable", said), "Real", kind)


def _structure(root: ET.Element, variables: Sequence[Variable], version: int) -> None:
    made = ET.SubElement(root, "ModelStructure")
    if version == 3:
        for name in ("Output", "InitialUnknown"):
            for k in _outputs(variables):
                ET.SubElement(made, name, valueReference=str(k))
    else:
        for name in ("Outputs", "InitialUnknowns"):
            listed = ET.SubElement(made, name)
            for k in _outputs(variables):
                ET.SubElement(listed, "Unknown", index=str(k + 1))


def _outputs(variables: Sequence[Variable]) -> Iterator[int]:
    return (k for k, one in enumerate(variables, start=1) if one.causality == "output")


def _number(value: float) -> str:
    """The shortest text that is this number."""
    return repr(float(value))


def _clean(text: str) -> str:
    """A text without what XML cannot hold."""
    return NOT_IN_XML.sub(" ", text)
