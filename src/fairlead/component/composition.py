"""What an Expansion must be for its composite to be placed: children that there are, joined at ports that they have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.base import Composite, Expansion
from fairlead.component.declaration import Declaration
from fairlead.component.replies import EXPANSION, AnswerError, is_bundled, place_of
from fairlead.component.values import Values
from fairlead.errors import Fault, did_you_mean, listing, shown
from fairlead.renamed import word_of_today


def expanded(values: Values, scene: Any) -> Expansion:
    """What a composite is made of. Raises AnswerError when a user's class says what cannot be placed."""
    kind = values.type
    expand = kind.answers.expand
    assert expand is not None  # of every Composite, see base.py
    said: Expansion = expand(values, scene)
    if not is_bundled(kind) and (what := next(_wrong(said, kind.declaration), "")):
        raise AnswerError([Fault(None, f"{place_of(expand)}: {kind.__name__}.expand(p, scene) {what}", EXPANSION)])
    return said


def _wrong(said: Any, has: Declaration) -> Iterator[str]:
    if not isinstance(said, Expansion):
        yield f"gives {shown(said) if said is None or isinstance(said, str) else type(said).__name__}."
        return
    if not isinstance(said.children, Mapping) or not isinstance(said.ports, Mapping):
        yield "gives an Expansion whose children or ports are no map."
        return
    for name, child in said.children.items():
        if not isinstance(name, str) or not isinstance(child, Values):
            yield f"gives the child {name!r} as {type(child).__name__}; children are what scene.make(Type, ...) gives."
            return
    yield from _wrong_joins(said)
    yield from _wrong_ends(said.ports, {n: p for n, p in has.ports.items() if p.domain.across}, "port", said)
    yield from _wrong_ends(said.outputs, has.outputs, "output", said, whole=False)


def _wrong_joins(said: Expansion) -> Iterator[str]:
    if isinstance(said.connections, str) or not hasattr(said.connections, "__iter__"):
        yield f"gives the connections {said.connections!r}; they are a list of tuples of texts."
        return
    for ends in said.connections:
        if isinstance(ends, str) or not isinstance(ends, tuple | list) or len(ends) < 2:
            yield f"gives the connection {ends!r}; it is a tuple of two or more ends, such as ('one.b', 'two.a')."
            return
        for end in ends:
            yield from _wrong_end(end, said)


def _wrong_ends(
    given: Mapping[str, Any], declared: Mapping[str, Any], word: str, said: Expansion, *, whole: bool = True
) -> Iterator[str]:
    """Outer names: those that the class declares, each with an inner one. Others may be handed out too."""
    missing = [name for name in declared if name not in given]
    if whole and missing:
        yield f"leaves out the {word} {listing(missing)}."
    for name, end in given.items():
        if not isinstance(name, str):
            yield f"names a {word} {name!r}, which is no text."
        yield from _wrong_end(end, said)


def _wrong_end(end: Any, said: Expansion) -> Iterator[str]:
    """An end such as `link[0].b`: the child, and one of what it has to be joined."""
    if not isinstance(end, str) or "." not in end:
        yield f"names the end {end!r}; an end is a child and its port, such as 'link[0].b'."
        return
    inner, _, port = end.rpartition(".")
    child = said.children.get(inner)
    if child is None:
        if not any(inner.startswith(f"{name}.") for name in said.children):  # of a child of a child
            near = did_you_mean(inner, said.children) or f"Its children are {listing(said.children)}."
            yield f"joins {end}, and there is no child {inner!r}. {near}".rstrip()
        return
    if issubclass(child.type, Composite):
        return
    of = child.type.declaration
    known = {**of.ports, **of.inputs, **of.outputs}
    if port not in known and not word_of_today(port, known):
        yield f"joins {end}, and {child.type.__name__} has {listing(known)}. {did_you_mean(port, known)}".rstrip()
