"""How a scene is told to treat friction otherwise: the settings that reach every contact, wherever it is written.

    treatment(model, "hold")            {"friction.method": "hold", "pad.method": "hold"}

A contact takes its treatment from the scene's `friction` block unless it, or the component that makes it, says one
itself; so both are set.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fairlead.component.base import Family
from fairlead.component.registry import known_types

EXACT = "hold"
"""The treatment in which a stuck contact does not move; what modelling errors are measured against."""


def contacts(model: Any) -> list[Any]:
    """Instances that are members of a family chosen by `method`."""
    return [one for one in model.flat.instances if _is_contact(one.type)]


def treatment_of(model: Any) -> str:
    """The treatment of most contacts; "" in a scene without any."""
    words = [one.type.word for one in contacts(model)]
    return max(words, key=words.count, default="")


def creep_of(model: Any) -> float | None:
    """The smallest creep [m/s] that a contact is given; None when none has such a setting."""
    creeping = [one for one in contacts(model) if one.type.answers.creeps]
    return min((one.values.path(one.type.answers.sticks_below) for one in creeping), default=None)


def treatment(model: Any, word: str) -> dict[str, str]:
    """Settings that give every contact this treatment, and take away what one says that has no place in it."""
    members = {name: kind for one in contacts(model) for name, kind in _head(one.type).members.items()}
    if word not in members:
        return {"friction.method": word}
    own = [path for path, value in _settings(model, "method") if value in members]
    foreign = {name for kind in members.values() for name in kind.declaration.parameters}
    foreign -= set(members[word].declaration.parameters)
    heads = [path.rpartition(".")[0] for path in own]
    lost = [path for name in sorted(foreign) for path, _ in _settings(model, name) if path.rpartition(".")[0] in heads]
    return {"friction.method": word, **dict.fromkeys(own, word), **dict.fromkeys(lost, "null")}


def creep(model: Any, value: float) -> dict[str, str]:
    """Settings that give every contact this creep [m/s]."""
    own = (path for path, _ in _settings(model, "creep"))
    return {"friction.creep": f"{value:.6g}", **dict.fromkeys(own, f"{value:.6g}")}


def _head(kind: type[Any]) -> type[Any]:
    return next(one for one in kind.__mro__ if "members" in one.__dict__)


def _settings(model: Any, key: str) -> Iterator[tuple[str, Any]]:
    """Where contacts, and what hands it on to contacts, set `key` themselves: paths for an override, and to what."""
    types = known_types(getattr(model, "libraries", ()))
    for name, entry in model.netlist.components.items():
        kind, value = types[entry.type], entry.parameters.get(key)
        if value is None or value.content is None or isinstance(value.content, dict | list):
            continue
        if _is_contact(kind) or key in kind.answers.hands_on:
            yield f"{name}.{key}", value.content


def _is_contact(kind: type[Any]) -> bool:
    return issubclass(kind, Family) and kind.key == "method"
