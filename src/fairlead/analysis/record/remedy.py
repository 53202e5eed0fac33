"""Component classes that say themselves how they fail: how long they may try, and what to use instead.

A class with `advice`, a sentence, has it printed when a run fails or a budget ends it; one with `budget`, such as
{"max_steps": 200_000}, has its runs ended there when the netlist sets no budget of its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

FEW = 3  # contacts named before "and n more"


def budget(types: Iterable[Any], name: str, given: int | None) -> int | None:
    """The budget of a run: what the netlist gives, or the least that a class in it asks for."""
    if given is not None:
        return given
    asked = [kind.answers.budget[name] for kind in set(types) if name in kind.answers.budget]
    return min(asked, default=None)


def remedies(instances: Iterable[Any]) -> str:
    """What the classes in a failed run advise, each with the components it is about; nothing where none does."""
    affected: dict[str, list[str]] = {}
    for instance in instances:
        advice = instance.type.answers.advice
        if advice:
            affected.setdefault(advice, []).append(instance.path)
    return " ".join(f"{_listed(paths)}: {advice}" for advice, paths in affected.items())


def _listed(paths: list[str]) -> str:
    more = f" and {len(paths) - FEW} more" if len(paths) > FEW else ""
    return ", ".join(paths[:FEW]) + more
