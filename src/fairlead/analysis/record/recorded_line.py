"""A line in the results of a run: tensions and places of all its elements, side by side."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.results import Result
from fairlead.results.damage import DamagedResultsError
from fairlead.results.store import SERIES_FILE

Floats = NDArray[np.float64]


def numbers(result: Result, names: Sequence[str]) -> Floats:
    """Several signals side by side, (rows, names). Raises DamagedResultsError where one is no number."""
    values = result.columns(names)
    if not np.isfinite(values).all():
        row, k = np.argwhere(~np.isfinite(values))[0]
        what = f"{names[k]} = {values[row, k]} at t = {result.t[row]:g} s, of which nothing can be told."
        raise DamagedResultsError(result.named(SERIES_FILE), what)
    return values


@dataclass(frozen=True)
class RecordedLine:
    """Arrays (rows, elements or nodes), read when first asked for; None for what was not recorded.

    `record` is what the run keeps of the line and its route (`route_record.py`).
    """

    result: Result
    record: dict[str, Any]

    def every(self, child: str, output: str, count: int) -> Floats | None:
        """One output of all elements or nodes, side by side; None unless all were recorded."""
        if count > len(self.result):
            return None
        names = [f"{self.record['line']}.{child}[{i}].{output}" for i in range(count)]
        return numbers(self.result, names) if all(name in self.result for name in names) else None

    @functools.cached_property
    def layers(self) -> list[Floats] | None:
        """Tensions of the layers, outer first."""
        found = [self.every(layer, "tension", self.record["nodes"] - 1) for layer in self.record["layers"]]
        return None if any(one is None for one in found) else found  # type: ignore[return-value]

    @functools.cached_property
    def nodes(self) -> Floats | None:
        """Where the nodes are on the route [m]."""
        return self.every(self.record["outer"], "x", self.record["nodes"])

    @functools.cached_property
    def places(self) -> Floats | None:
        """Where the middles of the elements are [m]."""
        return None if self.nodes is None else (self.nodes[:, 1:] + self.nodes[:, :-1]) / 2

    @functools.cached_property
    def total(self) -> Floats | None:
        """Tension of all layers together [N]."""
        return None if self.layers is None else np.sum(self.layers, axis=0)

    def some(self, child: str, output: str) -> tuple[list[str], Floats] | None:
        """One output of those nodes that have such a child: names, and values (rows, names); None if none has."""
        named = [(i, f"{self.name(child, i)}.{output}") for i in range(self.record["nodes"])]
        names = [name for _, name in named if name in self.result]
        return ([name.rpartition(".")[0] for name in names], numbers(self.result, names)) if names else None

    def of_nodes(self, child: str, output: str) -> Floats | None:
        """One output for every node, zero where a node has no such child."""
        some = self.some(child, output)
        if some is None:
            return None
        wide = np.zeros((len(self.result.t), self.record["nodes"]))
        wide[:, [int(name[name.rindex("[") + 1 : -1]) for name in some[0]]] = some[1]
        return wide

    def name(self, child: str, k: int) -> str:
        """Path of a child of the line."""
        return f"{self.record['line']}.{child}[{k}]"
