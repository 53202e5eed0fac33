"""Values of an FMU of one type, which its functions get and set together, arrays as a whole.

A signal is [type, reference, number of elements, place, clocks]: the element at `place` of the variable behind
`reference`. Elements of an array that are no signals keep the values that they have.
"""

from __future__ import annotations

from typing import Any

Named = list[list[Any]]


class Calls:
    """The functions of an FMU of version 2 or 3 that get and set values."""

    def __init__(self, fmu: Any, version: int) -> None:
        """Of an FMU that is loaded."""
        self.fmu, self.version = fmu, version

    def set(self, kind: str, references: list[int], values: list[Any]) -> None:
        """Set variables of one type, with all elements of arrays."""
        getattr(self.fmu, f"set{self._named(kind)}")(references, values)

    def get(self, kind: str, references: list[int], count: int) -> list[Any]:
        """Variables of one type, `count` values in all."""
        call = getattr(self.fmu, f"get{self._named(kind)}")
        return list(call(references) if self.version == 2 else call(references, count))

    def _named(self, kind: str) -> str:
        """How the calls of the standard name a type."""
        return kind if kind != "Enumeration" else "Integer" if self.version == 2 else "Int64"

    def start(self, kind: str, reference: int, size: int, values: list[tuple[int, Any]]) -> None:
        """Set some elements of a variable; the others keep their values."""
        every: list[Any] = [None] * size if len(values) == size else self.get(kind, [reference], size)
        for place, value in values:
            every[place] = value
        self.set(kind, [reference], every)


class Group:
    """Variables of one type that depend on the same clocks (or on none)."""

    def __init__(self, kind: str, clocks: frozenset[int]) -> None:
        """Without variables yet."""
        self.kind, self.clocks = kind, clocks
        self.references: list[int] = []
        self.slots: list[tuple[int, int]] = []
        """Where a value stands among those of the variables, and where among the signals."""
        self.count = 0
        self.values: list[Any] | None = None
        """What was set last, of all elements."""
        self._begins: dict[int, int] = {}

    def add(self, signal: int, reference: int, size: int, place: int) -> None:
        """Take in a signal."""
        if reference not in self._begins:
            self._begins[reference] = self.count
            self.references.append(reference)
            self.count += size
        self.slots.append((self._begins[reference] + place, signal))

    def give(self, calls: Calls, signals: list[Any]) -> None:
        """Set them."""
        if self.values is None:
            self.values = [None] * self.count
            if len({at for at, _ in self.slots}) < self.count:
                self.values = calls.get(self.kind, self.references, self.count)
        for at, signal in self.slots:
            self.values[at] = signals[signal]
        calls.set(self.kind, self.references, self.values)

    def take(self, calls: Calls, signals: list[Any]) -> None:
        """Get them."""
        values = calls.get(self.kind, self.references, self.count)
        for at, signal in self.slots:
            signals[signal] = values[at]


def grouped(signals: Named) -> list[Group]:
    """The groups of signals; triggered clocks are in none."""
    groups: dict[tuple[str, frozenset[int]], Group] = {}
    for number, (kind, reference, size, place, clocks) in enumerate(signals):
        if kind != "Clock":
            key = kind, frozenset(clocks)
            groups.setdefault(key, Group(*key)).add(number, reference, size, place)
    return list(groups.values())
