"""What a sweep computes: a model's cases, or a Python function that goes the same way."""

from __future__ import annotations

import hashlib
import platform
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from fairlead.cases.identity import key_of
from fairlead.cases.row import ERROR, FINISHED, Row, Value


class Job(Protocol):
    """Cases by their values; it is pickled to other processes."""

    @property
    def name(self) -> str:
        """What is swept."""

    @property
    def scene(self) -> str:
        """A digest of all that the cases share."""

    @property
    def units(self) -> Mapping[str, str]:
        """Unit of each figure by its name."""

    @property
    def limited(self) -> bool:
        """Whether there are limits that a case may break."""

    def key(self, values: Mapping[str, Value]) -> str:
        """What a case is known by."""

    def check(self, values: Mapping[str, Value]) -> None:
        """Raise FairleadError for values that no case can have."""

    def row(self, values: Mapping[str, Value]) -> Row:
        """Compute a case; never raises for what happens in it."""


@dataclass(frozen=True)
class FunctionJob:
    """Cases of a function: values by name in, figures by name out. Texts that are numbers come as numbers."""

    name: str
    function: Callable[[Mapping[str, Value]], Mapping[str, float]]
    units: Mapping[str, str]

    @property
    def limited(self) -> bool:
        """A function has no limits."""
        return False

    @property
    def scene(self) -> str:
        """By the name alone: a function has no text that could be hashed in every case."""
        return hashlib.sha256(f"function {self.name}".encode()).hexdigest()

    def key(self, values: Mapping[str, Value]) -> str:
        """What a case is known by."""
        return key_of(self.scene, values)

    def check(self, values: Mapping[str, Value]) -> None:
        """A function takes what it is given."""

    def row(self, values: Mapping[str, Value]) -> Row:
        """Call the function."""
        begun, start = time.perf_counter(), Row(self.key(values), dict(values), ERROR, host=platform.node())
        try:
            found = dict(self.function({name: _number(value) for name, value in values.items()}))
        except Exception as error:  # noqa: BLE001 - whatever it is, it costs one row
            return Row(start.key, start.values, ERROR, f"{type(error).__name__}: {error}", host=start.host)
        seconds = time.perf_counter() - begun
        return Row(start.key, start.values, FINISHED, figures=found, seconds=seconds, host=start.host)


def _number(value: Value) -> Value:
    try:
        return float(value)
    except ValueError:
        return value
