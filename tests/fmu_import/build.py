"""FMUs of our own, from the C beside this file: compiled once per version of the standard, then packed by kind.

    make = maker(folder)
    file = make("decay", version=3, variables=[...])      folder/decay3.fmu

All kinds are in one library; the token of the description chooses.
"""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import zipfile
from collections.abc import Callable, Sequence
from typing import Any

HERE = pathlib.Path(__file__).parent
COMPILER = shutil.which("gcc") or shutil.which("cc") or shutil.which("clang")
NO_COMPILER = "there is no C compiler (gcc, cc or clang) to build FMUs with"
Variables = Sequence[dict[str, Any]]

DECAY: Variables = (
    {"name": "x", "ref": 0, "causality": "output", "variability": "continuous", "unit": "mm"},
    {"name": "rate", "ref": 1, "causality": "parameter", "variability": "fixed", "start": 1, "unit": "1/s"},
)
BALL: Variables = (
    {"name": "h", "ref": 0, "causality": "output", "variability": "continuous", "unit": "m"},
    {"name": "v", "ref": 1, "causality": "output", "variability": "continuous", "unit": "m/s"},
    {"name": "e", "ref": 2, "causality": "parameter", "variability": "fixed", "start": 0.5},
    {"name": "g", "ref": 3, "causality": "parameter", "variability": "fixed", "start": 10, "unit": "m/s2"},
    {"name": "bounces", "ref": 0, "causality": "output", "kind": "Int32"},
)
COUNTER: Variables = (
    {"name": "count", "ref": 0, "causality": "output", "kind": "Int32"},
    {"name": "odd", "ref": 0, "causality": "output", "kind": "Boolean"},
    {"name": "last.t", "ref": 0, "causality": "output", "unit": "s"},
    {"name": "last.step", "ref": 1, "causality": "output", "unit": "s"},
)
ARRAYS: Variables = (
    {"name": "n", "ref": 1, "causality": "structuralParameter", "kind": "UInt64", "variability": "fixed", "start": 2,
     "max": 4000},
    {"name": "m", "ref": 2, "causality": "structuralParameter", "kind": "UInt64", "variability": "fixed", "start": 3},
    {"name": "u", "ref": 10, "causality": "input", "start": "0 0", "dims": ("#1",)},
    {"name": "W", "ref": 11, "causality": "parameter", "variability": "fixed", "start": 1, "unit": "mm",
     "dims": ("#2", "#1")},
    {"name": "y", "ref": 12, "causality": "output", "unit": "mm", "dims": ("#2",)},
    {"name": "k", "ref": 13, "causality": "parameter", "variability": "fixed", "kind": "Int32", "start": "0 0",
     "dims": (2,)},
    {"name": "sum", "ref": 14, "causality": "output", "kind": "Int32"},
    {"name": "names", "ref": 15, "causality": "parameter", "variability": "fixed", "kind": "String", "start": "",
     "dims": (2,)},
    {"name": "length", "ref": 16, "causality": "output", "kind": "Int32"},
    {"name": "on", "ref": 17, "causality": "input", "kind": "Boolean", "start": "false true", "dims": (2,)},
    {"name": "set", "ref": 18, "causality": "output", "kind": "Int32"},
)
EVENTS: Variables = (
    {"name": "visits", "ref": 37, "causality": "output", "kind": "Int32"},
    {"name": "updates", "ref": 36, "causality": "output", "kind": "Int32"},
    {"name": "free", "ref": 38, "causality": "input", "start": 0},
)
RICH_BALL: Variables = (
    {"name": "h", "ref": 30, "causality": "output", "variability": "continuous", "unit": "m"},
    {"name": "e", "ref": 32, "causality": "parameter", "variability": "fixed", "start": 0.5},
    {"name": "bounces", "ref": 34, "causality": "output", "kind": "Int32"},
    *EVENTS,
)
STAIR: Variables = ({"name": "counter", "ref": 35, "causality": "output", "kind": "Int32"}, *EVENTS)
CLOCKS: Variables = (
    {"name": "r", "ref": 100, "causality": "input", "kind": "Clock", "intervalVariability": "constant",
     "intervalDecimal": 0.25, "shiftDecimal": 0.1},
    {"name": "q", "ref": 101, "causality": "input", "kind": "Clock", "declaredType": "half"},
    {"name": "p", "ref": 102, "causality": "input", "kind": "Clock", "intervalVariability": "fixed"},
    {"name": "g", "ref": 103, "causality": "input", "kind": "Clock", "intervalVariability": "changing"},
    {"name": "d", "ref": 104, "causality": "input", "kind": "Clock", "intervalVariability": "countdown"},
    {"name": "trigger", "ref": 105, "causality": "input", "kind": "Clock", "intervalVariability": "triggered"},
    {"name": "out", "ref": 106, "causality": "output", "kind": "Clock", "intervalVariability": "triggered"},
    {"name": "fourth", "ref": 107, "causality": "output", "kind": "Clock", "intervalVariability": "triggered",
     "clocks": "106"},
    {"name": "u", "ref": 50, "causality": "input", "variability": "discrete", "start": 0, "clocks": "100"},
    {"name": "total", "ref": 51, "causality": "output", "variability": "discrete", "clocks": "100"},
    {"name": "every", "ref": 70, "causality": "parameter", "variability": "fixed", "start": 0.3, "unit": "s"},
    *({"name": f"ticks.{name}", "ref": 60 + k, "causality": "output", "kind": "Int32"}
      for k, name in enumerate(("r", "q", "p", "g", "d", "trigger"))),
)
HALF = '<ClockType name="half" intervalVariability="fixed" intervalDecimal="0.5"/>'
RICH = {"matrix": ARRAYS, "ball": RICH_BALL, "stair": STAIR, "strict": STAIR, "clocked": CLOCKS}
EVENT_MODE = 'hasEventMode="true" canHandleVariableCommunicationStepSize="true"'
ONE: Variables = ({"name": "x", "ref": 0, "causality": "output"},)
KINDS = {"decay": DECAY, "ball": BALL, "counter": COUNTER}


def maker(folder: pathlib.Path) -> Callable[..., pathlib.Path]:
    """make(kind, version=3, variables=None, ...) -> the FMU; libraries are compiled when they are first wanted.

    With `rich=True` it is one of rich.h, in its file rich_KIND3.fmu.
    """
    built: dict[str, pathlib.Path] = {}

    def make(
        kind: str, version: int = 3, variables: Variables | None = None, *, rich: bool = False, **told: Any
    ) -> pathlib.Path:
        source = "rich3" if rich else f"fmi{version}"
        if source not in built:
            built[source] = compiled(folder, source)
        name = told.pop("name", f"rich_{kind}" if rich else kind)
        if rich:
            told = {"more": EVENT_MODE, "types": HALF if kind == "clocked" else ""} | told
        known = RICH if rich else KINDS
        text = description(kind, version, known.get(kind, ONE) if variables is None else variables, **told)
        return packed(folder / f"{name}{version}.fmu", version, text, built[source])

    return make


def compiled(folder: pathlib.Path, source: str) -> pathlib.Path:
    """The library with all kinds of model of a source."""
    import fmpy

    headers = pathlib.Path(fmpy.__file__).parent / "c-code"
    library = folder / f"{source.replace('fmi', 'own')}{fmpy.sharedLibraryExtension}"
    command = [str(COMPILER), "-shared", "-fPIC", "-w", "-O1", f"-I{headers}", "-o", str(library),
               str(HERE / f"{source}.c"), "-lm"]  # fmt: skip
    subprocess.run(command, check=True, timeout=600, start_new_session=True)
    return library


def packed(file: pathlib.Path, version: int, text: str, library: pathlib.Path, platform: str = "") -> pathlib.Path:
    """The archive; `platform` names another than that of this machine."""
    import fmpy

    here = platform or (fmpy.platform if version == 2 else fmpy.platform_tuple)
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("modelDescription.xml", text)
        archive.write(library, f"binaries/{here}/own{library.suffix}")
    return file


def description(
    kind: str, version: int, variables: Variables, *, state: bool = True, step: float | None = None,
    of: str = "CoSimulation", units: str = "", more: str = "", types: str = "",
) -> str:  # fmt: skip
    """modelDescription.xml of the standard's version."""
    word = "canGetAndSetFMUstate" if version == 2 else "canGetAndSetFMUState"
    token = f'guid="{kind}"' if version == 2 else f'instantiationToken="{kind}"'
    experiment = f'<DefaultExperiment stepSize="{step}"/>' if step else ""
    write = scalar2 if version == 2 else scalar3
    listed = "\n".join(write(number, one) for number, one in enumerate(variables))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="{version}.0" modelName="{kind}" {token}>
<{of} modelIdentifier="own" {word}="{str(state).lower()}" {more}/>
<UnitDefinitions>{units}</UnitDefinitions>
{f"<TypeDefinitions>{types}</TypeDefinitions>" if types else ""}
{experiment}
<ModelVariables>{listed}</ModelVariables>
<ModelStructure/>
</fmiModelDescription>"""


def attributes(one: dict[str, Any], *names: str) -> str:
    """Those that a variable has."""
    return " ".join(f'{name}="{one[name]}"' for name in names if name in one)


def scalar2(number: int, one: dict[str, Any]) -> str:
    """A variable of FMI 2, in which whole numbers are of one type."""
    kind = one.get("kind", "Real")
    kind = "Integer" if "Int" in kind else "Real" if "Float" in kind else kind
    outer = attributes(one, "name", "causality", "variability", "initial")
    return (f'<ScalarVariable valueReference="{one["ref"]}" {outer}><{kind} {attributes(one, "start", "unit")}/>'
            "</ScalarVariable>")  # fmt: skip


def scalar3(number: int, one: dict[str, Any]) -> str:
    """A variable of FMI 3."""
    kind = one.get("kind", "Float64")
    known = attributes(one, "name", "causality", "variability", "initial", "unit", "max", "clocks", "declaredType",
                       "intervalVariability", "intervalDecimal", "shiftDecimal", "intervalCounter", "shiftCounter",
                       "resolution", "supportsFraction")  # fmt: skip
    sizes = "".join(_dimension(one) for one in one.get("dims", ()))
    if kind in ("String", "Binary"):
        start = f'<Start value="{one["start"]}"/>' if "start" in one else ""
        return f'<{kind} valueReference="{one["ref"]}" {known}>{sizes}{start}</{kind}>'
    return f'<{kind} valueReference="{one["ref"]}" {known} {attributes(one, "start")}>{sizes}</{kind}>'


def _dimension(size: int | str) -> str:
    """A size, or with # the reference of the structural parameter that is it."""
    if isinstance(size, str):
        return f'<Dimension valueReference="{size[1:]}"/>'
    return f'<Dimension start="{size}"/>'
