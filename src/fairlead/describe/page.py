"""`fairlead describe TYPE`: everything a user may ask about a component type, as text.

    describe("Tether", types)       ports, parameters, zones, transitions, equations
    describe("types", types)        all types, by family (catalogue.py, which also has the short page of a type)

The equations are those that are traced and compiled, so this page cannot go stale.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator, Mapping
from typing import cast

from fairlead.component.base import Declared, Family
from fairlead.component.called_elsewhere import similar_type
from fairlead.component.scene import is_head
from fairlead.describe.behaviour import behaviour, functions
from fairlead.describe.catalogue import catalogue
from fairlead.describe.columns import heading, paragraph
from fairlead.describe.interface import beyond, derived_rows, interface, parameter_rows, shared
from fairlead.describe.specimen import families_of
from fairlead.errors import UsageError

ALL_TYPES = "types"


def describe(name: str, types: Mapping[str, type[Declared]]) -> str:
    """All about a type or, by its class name, a kind of a family; or all `types`. Raises UsageError."""
    if name == ALL_TYPES:
        return "\n".join(catalogue(types))
    kind = named(name, types)
    return "\n".join(_type(name, kind) if name in types else _kind(cast(type[Family], kind)))


def named(name: str, types: Mapping[str, type[Declared]]) -> type[Declared]:
    """The type of a name, or the kind of a family whose class has it. Raises UsageError."""
    kinds = _kinds(types.values())
    if name in types or name in kinds:
        return types[name] if name in types else kinds[name]
    near = " " + similar_type(name, {**types, **kinds})
    lists = f"`fairlead describe {ALL_TYPES}` lists them."
    raise UsageError(f"There is no component type {name}.{near.rstrip()}\n    {lists}")


def _kinds(types: Iterable[type[Declared]]) -> dict[str, type[Family]]:
    """Members of all families in reach, by class name."""
    found: dict[str, type[Family]] = {}
    for kind in types:
        heads = [kind] if is_head(kind) else []
        for family in [*heads, *families_of(kind)]:
            found |= {member.__name__: member for member in family.members.values()}
    return found


def _type(name: str, kind: type[Declared]) -> Iterator[str]:
    yield name
    yield from paragraph(inspect.getdoc(kind))
    if is_head(kind):
        yield from _variants(kind)
    else:
        yield from interface(kind.declaration)
        yield from _does(kind)
    for family in families_of(kind):
        yield from _family(family)


def _kind(kind: type[Family]) -> Iterator[str]:
    yield f"{kind.__name__}    {kind.key}: {kind.word}"
    yield from paragraph(inspect.getdoc(kind))
    yield from interface(kind.declaration)
    yield from behaviour(kind) if kind.declaration.laws else ("", *functions(kind))
    for family in families_of(kind):
        yield from _family(family)


def _does(kind: type[Declared]) -> Iterator[str]:
    """Equations of a leaf; what a composite becomes depends on its numbers."""
    if kind.declaration.laws:
        yield from behaviour(kind)
    else:
        yield from heading("Made of other components: `fairlead describe MODEL --stage component` lists them.")


def _variants(head: type[Family]) -> Iterator[str]:
    """What all kinds of a component share, then each of them."""
    members = head.members
    base = shared(member.declaration for member in members.values())
    yield from heading(f"{head.key}: one of {', '.join(members)}, each described below")
    yield from interface(base)
    for word, member in members.items():
        yield from ("", f"{head.key}: {word}{_taken(head, word)}", *paragraph(inspect.getdoc(member)))
        yield from interface(beyond(member.declaration, base))
        yield from behaviour(member)


def _family(family: type[Family]) -> Iterator[str]:
    """The kinds that a part may be of."""
    yield from ("", f"{family.__name__}", *paragraph(inspect.getdoc(family)))
    for word, member in family.members.items():
        yield from (
            "",
            f"  {family.key}: {word}{_taken(family, word)}",
            *paragraph(inspect.getdoc(member), 4),
        )
        for rows in (
            parameter_rows(member.declaration.parameters, 4),
            derived_rows(member.declaration, 4),
            functions(member, 4),
        ):
            yield from ("", *rows) if rows else ()


def _taken(family: type[Family], word: str) -> str:
    return "    (taken when the netlist names none)" if word == family.default_word else ""
