"""A page for every component a netlist names, and for every treatment of friction, from their classes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from fairlead.component.registry import known_types
from fairlead.component.scene import is_head
from fairlead.describe.behaviour import behaviour
from fairlead.describe.catalogue import innards, record, sentence
from fairlead.describe.interface import about_waveforms, parameter_cells, shared
from generate.made_of import made_of
from generate.runs import picture, wiring
from generate.tables import fence, table
from generate.text import flowing
from generate.zone_diagram import zone_diagram

MOST_ZONES = 9  # in a diagram; of more, the list of transitions says it better


def pages(docs: Path, folder: Path) -> dict[str, str]:
    """components/index.md, and components/TYPE.md for every bundled type that is not an innard of others."""
    types = known_types()
    hidden = innards(types)
    shown = {n: k for n, k in sorted(types.items()) if n not in hidden and k.__module__.startswith("fairlead.")}
    examples = examples_of(shown)
    families: dict[str, list[str]] = {}
    for name, kind in shown.items():
        families.setdefault(record(name, kind)["family"].partition(".")[0], []).append(name)
    shown_in = {n: block for n in shown if n not in examples if (block := _block_of(docs, n))}
    methods = {kind: word for word, kind in types["Contact"].members.items()}  # type: ignore[attr-defined]
    found = {}
    for n, k in shown.items():
        lines = _page(n, k, examples.get(n), folder, shown, methods)
        found[f"components/{n}.md"] = "\n".join([*lines, *shown_in.get(n, [])])
    return {"components/index.md": "\n".join(_index(families, shown)), **found}


def examples_of(names: Iterable[str]) -> dict[str, Path]:
    """The shortest netlist of the small ones, else of the bundled models, in which a type occurs."""
    bundled = Path(str(__import__("fairlead.models").models.__file__)).parent
    small = sorted((bundled / "single_parts").glob("*.yaml"))
    files = [*small, *sorted(bundled.glob("*.yaml"))]
    texts = {file: _with_includes(file) for file in files}
    found = {}
    for name in names:
        has = [file for file, text in texts.items() if re.search(rf"\btype: {name}\b", text)]
        if has:
            found[name] = min(has, key=lambda file: (file.parent == bundled, len(texts[file]), file.name))
    return found


def _block_of(docs: Path, name: str) -> list[str]:
    """An example for a type that no netlist here can run: the first block of YAML on a page that has it."""
    for page in sorted(docs.glob("howto/*.md")):
        text = page.read_text(encoding="utf-8")
        for block in re.findall(r"^```yaml\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE):
            if re.search(rf"\btype: {name}\b", block):
                title = text.partition("\n")[0].removeprefix("# ")
                return ["## Example", "", f"From [{title}](../../howto/{page.name}):", "", *fence("yaml", block)]
    return []


def _with_includes(file: Path) -> str:
    text = file.read_text(encoding="utf-8")
    parts = re.findall(r"parts/\w+\.yaml", text)
    return text + "".join((file.parent / part).read_text(encoding="utf-8") for part in parts)


def _index(families: Mapping[str, list[str]], shown: Mapping[str, Any]) -> Iterator[str]:
    yield from ("# Components", "", "Every part a netlist can name, by family.",
                "Each page is written from the class of the part.", "",
                "Treatments of friction (`method`) have [a list](../../treatments/README.md) of their own.",
                "Devices of a route (bends, winches) are in [lines and routes](../../routes.md).", "")  # fmt: skip
    for family, names in sorted(families.items()):
        yield from (f"## {family}", "")
        yield from table(("type", "what it is"), ((f"[{n}]({n}.md)", sentence(shown[n])) for n in names))
    treatments = [f"../../treatments/{word}" for word in sorted(_methods(shown["Contact"]))]
    yield from (":::{toctree}", ":hidden:", "", *sorted(shown), *treatments, ":::", "")


def _methods(contact: Any) -> list[str]:
    """Bundled treatments, which have pages of their own."""
    return [word for word, member in contact.members.items() if member.__module__.startswith("fairlead.")]


def _page(
    name: str, kind: Any, example: Path | None, folder: Path, shown: Mapping[str, Any], methods: Mapping[Any, str]
) -> Iterator[str]:
    has = record(name, kind)
    yield from (f"# {name}", "", *flowing(has["doc"]))
    ports = table(("port", "domain", "what"), (
        (f"`{one['name']}`", one["domain"] + (", may be left open" if one["optional"] else ""), one["doc"])
        for one in has["ports"]))  # fmt: skip
    yield from _section("Ports", ports)
    if not (ports or has["inputs"] or has["outputs"]):
        yield from _section("Ports", ["It has none that are always there: what it is given decides them.", ""])
    declared = shared(member.declaration for member in kind.members.values()) if is_head(kind) else kind.declaration
    yield from _parameters(declared.parameters)
    yield from _section("Inputs", table(("input", "unit", "what", "when nothing is connected"), (
        (f"`{one['name']}`", one["unit"], one["doc"], _unconnected(one["default"]))
        for one in has["inputs"])))  # fmt: skip
    yield from _section("Outputs", table(("output", "unit", "what"), (
        (f"`{one['name']}`", one["unit"], one["doc"]) for one in has["outputs"])))  # fmt: skip
    yield from _kinds(has["families"])
    if is_head(kind) or kind.declaration.laws:
        yield from _law(name, kind, folder)
    else:
        yield from made_of(name, example, shown, methods, lambda part, law: _zones(part, law, folder))
    yield from _example(name, example, folder)


def _parameters(parameters: Mapping[str, Any]) -> Iterator[str]:
    rows = ((f"`{n}`", allowed, default.removeprefix("= "), said)
            for n, allowed, default, said in parameter_cells(parameters, nested="... "))  # fmt: skip
    yield from _section("Parameters", table(("parameter", "unit, range", "default", "what"), rows))
    yield from flowing(about_waveforms(parameters)) if about_waveforms(parameters) else ()


def _unconnected(default: Any) -> str:
    return "must be connected" if default is None else str(default)


def _section(title: str, lines: list[str]) -> list[str]:
    return [f"## {title}", "", *lines] if lines else []


def _kinds(families: Mapping[str, Mapping[str, Any]]) -> Iterator[str]:
    for key, members in families.items():
        rows = ((f"`{word}`", (one["doc"].partition("\n\n")[0]).replace("\n", " ")) for word, one in members.items())
        yield from _section(f"`{key}`: one of", table(("word", "what"), rows))


def _law(name: str, kind: Any, folder: Path) -> Iterator[str]:
    """Zones as a drawing and the equations as they are compiled; of a component with kinds, those of each kind."""
    if is_head(kind):
        yield from ("## Zones and equations", "")
        for word, member in kind.members.items():
            if member.__module__.startswith("fairlead."):
                yield from (f"### `{kind.key}: {word}`", "", *_zones(f"{name}_{word}", member, folder))
    elif kind.declaration.laws:
        yield from ("## Zones and equations", "", *_zones(name, kind, folder))


def _zones(name: str, kind: Any, folder: Path) -> Iterator[str]:
    declaration = kind.declaration
    ways = _ways(declaration)
    if 1 < len(declaration.zones) <= MOST_ZONES and ways:
        target = folder / "components" / f"{name}_zones.svg"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(zone_diagram(declaration.zones, ways, f"Zones of {name}"), encoding="utf-8")
        yield from (f"![Zones of {name} and the guards that lead from one to another]({name}_zones.svg)", "")
    yield from fence("text", "\n".join(behaviour(kind)).lstrip("\n"))


def _ways(declaration: Any) -> dict[tuple[str, str], str]:
    found: dict[tuple[str, str], list[str]] = {}
    for guard, mark in declaration.guards.items():
        for start in mark.zones or declaration.zones:
            if start != mark.to:
                found.setdefault((start, mark.to), []).append(guard)
    return {way: ", ".join(guards) for way, guards in found.items()}


def _example(name: str, example: Path | None, folder: Path) -> Iterator[str]:
    if example is None:
        return
    yield from ("## Example", "")
    own = example.parent.name == "single_parts"
    place = folder / "examples"
    place.mkdir(parents=True, exist_ok=True)
    if own:
        wiring(example, place)
        picture(example, place)
        yield from (f"`fairlead run single_parts/{example.stem}` runs this netlist:", "",
                    *fence("yaml", example.read_text(encoding="utf-8")),
                    f"![Wiring of {example.stem}](../examples/{example.stem}_wiring.svg)", "",
                    f"![Signals of {example.stem}](../examples/{example.stem}.png)", "")  # fmt: skip
    else:
        place_of = f"../gallery.md#{example.stem}"
        yield from (f"`{name}` is part of the bundled model [{example.stem}]({place_of}):", "",
                    *fence("sh", f"fairlead run {example.stem} --report"))  # fmt: skip
