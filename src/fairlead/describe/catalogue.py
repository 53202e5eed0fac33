"""Types at a glance: the list of all by family, what one needs to use a type, and the same as data.

    catalogue(types)            families with their types, a sentence each; innards apart
    short("Spring", types)      ports, parameters, inputs and outputs
    record("Spring", types)     the same for programs
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.base import Composite, Declared
from fairlead.component.given import REQUIRED, Block
from fairlead.component.scene import is_head
from fairlead.describe.columns import columns, heading, paragraph
from fairlead.describe.interface import connections, first_line, parameter_rows, shared
from fairlead.describe.specimen import families_of

BUNDLED = "fairlead.components."
INNARDS = frozenset((
    "ActiveForce", "BearingLoad", "BeltSpans", "CavitatingVolume", "ChainStrands", "Chamber", "Clamp",
    "ClampLoad", "Core", "CurrentLimit", "Dancer", "Drum", "ElementaryFunction", "ErrorSeen", "FarNode", "FastenedEnd",
    "Flank", "FlankLoad", "Frictionless", "Growing", "Hose", "Jaws", "LaidOn", "LateralLoad", "LeverArm", "LineWeight",
    "LoadLoss", "LoopedCore", "LoopedHose", "LumpedEnd", "Meter", "MotorFriction", "OilColumn", "PilotedRelief",
    "PlanarContact", "PressedLoad", "Pressing", "Registration", "RelaxingHose", "ReturnSpring", "RigidCore",
    "RoundLoad", "RuckingHose", "SeaDrag", "SealForce", "SpaceState", "Spiral", "SteadyRoll", "StoredNode",
    "TailEnd", "ThrottledCylinder", "ThrottledMotor", "Told", "ToothLoad", "ToothLoss", "Tow", "TransferStage",
    "TransferThrough", "Turning", "TwistElement", "Untouched", "WatchedHose", "WoundNode", "WoundWeb",
    "WrapGrip",
))  # fmt: skip
"""Bundled types that other types are made of, and that a netlist hardly names; limits of effects are so anyway."""


def catalogue(types: Mapping[str, type[Declared]]) -> Iterator[str]:
    """Families with their types and a sentence each; then, by name alone, what others are made of."""
    inside = innards(types)
    folders: dict[str, list[tuple[str, str]]] = {}
    for name, kind in sorted(types.items()):
        if name not in inside:
            folders.setdefault(_folder(kind), []).append((name, sentence(kind)))
    widest = max((len(name) for rows in folders.values() for name, _ in rows), default=0)
    for folder, rows in sorted(folders.items()):
        yield folder
        yield from columns((f"{name:<{widest}}", said) for name, said in rows)
        yield ""
    if inside:
        yield "innards: what these are made of, and what stands for them when an effect is off"
        yield from columns([("", ", ".join(sorted(inside)))])
        yield ""
    yield "`fairlead describe TYPE` tells how to use one of them, with --all its equations as well."
    yield "docs/howto/parts.md has them by what engineers call them: a freewheel is a OneWayClutch."


def innards(types: Mapping[str, type[Declared]]) -> set[str]:
    """Types that stand for others when an effect is off, and bundled ones that others are made of."""
    limits = {
        effect.off
        for kind in types.values()
        for one in (kind.members.values() if is_head(kind) else (kind,))
        for effect in one.declaration.effects.values()
    }
    return {name for name, kind in types.items() if kind in limits or (name in INNARDS and _is_bundled(kind))}


def sentence(kind: type[Declared]) -> str:
    """The first sentence of a class."""
    text = " ".join((inspect.getdoc(kind) or "").partition("\n\n")[0].split())
    found = re.match(r".*?\.(?=\s|$)", text)
    return (found[0] if found else text).rstrip(":")


def short(name: str, kind: type[Declared]) -> Iterator[str]:
    """What one needs to use a type."""
    yield f"{name}    {_folder(kind)}"
    yield from paragraph(inspect.getdoc(kind) if not is_head(kind) else first_line(kind))
    has = shared(member.declaration for member in kind.members.values()) if is_head(kind) else kind.declaration
    yield from connections(has)
    if has.parameters:
        yield from heading("parameters")
        yield from parameter_rows(has.parameters)
    for family in ([kind] if is_head(kind) else []) + families_of(kind):
        yield from heading(f"{family.key}: one of")
        yield from columns((word, sentence(member)) for word, member in family.members.items())
    yield from _zones(kind)
    made = issubclass(kind, Composite)
    yield ""
    yield f"--all adds {'what it hands on' if made else 'transitions and equations'}, --json the same as data."


def _zones(kind: type[Declared]) -> Iterator[str]:
    """The names that tables, events and figures give to what it does; of a family, the names of each member."""
    if is_head(kind):
        title = f"zones, by {kind.key}"
        rows = [(word, ", ".join(names)) for word, member in kind.members.items() if (names := zone_names(member))]
    else:
        title = "zones"
        rows = [(name, first_line(kind.declaration.laws[name])) for name in zone_names(kind)]
    if rows:
        yield from heading(title)
        yield from columns(rows)


def zone_names(kind: type[Declared]) -> list[str]:
    """The zones of a leaf; none where it has a single one, which nothing ever enters or leaves."""
    has = kind.declaration
    return list(has.zones or ()) if len(has.zones or ()) > 1 and has.laws else []


def record(name: str, kind: type[Declared]) -> dict[str, Any]:
    """A type as data: numbers in SI, None where nothing is said."""
    members = kind.members if is_head(kind) else {}
    has = shared(member.declaration for member in members.values()) if members else kind.declaration
    return {
        "type": name, "family": _folder(kind), "doc": inspect.getdoc(kind) or "",
        "ports": [{"name": n, "domain": p.domain.name, "doc": p.doc, "optional": p.optional}
                  for n, p in has.ports.items()],
        "parameters": [_parameter(n, p) for n, p in has.parameters.items()],
        "inputs": [{"name": n, "unit": i.unit, "doc": i.doc, "default": i.default} for n, i in has.inputs.items()],
        "outputs": [{"name": n, "unit": o.unit, "doc": o.doc} for n, o in has.outputs.items()],
        "zones": {word: zone_names(one) for word, one in members.items()} if members else zone_names(kind),
        "families": {
            family.key: {word: {"doc": inspect.getdoc(member) or "",
                                "parameters": [_parameter(n, p) for n, p in member.declaration.parameters.items()]}
                         for word, member in family.members.items()}
            for family in ([kind] if is_head(kind) else []) + families_of(kind)
        },
    }  # fmt: skip


def _parameter(name: str, declared: Any) -> dict[str, Any]:
    default = getattr(declared, "default", REQUIRED)
    plain = default if isinstance(default, str | int | float | bool) else None
    found: dict[str, Any] = {"name": name, "kind": type(declared).__name__, "doc": declared.doc,
                             "required": default is REQUIRED, "default": plain}  # fmt: skip
    for word in ("unit", "above", "least", "below", "most", "options", "x", "y"):
        if getattr(declared, word, None) is not None:
            found[word] = getattr(declared, word)
    if isinstance(declared, Block):
        found["parameters"] = [_parameter(n, inner) for n, inner in declared.parameters.items()]
    return found


def _folder(kind: type[Declared]) -> str:
    """The family of parts: the folder of the library, or the module of a user's."""
    return kind.__module__.removeprefix(BUNDLED).rpartition(".")[0] or kind.__module__


def _is_bundled(kind: type[Declared]) -> bool:
    return kind.__module__.startswith(BUNDLED)

