"""The first zone change in which two runs differ, in words.

Contacts that switch at one time may do so in either order, so zone changes are compared component by component. Of all
components whose zone changes differ, the one is told that differs first.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from fairlead.results.events import Event


def parting(one: Sequence[Event], other: Sequence[Event], names: tuple[str, str]) -> str:
    """A sentence about the first zone change in which the runs called `names` differ; "" where none differs."""
    found = _parted(one, other)
    if found is None:
        return ""
    component, count, first, second = found
    sides = [f"at {name} {_told(event)}" for name, event in zip(names, (first, second), strict=True)]
    return f"{component}, zone change {count}: {sides[0]}, {sides[1]}"


def _parted(one: Sequence[Event], other: Sequence[Event]) -> tuple[str, int, Event | None, Event | None] | None:
    found = []
    mine, others = _by_component(one), _by_component(other)
    for component in {**mine, **others}:
        pairs = itertools.zip_longest(mine.get(component, ()), others.get(component, ()))
        for count, (first, second) in enumerate(pairs, 1):
            if first is None or second is None or first[1:4] != second[1:4]:
                time = min(event.t for event in (first, second) if event is not None)
                found.append((time, component, count, first, second))
                break
    return min(found, key=lambda each: each[0])[1:] if found else None


def _by_component(events: Sequence[Event]) -> dict[str, list[Event]]:
    found: dict[str, list[Event]] = {}
    for event in events:
        found.setdefault(event.component, []).append(event)
    return found


def _told(event: Event | None) -> str:
    return "there is none" if event is None else f"{event.zone_from} to {event.zone_to} at {event.t:.6g} s"
