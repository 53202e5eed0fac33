"""Who may import whom: the stages of the pipeline know what lies before them and nothing after.

The sources are read as text (ast), so imports inside functions count as well.
"""

import ast
import functools
import pathlib
from collections.abc import Iterator

import networkx
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# stage -> what it may import beside itself. `sealed` is the files of caches, `native` the cache of compiled code,
# `processor` what it is made for; `versions` which program that is;
# `testing` is the contract suite that ships with the package; the empty name is `fairlead/__init__.py` itself.
ALLOWED = {
    "errors": set(),
    "units": set(),
    "quantities": {"errors", "units"},
    "processor": {"errors"},
    "versions": set(),
    "sealed": set(),
    "native": {"errors", "processor", "sealed"},
    "renamed": set(),
    "patterns": {"renamed"},
    "netlist": {"brief", "errors", "quantities"},
    "component": {"brief", "errors", "quantities", "netlist", "renamed"},
    "foreign": {"errors", "quantities", "component"},
    "components": {"brief", "errors", "quantities", "component", "foreign"},
    "flatten": {"brief", "errors", "quantities", "netlist", "component", "components"},
    "kernels": {"brief", "component", "native", "sealed"},
    "system": {"brief", "errors", "quantities", "netlist", "component", "components", "flatten", "kernels", "native",
               "patterns", "distinct"},
    "describe": {"errors", "quantities", "component", "flatten", "kernels", "system"},
    "integrate": {"errors", "native", "processor", "sealed"},
    "results": {"arguments", "brief", "distinct", "errors", "quantities", "patterns", "renamed"},
    "analysis": {"arguments", "brief", "errors", "quantities", "netlist", "component", "flatten", "kernels", "native",
                 "system", "results", "patterns", "renamed", "sealed", "distinct"},
    "choice": set(),
    "brief": set(),
    "distinct": set(),
    "arguments": {"errors", "quantities"},
    "interruption": set(),
    "pacing": {"integrate"},
    "report": {"arguments", "errors", "quantities", "patterns", "results", "analysis", "flatten"},
}
# May import all that lies before:
LAST = {"", "model_page", "result", "engine", "watch", "running", "outside", "saved_state", "tuning", "outer",
        "renewal", "found", "model", "simulate", "statics", "studies", "cases", "testing", "fmu", "view", "cli",
        "__main__", "models"}  # fmt: skip


def source_files() -> dict[str, pathlib.Path]:
    """Dotted name -> file, of every module that is installed."""
    named = {}
    roots = {"src": "", "components": "fairlead.components.", "models": "fairlead.models."}
    for folder, prefix in roots.items():
        for file in sorted((ROOT / folder).rglob("*.py")):
            dotted = prefix + ".".join(file.relative_to(ROOT / folder).with_suffix("").parts)
            named[dotted.removesuffix("__init__").rstrip(".")] = file
    return named


def imports(name: str, file: pathlib.Path) -> Iterator[tuple[int, str]]:
    """Line and dotted target of every import in a file, relative ones resolved."""
    package = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"), filename=str(file))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = [*package[: len(package) - node.level + 1]] if node.level else []
            origin = ".".join(base + ([node.module] if node.module else []))
            yield from ((node.lineno, f"{origin}.{alias.name}") for alias in node.names)


@functools.cache
def import_edges() -> tuple[tuple[str, str, str], ...]:
    """(importer, imported, "file:line") for each import between our modules."""
    return tuple(_import_edges())


def _import_edges() -> Iterator[tuple[str, str, str]]:
    files = source_files()
    for name, file in files.items():
        for line, target in imports(name, file):
            module = target if target in files else target.rpartition(".")[0]
            if module in files and module != name:
                yield name, module, f"{file.relative_to(ROOT)}:{line}"


def stage(name: str) -> str:
    """The stage that a dotted name belongs to: its second part."""
    return name.partition(".")[2].partition(".")[0]


def test_every_stage_imports_only_what_lies_before_it() -> None:
    wrong = [
        f"{where}: {stage(importer)} imports {stage(imported)}"
        for importer, imported, where in import_edges()
        if stage(importer) not in LAST
        and stage(imported) != stage(importer)
        and stage(imported) not in ALLOWED[stage(importer)]
    ]
    assert not wrong, "\n".join(wrong)


ROOMS = ("memory", "linear", "point", "record", "events", "rodas", "stepping", "ida")
"""Rooms of the integrator; each imports only those before it. Files beside them are shapes, which know no room, the
loop with the trial of a method of one step, which know rooms up to events, or run.py and its helpers."""
OF_METHODS = {"rodas", "stepping", "ida"}
SHAPES = {"problem", "facts", "counters", "codes", "engine"}
LOOP = {"loop", "one_step"}


def room(name: str) -> str:
    """The room, or the file beside them, of a module of the integrator."""
    return [*name.split("."), "", "", ""][2]


def test_rooms_of_the_integrator_import_only_those_before_them() -> None:
    wrong = []
    for importer, imported, where in import_edges():
        if stage(importer) != "integrate" or stage(imported) != "integrate":
            continue
        one, other = room(importer), room(imported)
        if one in ROOMS and other in ROOMS:
            allowed = ROOMS.index(other) <= ROOMS.index(one)
        elif one in SHAPES:
            allowed = other in SHAPES
        elif one in LOOP:
            allowed = other in LOOP | SHAPES or (other in ROOMS and other not in OF_METHODS)
        else:
            allowed = one not in ROOMS or other in SHAPES or (one in OF_METHODS and other in LOOP | {"machine_code"})
        if not allowed:
            wrong.append(f"{where}: {one} imports {other}")
    assert not wrong, "\n".join(wrong)


def test_no_stage_of_the_pipeline_knows_a_study() -> None:
    """Models and runs are there without studies; those who call studies are the command line and the public names."""
    wrong = [
        where
        for importer, imported, where in import_edges()
        if stage(imported) in {"studies", "cases"} and stage(importer) not in {"", "studies", "cases", "cli"}
    ]
    assert not wrong, "\n".join(wrong)


ROOMS_OF = {
    "system": (
        "numbering", "arrays", "assembly", "callbacks", "compiled", "start", "active", "timed_limits", "compile",
        "refresh",
    ),
    "analysis": ("characteristic", "treatments", "record", "statics", "margins", "remarks", "cost", "effects"),
    "studies": ("differences", "sweeps", "pictures", "fits", "sensitivities", "modes"),
}
"""Stage -> its rooms and the files beside them; each imports only those before it."""


@pytest.mark.parametrize("name", sorted(ROOMS_OF))
def test_rooms_of_a_stage_import_only_those_before_them(name: str) -> None:
    rooms = ROOMS_OF[name]
    wrong = [
        f"{where}: {room(importer)} imports {room(imported)}"
        for importer, imported, where in import_edges()
        if stage(importer) == stage(imported) == name
        and room(importer) in rooms
        and room(imported) in rooms
        and rooms.index(room(imported)) > rooms.index(room(importer))
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", ["analysis", "system"])
def test_every_file_of_a_stage_lies_in_a_room_or_has_its_place(name: str) -> None:
    known = {*ROOMS_OF[name], ""}
    assert not {each for each in source_files() if stage(each) == name and room(each) not in known}


def test_only_the_command_line_is_built_on_the_command_line() -> None:
    wrong = [
        where
        for importer, imported, where in import_edges()
        if stage(imported) == "cli" and stage(importer) not in {"cli", "__main__"}
    ]
    assert not wrong


def test_no_modules_import_each_other_in_a_circle() -> None:
    graph = networkx.DiGraph((importer, imported) for importer, imported, _ in import_edges())
    circles = [sorted(group) for group in networkx.strongly_connected_components(graph) if len(group) > 1]
    assert not circles


def test_every_module_belongs_to_a_stage_of_the_architecture() -> None:
    strange = {name for name in source_files() if stage(name) not in ALLOWED.keys() | LAST}
    assert not strange, f"{strange}: give the new stage its place in ALLOWED"


@pytest.mark.parametrize("word", ["utils", "core", "helpers", "common"])
def test_no_module_is_a_drawer_for_the_rest(word: str) -> None:
    assert not [name for name in source_files() if word in name.split(".")]
