"""pydantic's errors in the words of fairlead: place, path, offending value, what is allowed, a suggestion."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.netlist.hover import said_of
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Value
from fairlead.netlist.yaml12 import resolve
from fairlead.quantities import QuantityError

Path = tuple[int | str, ...]

BOUNDS = {"greater_than": ("not above", "gt"), "greater_than_equal": ("below", "ge"),
          "less_than": ("not below", "lt"), "less_than_equal": ("above", "le")}  # fmt: skip
WANTED = {
    "string_type": ("a text", "Put it in quotes to make it a text."),
    "bool_type": ("true or false", ""),
    "int_type": ("a whole number", ""),
    "int_from_float": ("a whole number", ""),
    "float_type": ("a number", ""),
    "list_type": ("a list", "Write it as [a, b]."),
    "dict_type": ("a map", "Write it as entries with a name, a colon and a value."),
    "model_type": ("a map", "Write it as entries with a name, a colon and a value."),
    "model_attributes_type": ("a map", "Write it as entries with a name, a colon and a value."),
}


def validate(model: type[BaseModel], tree: Value) -> tuple[Any, list[Fault]]:
    """The model filled from the tree, or None; and every mistake as a Fault at its place in the file."""
    try:
        return model.model_validate(tree.plain()), []
    except ValidationError as error:
        return None, _faults(error.errors(include_url=False), model, tree)


def _faults(errors: list[ErrorDetails], model: type[BaseModel], tree: Value) -> list[Fault]:
    """One Fault per mistake; a misspelt key is not reported a second time as a missing one."""
    strangers: dict[Path, list[str]] = {}
    for error in errors:
        if error["type"] == "extra_forbidden":
            strangers.setdefault(error["loc"][:-1], []).append(str(error["loc"][-1]))
    faults: dict[Fault, None] = {}
    for error in errors[:MOST_FAULTS]:
        *parent, last = error["loc"]
        misspelt = error["type"] == "missing" and did_you_mean(str(last), strangers.get(tuple(parent), ()))
        if not misspelt:
            faults[_fault(error, model, tree)] = None
    return list(faults)


def _fault(error: ErrorDetails, model: type[BaseModel], tree: Value) -> Fault:
    path, kind, context = error["loc"], error["type"], error.get("ctx", {})
    value, subject = _at(tree, path), _subject(path)
    given = _given(value)
    if kind == "missing":
        return _missing(path, model, value)
    if kind == "extra_forbidden":
        return _unknown_key(path, model, tree)
    if kind in BOUNDS:
        word, key = BOUNDS[kind]
        return Fault(value.where, f"{subject} = {given} is {word} {context[key]:g}", _hover(model, path))
    if kind == "literal_error":
        beside = _beside(model, path, value)
        return _choice(value, subject, given, context["expected"], beside)
    if kind == "value_error" and isinstance(reason := context.get("error"), QuantityError):
        joint = "." if isinstance(value.content, dict) else " = "  # a block as a whole names its own entries
        return Fault(_place_of_entry(value, reason.what), f"{subject}{joint}{reason.what}", reason.allowed)
    if kind in WANTED:
        words, advice = WANTED[kind]
        if len(path) == 2 and path[0] == "components":
            advice = f"Write {path[1]}: {{type: {given if isinstance(value.content, str) else 'NAME, ...'}}}."
        return Fault(value.where, f"{subject} = {given} is not {words}", advice or _hover(model, path))
    return _connection_or_name(error, value, subject, given, tree)


def _place_of_entry(block: Value, said: str) -> Location:
    """Where the entry of a block stands that a mistake in how its entries go together begins with.

    If another one it names was given elsewhere, as by `--set`, it is that one which does not go with the rest.
    """
    named = [block.entries[word].where for word in re.findall(r"\w+", said) if word in block.entries]
    elsewhere = [place for place in named if place.file != block.where.file]
    return (elsewhere or named or [block.where])[0]


def _connection_or_name(error: ErrorDetails, value: Value, subject: str, given: str, tree: Value) -> Fault:
    if error["loc"][-1] == "[key]":
        name = str(error["loc"][-2])
        better = re.sub(r"[^a-z0-9]+", "_", re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()).strip("_")
        advice = f"Write it as {better}." if better[:1].isalpha() else "It begins with a letter."
        what = f"{shown(name)} is not a component name; names are lower_snake"
        return Fault(value.named_at, what, advice)
    if error["type"] == "too_short":
        what = f"{subject} is {given}; at least {error['ctx']['min_length']} needed"
        joins = "A connection joins two or more ports: [spring.a, ground.flange]."
        return Fault(value.where, what, joins if error["loc"][0] == "connections" else "")
    if error["type"] in ("string_pattern_mismatch", "string_too_long") and error["loc"][0] == "name":
        return Fault(
            value.where, f"name: {given} is no name for a scene",
            "Results go to a folder of that name: up to 80 letters, digits, spaces and _ + - . in it.",
        )  # fmt: skip
    if error["type"] in ("string_pattern_mismatch", "string_too_long") and error["loc"][0] == "connections":
        said = "A port is written component.port, as in spring.a."
        ends = str(value.content).split()
        several = len(ends) > 1 and all("." in end for end in ends)
        apart = f"Put a comma between two ports: [{shown(', '.join(ends))}]."
        kind = _at(tree, ("components", str(value.content), "type")).content
        if value.content in _at(tree, ("components",)).entries and isinstance(kind, str):
            said = f"Write one of its ports, {given}.PORT: fairlead describe {shown(kind)} lists them."
            return Fault(value.where, f"{given} is a component, not a port", said)
        return Fault(value.where, f"{given} is not a port", apart if several else said)
    return Fault(value.where, f"{subject} = {given}: {error['msg']}")


def _missing(path: Path, model: type[BaseModel], value: Value) -> Fault:
    name = str(path[-1])
    near = did_you_mean(name, value.entries)
    advice = f"Is {near[13:-1]} a misspelling of it? " if near else ""
    what = f"{_subject(path)} is missing"
    return Fault(value.named_at if path[:-1] else value.where, what, advice + _hover(model, path))


def _unknown_key(path: Path, model: type[BaseModel], tree: Value) -> Fault:
    name = str(path[-1])
    known = _keys(_model_at(model, path[:-1]) or model)
    owner = _subject(path[:-1]) if path[:-1] else getattr(model, "called", "") or "a netlist"
    value = _at(tree, path)
    meant = getattr(model, "elsewhere", {}).get(name) if len(path) == 1 else None
    near = f"It is called {meant} here." if meant else did_you_mean(name, known)
    advice = f"{near} Known keys are {listing(known, 20)}.".strip()
    return Fault(value.named_at, f"{owner} has no key {shown(name)}", advice)


def _beside(model: type[BaseModel], path: Path, value: Value) -> str:
    """The setting of the same block of which this is a word; empty if there is none."""
    block = _model_at(model, path[:-1])
    for name, field in block.model_fields.items() if block is not None else ():
        if name != path[-1] and value.plain() in getattr(field.annotation, "__args__", ()):
            return _subject((*path[:-1], field.alias or name))
    return ""


def _choice(value: Value, subject: str, given: str, expected: str, beside: str) -> Fault:
    names = re.findall(r"'([^']*)'", expected)
    if not names:
        return Fault(value.where, f"{subject} = {given} is not {expected}", f"Write {subject}: {expected}.")
    near = f"It is a word of {beside}." if beside else did_you_mean(given, names)
    return Fault(value.where, f"{subject} = {given} is not known", f"{near} Allowed are {listing(names)}.".strip())


def _given(value: Value) -> str:
    """The value as written; a text that would be a number or the like without its quotes keeps them."""
    content = value.plain()
    quoted = isinstance(content, str) and len(content) < 20 and not isinstance(resolve(content), str)
    return repr(content) if quoted else shown(content)


def _at(tree: Value, path: Path) -> Value:
    """The value a path of pydantic's leads to, or the last one on the way that exists."""
    for step in path:
        if isinstance(tree.content, dict) and step in tree.content:
            tree = tree.content[str(step)]
        elif isinstance(tree.content, list) and isinstance(step, int) and step < len(tree.content):
            tree = tree.content[step]
        else:
            break
    return tree


def _subject(path: Path) -> str:
    """The path as a user writes it: components go by their own name, list items by their number."""
    steps = [step for step in path if step != "[key]"]
    if len(steps) > 1 and steps[0] == "components":
        steps = steps[1:]
    text = "".join(f"[{step}]" if isinstance(step, int) else f".{shown(step)}" for step in steps)
    return text.removeprefix(".")


def _keys(model: type[BaseModel]) -> list[str]:
    return [field.alias or name for name, field in model.model_fields.items()]


def _hover(model: type[BaseModel], path: Path) -> str:
    """The sentence that documents the field a path leads to."""
    owner = _model_at(model, path[:-1])
    fields = {field.alias or name: (name, field) for name, field in owner.model_fields.items()} if owner else {}
    if owner is None or path[-1] not in fields:
        return ""
    name, field = fields[str(path[-1])]
    return field.description or said_of(owner).get(name, "")


def _model_at(model: type[BaseModel], path: Path) -> type[BaseModel] | None:
    """The model of the block a path leads to."""
    for step in path:
        field = next((f for name, f in model.model_fields.items() if step in (name, f.alias)), None)
        inner = next(_models_in(field.annotation), None) if field else None
        if inner is None:
            return model if isinstance(step, int) or not field else None
        model = inner
    return model


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in getattr(annotation, "__args__", ()):
        yield from _models_in(part)
