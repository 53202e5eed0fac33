"""Zone changes of an engine with names, a row for each change that a part makes.

A part with several tables, such as a spring with its force and its energy over one stroke, goes on to the next piece of
each at one instant, and the guard of one may wake the other without a change. That is one row: of the first of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fairlead.results.events import PIECE

if TYPE_CHECKING:
    from fairlead.system.compiled.system import System

ZoneChange = tuple[float, str, str, str, str]
"""When [s], whose, zones before and after, guard."""


class ZoneChanges:
    """Takes the rows of an engine in order; `inside` counts the changes that have no row of their own."""

    def __init__(self, system: System) -> None:
        self.system, self.inside = system, 0
        self._names: dict[tuple[int, ...], tuple[str, str, str, str]] = {}
        self._last: dict[str, tuple[float, int]] = {}  # by part: when a table of it changed piece, and which

    def of(self, events: Any) -> Iterator[ZoneChange]:
        """The rows of one block, with names; those of a change are looked up once."""
        for t, machine, before, after, guard in (row[:5] for row in events.tolist()):
            change = (machine, before, after, guard)
            if change not in self._names:
                self._names[change] = names_of_change(self.system, *change)
            names = self._names[change]
            if not PIECE.fullmatch(names[1]) or self._is_first(t, machine, names[0], changes=before != after):
                yield t, *names

    def _is_first(self, t: float, machine: int, part: str, *, changes: bool) -> bool:
        """Whether a change of piece is that of the first table of a part at its instant."""
        if not changes:
            return False
        last = self._last.get(part)
        if last is not None and last[0] == t and last[1] != machine:
            self.inside += 1
            return False
        self._last[part] = (t, machine)
        return True


def names_of_change(system: System, machine: int, before: int, after: int, guard: int) -> tuple[str, str, str, str]:
    """Part, zones before and after, and guard of a change."""
    zones = system.zone_names(machine)
    return system.machine_names[machine], zones[before], zones[after], system.guard_name(guard, machine, before)
