"""How a scene is told to treat friction otherwise: the settings that reach every contact, wherever it is written.

    treatment(model, "hold")            {"friction.method": "hold", "pad.method": "hold"}

A contact takes its treatment from the scene's `friction` block unless it, or the component that makes it, says one
itself; so both are set. Which treatment is exact, which creeps and which never sticks, their classes say.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from fairlead.analysis.treatments.written import heads, types_of
from fairlead.component.base import Component, Declared, Family


@dataclass(frozen=True)
class Treatments:
    """The family of the contacts of a scene: the key that chooses a member, and words of members; "" for none."""

    members: dict[str, type[Family]]
    key: str
    exact: str
    """A stuck contact does not move; what modelling errors are measured against."""
    creeping: str
    """A stuck contact creeps; the first that the family offers."""
    never_sticking: str


def kinds_of_treatment(model: Any) -> Treatments:
    """Those of the contacts of a scene, or that there are where it has none."""
    families = [head_of(one.type) for one in contacts(model)] or heads(model)
    if not families:
        return Treatments({}, "", "", "", "")
    head = families[0]
    words = sorted(head.members, key=lambda word: word not in head.offered)  # stable: those offered first

    def first(answer: str) -> str:
        return next((word for word in words if getattr(head.members[word].answers, answer)), "")

    return Treatments(head.members, head.key, first("exact"), first("creeps"), first("never_sticks"))


def contacts(model: Any) -> list[Any]:
    """Instances that are members of a family of components, in which one word chooses the treatment."""
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
    members = {name: kind for one in contacts(model) for name, kind in head_of(one.type).members.items()}
    key = kinds_of_treatment(model).key
    if word not in members:
        return {f"friction.{key}": word}
    own = [path for path, value in _settings(model, key) if value in members]
    foreign = {name for kind in members.values() for name in kind.declaration.parameters}
    foreign -= set(members[word].declaration.parameters)
    owners = [path.rpartition(".")[0] for path in own]
    lost = [path for name in sorted(foreign) for path, _ in _settings(model, name) if path.rpartition(".")[0] in owners]
    return {f"friction.{key}": word, **dict.fromkeys(own, word), **dict.fromkeys(lost, "null")}


def creep(model: Any, value: float) -> dict[str, str]:
    """Settings that give every contact this creep [m/s]."""
    kinds = kinds_of_treatment(model)
    creeping = [one.type for one in contacts(model) if one.type.answers.creeps] or [kinds.members[kinds.creeping]]
    names = dict.fromkeys(kind.answers.sticks_below for kind in creeping)
    paths = [path for name in names for path in (f"friction.{name}", *(own for own, _ in _settings(model, name)))]
    return dict.fromkeys(paths, f"{value:.6g}")


def head_of(kind: type[Any]) -> type[Any]:
    """The class by whose key a member of its family is chosen."""
    return next(one for one in kind.__mro__ if "members" in one.__dict__)


def _settings(model: Any, key: str) -> Iterator[tuple[str, Any]]:
    """Where contacts, and what hands it on to contacts, set `key` themselves: paths for an override, and to what."""
    types = types_of(model)
    for name, entry in model.netlist.components.items():
        kind, value = types[entry.type], entry.parameters.get(key)
        if value is None or value.content is None or isinstance(value.content, dict | list):
            continue
        if _is_contact(kind) or key in kind.answers.hands_on:
            yield f"{name}.{key}", value.content


def _is_contact(kind: type[Declared]) -> bool:
    return issubclass(kind, Family) and issubclass(kind, Component)
