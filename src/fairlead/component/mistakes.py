"""What pydantic finds wrong with a component's parameters, said in words at the place in the netlist.

models/belt.yaml:9:12: spring.stifness: Spring has no parameter stifness. Did you mean stiffness?
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from fairlead.component.base import Component, Declared, Family
from fairlead.component.given import REQUIRED, Block, Choice, Parameter, Part, Stations, Table, Waveform
from fairlead.component.tables import TableError
from fairlead.errors import Fault, did_you_mean, listing, shown
from fairlead.netlist.netlist import Value
from fairlead.quantities import QuantityError, wanted

LIMITS = {"gt": "above", "ge": "at least", "lt": "below", "le": "at most"}


@dataclass(frozen=True)
class Spot:
    """Where one mistake lies: in the netlist, and among the declarations."""

    node: Value  # what stands there, or the map in which something is missing
    path: str  # of the parameter, from the component's name on
    declared: Any  # its declaration; None when there is none
    owner: str  # what it is a parameter of, in words
    siblings: Mapping[str, Any]  # the parameters beside it
    member: Any = None  # the class they are parameters of, if it is one


def explain(kind: type[Declared], details: list[Any], tree: Value, path: str) -> list[Fault]:
    """All mistakes of one instance; a parameter missing because its name is misspelt is one mistake."""
    misspelt = set()
    for detail in details:
        if detail["type"] == "extra_forbidden":
            spot = _spot(kind, detail["loc"], tree, path, detail["type"])
            misspelt.add((*detail["loc"][:-1], _meant(str(detail["loc"][-1]), spot.siblings)))
    kept = [detail for detail in details if detail["type"] != "missing" or tuple(detail["loc"]) not in misspelt]
    return [_fault(detail, _spot(kind, detail["loc"], tree, path, detail["type"])) for detail in kept]


def owner_name(kind: type[Declared]) -> str:
    """A class as the user wrote it: `Spring`, or for a member of a family `Contact (method: hold)`."""
    head = next((base for base in kind.__mro__ if "members" in base.__dict__), None)
    if head is None or not issubclass(kind, Family):
        return kind.__name__
    whole = issubclass(kind, Component)
    return f"{head.__name__} ({kind.key}: {kind.word})" if whole else f"{kind.key} {kind.word}"


def elsewhere(kind: Any, name: str) -> list[str]:
    """Words of the family, those offered first, whose members have a parameter that `kind` itself has not.

    Only of a family that takes a word when none is written: there a user may not know which one it is.
    """
    if kind is None or not issubclass(kind, Family) or not kind.default_word or name in kind.declaration.parameters:
        return []
    words = [word for word, member in kind.members.items() if name in member.declaration.parameters]
    return sorted(words, key=lambda word: (word not in kind.offered, word))


def _choosing(kind: Any) -> list[str]:
    """The key whose word chooses the member of a family, such as `method`."""
    return [kind.key] if kind is not None and issubclass(kind, Family) and kind.key else []


def _meant(name: str, allowed: Mapping[str, Any]) -> str:
    return did_you_mean(name, allowed).removeprefix("Did you mean ").removesuffix("?")


def _spot(kind: type[Declared], loc: tuple[Any, ...], tree: Value, path: str, what: str) -> Spot:
    """Follow a pydantic location through the netlist and the declarations at once."""
    node, names, owner = tree, path, owner_name(kind)
    siblings: Mapping[str, Any] = kind.declaration.parameters
    declared: Any = None
    family: Any = None
    member: Any = kind
    for number, step in enumerate(loc):
        if family is not None and step in family.members:  # the tag of a union, not a key of the netlist
            member, family = family.members[step], None
            owner, siblings = owner_name(member), member.declaration.parameters
            continue
        last = number == len(loc) - 1
        inner = _inside(node, step)
        if inner is None and not (last and what in ("missing", "extra_forbidden")):
            continue  # a step that pydantic adds, such as the kind of a union
        node = inner or node
        names += f"[{step}]" if isinstance(step, int) else f".{step}"
        if isinstance(step, str):
            declared = siblings.get(step)
            if isinstance(declared, Block) and not last:
                owner, siblings, member = f"{step} of {owner}", declared.parameters, None
        family = declared.family if isinstance(declared, Part | Stations) else None
        if family is not None and len(family.members) == 1 and not last:
            owner, siblings, member = *_only(family), None
    return Spot(node, names, declared, owner, siblings, member)


def _only(family: Any) -> tuple[str, Mapping[str, Any]]:
    member = next(iter(family.members.values()))
    return owner_name(member), member.declaration.parameters


def _inside(node: Value, step: str | int) -> Value | None:
    """The entry of a map or of a list, if it has it."""
    if isinstance(node.content, dict):
        return node.content.get(str(step))
    if isinstance(node.content, list) and isinstance(step, int) and step < len(node.content):
        return node.content[step]
    return None


def _fault(detail: Any, spot: Spot) -> Fault:
    """One mistake in words."""
    name, context, node = str(detail["loc"][-1]), detail.get("ctx", {}), spot.node
    said = f"{spot.path} = {shown(node.plain())}"
    if detail["type"] == "extra_forbidden" and (others := elsewhere(spot.member, name)):
        key = spot.member.key
        what = f"{spot.path}: {spot.owner} has no parameter {name}; it belongs to {key} {listing(others)}."
        return Fault(node.named_at, what, f"Write {key}: {others[0]}, or leave {name} out.")
    if detail["type"] == "extra_forbidden":
        known = [*_choosing(spot.member), *spot.siblings]
        what = f"{spot.path}: {spot.owner} has no parameter {name}. {did_you_mean(name, known)}"
        return Fault(node.named_at, what.rstrip(), f"It has {listing(known)}." if known else "")
    if detail["type"] == "missing":
        return Fault(node.where, f"{spot.path} is missing; {spot.owner} needs it.", _needed(spot.declared))
    if "error" in context:
        return _told(context["error"], spot)
    for key, words in LIMITS.items():
        if key in context:
            unit = getattr(spot.declared, "unit", "1")
            allowed = f"Allowed: {words} {context[key]:g}{'' if unit == '1' else ' ' + unit}."
            return Fault(node.where, f"{said} is out of range.", allowed)
    if isinstance(spot.declared, Choice):
        near = did_you_mean(str(node.plain()), spot.declared.options)
        return Fault(node.where, f"{said} is not known. {near}".rstrip(), f"Allowed: {listing(spot.declared.options)}.")
    if detail["type"] == "literal_error" and spot.declared is None:  # the word of a family with one member
        expected = [word.strip("' ") for word in context["expected"].split(",")]
        what = f"{spot.path}: there is no {name} {shown(node.plain())}. {did_you_mean(str(node.plain()), expected)}"
        return Fault(node.where, what.rstrip(), f"There is {listing(expected)}.")
    if detail["type"].startswith("union_tag"):
        return _wrong_word(node, spot, context)
    if detail["type"] in ("model_type", "model_attributes_type"):
        if isinstance(spot.declared, Stations | Part):
            family = spot.declared.family
            words = listing(family.members)  # type: ignore[attr-defined]
            return Fault(node.where, f"{said} is not a map.", f"Write a map with {family.key}, one of {words}.")  # type: ignore[attr-defined]
        inner = spot.declared.parameters if isinstance(spot.declared, Block) else spot.siblings
        out = f", or leave {name} out" if node.content is None and all(map(_may_be_left_out, inner.values())) else ""
        return Fault(node.where, f"{said} is not a map.", f"Write it as {{{', '.join(inner)}}} with values{out}.")
    return Fault(node.where, f"{said}: {detail['msg'][0].lower()}{detail['msg'][1:]}.", _needed(spot.declared))


def _may_be_left_out(declared: Any) -> bool:
    return getattr(declared, "default", REQUIRED) is not REQUIRED


def _told(error: Exception, spot: Spot) -> Fault:
    """What one of our own readers said, at the place inside a table or a waveform it speaks of."""
    if isinstance(error, QuantityError):
        return Fault(spot.node.where, f"{spot.path} = {error.what}.", error.allowed)
    if not isinstance(error, TableError):
        return Fault(spot.node.where, f"{spot.path} = {shown(spot.node.plain())}: {error}")
    node, path = spot.node, spot.path
    for step in error.path:
        path += f"[{step}]" if isinstance(step, int) else f".{step}"
        node = _inside(node, step) or node
    place = node.named_at if error.of_name else node.where
    between = "" if error.what.startswith((" ", ":")) else ": "
    return Fault(place, f"{path}{between}{error.what}{'' if error.what.endswith('?') else '.'}", error.way_out)


def _wrong_word(node: Value, spot: Spot, context: Any) -> Fault:
    """The word that selects a member of a family is missing or unknown."""
    key = context["discriminator"].strip("'")
    if "tag" not in context:
        words = listing(spot.declared.family.members) if spot.declared is not None else ""
        return Fault(
            node.where, f"{spot.path} = {shown(node.plain())} needs the key {key}.", f"{key} is one of {words}."
        )
    chosen, expected = str(context["tag"]), [w.strip("' ") for w in context["expected_tags"].split(",")]
    place = node.entries[key].where if key in node.entries else node.where
    what = f"{spot.path}.{key}: there is no {key} {shown(chosen)}. {did_you_mean(chosen, expected)}"
    return Fault(place, what.rstrip(), f"There are {listing(expected)}.")


def _needed(declared: Any) -> str:
    """What to write for a parameter."""
    if isinstance(declared, Parameter):
        return f"{declared.doc} {wanted(declared.unit)}"
    if isinstance(declared, Choice):
        return f"{declared.doc} Write one of {listing(declared.options)}."
    if isinstance(declared, Part) and declared.family.bare:  # type: ignore[attr-defined]
        key, words = declared.family.key, listing(declared.family.members)  # type: ignore[attr-defined]
        return f"{declared.doc} Write a number, or a map whose {key} is one of {words}."
    if isinstance(declared, Waveform):
        return f"{declared.doc} {wanted(declared.unit)} Or a map such as ramp, step or table."
    if isinstance(declared, Table):
        return f"{declared.doc} Write a list of [x, y] pairs, or a map with file."
    return getattr(declared, "doc", "")
