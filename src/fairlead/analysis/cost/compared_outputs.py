"""Which recorded outputs a study compares: those asked for, and of a long family only some."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairlead.component.declare import CREEP, SHARE
from fairlead.errors import UsageError, did_you_mean, listing
from fairlead.results.signal import family, matching

MOST_MEMBERS = 16  # of a family of signals that are compared


def outputs(model: Any, patterns: Sequence[str]) -> tuple[list[str], list[str], list[str]]:
    """The outputs to compare with their units, and all that the scene records. Raises UsageError for a bad pattern."""
    found = recorded(model)
    chosen: dict[str, None] = {}
    for pattern in patterns:
        meant = matching(found, pattern)
        if not meant:
            near = did_you_mean(pattern, found) or f"Recorded are {listing(found)}."
            raise UsageError(f"--output {pattern}: the netlist records no such signal. {near}")
        chosen |= dict.fromkeys(meant)
    names = thinned(list(chosen))
    units = {signal.name: signal.unit for signal in model.system.signals}
    return names, [units[name] for name in names], found


def recorded(model: Any) -> list[str]:
    """What the netlist records, without the creep, which is an error measure itself."""
    return [signal.name for signal in _chosen(model) if signal.role != CREEP]


def without_shares(model: Any, names: list[str]) -> list[str]:
    """The names but those of what one element of a line takes in; all of them where there is nothing else.

    It depends on how finely the line is cut; and where contacts hold, no law says how they share a load.
    """
    shares = {signal.name for signal in model.system.signals if signal.role == SHARE}
    return [name for name in names if name not in shares or family(name)[1] is None] or names


def recorded_of_meshes(model: Any) -> list[str]:
    """Of that what means the same on another mesh: of a family of elements nothing that belongs to their length."""
    return [
        one.name for one in _chosen(model) if one.role != CREEP and (one.role != SHARE or family(one.name)[1] is None)
    ]


def _chosen(model: Any) -> Any:
    return model.system.recording(model.netlist.record.signals).chosen


def thinned(names: list[str]) -> list[str]:
    """The names, but of a family only some, equally far apart, the first and the last among them."""
    members: dict[str, list[str]] = {}
    for name in names:
        members.setdefault(family(name)[0], []).append(name)
    kept: set[str] = set()
    for group in members.values():
        places = np.unique(np.linspace(0, len(group) - 1, min(len(group), MOST_MEMBERS)).round().astype(int))
        kept |= {group[place] for place in places}
    return [name for name in names if name in kept]
