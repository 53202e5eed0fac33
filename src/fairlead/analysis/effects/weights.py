"""In which order switches are judged, when time is short: what is likely to matter most comes first.

    treatments of friction, then effects that are on, curves, words, parts, effects that are off

An effect weighs as many components as know it, with all that is inside them: friction of devices on a line of 160
nodes goes before the leak of one motor.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from fairlead.analysis.effects.switches import Switch

KINDS = ("treatment", "effect", "curve", "word", "part")


def by_weight(model: Any, found: Iterable[Switch]) -> list[Switch]:
    """The switches in that order."""
    paths = [one.path for one in model.flat.instances]

    def weight(one: Switch) -> tuple[int, int]:
        adds = one.kind == "effect" and one.then == "on"
        return len(KINDS) if adds else KINDS.index(one.kind), -_concerned(model, one, paths)

    return sorted(found, key=weight)


def _concerned(model: Any, one: Switch, paths: list[str]) -> int:
    """Components that know an effect, and what is inside them; all for one of the framework."""
    if one.kind != "effect":
        return 0
    knowing = tuple(path for path, words in model.assembly.effects.items() if one.name in words)
    inside = tuple(f"{path}." for path in knowing)
    return sum(path in knowing or path.startswith(inside) for path in paths) if knowing else len(paths)
