"""What a sweep computes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from fairlead.cases.row import Row, Value


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
    def about(self) -> Mapping[str, tuple[str, str]]:
        """Unit and description of the numbers that may be varied, by name; "" for what is not known."""

    @property
    def limited(self) -> bool:
        """Whether there are limits that a case may break."""

    def key(self, values: Mapping[str, Value]) -> str:
        """What a case is known by."""

    def check(self, values: Mapping[str, Value]) -> None:
        """Raise FairleadError for values that no case can have."""

    def row(self, values: Mapping[str, Value]) -> Row:
        """Compute a case; never raises for what happens in it."""
