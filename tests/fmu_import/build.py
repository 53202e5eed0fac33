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
ONE: Variables = ({"name": "x", "ref": 0, "causality": "output"},)
KINDS = {"decay": DECAY, "ball": BALL, "counter": COUNTER}


def maker(folder: pathlib.Path) -> Callable[..., pathlib.Path]:
    """make(kind, version=3, variables=None, ...) -> the FMU; libraries are compiled when they are first wanted."""
    built: dict[int, pathlib.Path] = {}

    def make(kind: str, version: int = 3, variables: Variables | None = None, **told: Any) -> pathlib.Path:
        if version not in built:
            built[version] = compiled(folder, version)
        file = folder / f"{told.pop('name', kind)}{version}.fmu"
        text = description(kind, version, KINDS.get(kind, ONE) if variables is None else variables, **told)
        return packed(file, version, text, built[version])

    return make


def compiled(folder: pathlib.Path, version: int) -> pathlib.Path:
    """The library with all kinds of model."""
    import fmpy

    headers = pathlib.Path(fmpy.__file__).parent / "c-code"
    library = folder / f"own{version}{fmpy.sharedLibraryExtension}"
    command = [str(COMPILER), "-shared", "-fPIC", "-w", "-O1", f"-I{headers}", "-o", str(library),
               str(HERE / f"fmi{version}.c"), "-lm"]  # fmt: skip
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
    of: str = "CoSimulation", units: str = "", more: str = "",
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
    known = attributes(one, "name", "causality", "variability", "initial", "unit")
    if kind in ("String", "Binary"):
        return f'<{kind} valueReference="{one["ref"]}" {known}><Start value="{one.get("start", "")}"/></{kind}>'
    return f'<{kind} valueReference="{one["ref"]}" {known} {attributes(one, "start")}/>'
