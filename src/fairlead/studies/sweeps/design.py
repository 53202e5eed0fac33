"""A design: which cases there are, by number, without writing them all down.

A design is the product of a grid, a list of cases and a sample; what is absent counts as one. The last name of the grid
varies fastest, and the sample faster than the grid.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.cases.row import Value
from fairlead.errors import UsageError, listing
from fairlead.studies.sweeps.distributions import Distribution
from fairlead.studies.sweeps.sampling import points

MOST_CASES = 1_000_000
"""Cases of a sweep: a table of so many rows still fits into memory, and 10 ms each are three hours."""


@dataclass(frozen=True)
class Sample:
    """Points of distributions, by one of `sampling.KINDS`; `samples` of Morris are trajectories."""

    kind: str
    samples: int
    over: Mapping[str, Distribution]
    seed: int = 0
    correlations: Mapping[tuple[str, str], float] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """How many cases these are."""
        d = len(self.over)
        return self.samples * {"saltelli": d + 2, "morris": d + 1}.get(self.kind, 1)

    def columns(self) -> dict[str, list[str]]:
        """Values of each name."""
        shares = points(self.kind, self.samples, list(self.over), self.seed, self.correlations)
        return {name: law.texts(shares[:, k]) for k, (name, law) in enumerate(self.over.items())}


@dataclass(frozen=True)
class Design:
    """Cases by number."""

    grid: Mapping[str, Sequence[Value]] = field(default_factory=dict)
    listed: Sequence[Mapping[str, Value]] = ()
    sample: Sample | None = None

    @property
    def count(self) -> int:
        """How many cases."""
        listed = max(len(self.listed), 1)
        return math.prod(map(len, self.grid.values())) * listed * (self.sample.count if self.sample else 1)

    @property
    def names(self) -> list[str]:
        """Names of all parameters that vary, or are given."""
        listed = dict.fromkeys(name for one in self.listed for name in one)
        return list(dict.fromkeys([*self.grid, *listed, *(self.sample.over if self.sample else ())]))

    def refuse(self) -> None:
        """Raise UsageError for a design without cases, with too many, or with a name in two places."""
        if not (self.grid or self.listed or self.sample):
            raise UsageError("A sweep needs something to vary.\n    Give --grid mu=0.2:0.7:0.05, or a file of cases.")
        if empty := [name for name, values in self.grid.items() if not values]:
            raise UsageError(f"The grid has no value of {empty[0]}.\n    Give one at least.")
        if self.count > MOST_CASES:
            sizes = " x ".join(f"{len(values)} of {name}" for name, values in self.grid.items())
            said = f"{self.count:.3g} cases" + (f" ({sizes})" if len(self.grid) > 1 else "")
            way_out = "Take larger steps, fewer parameters, or a sample: --sobol 1024 --over mu='uniform(0.2, 0.7)'."
            raise UsageError(f"This is a sweep of {said}; at most {MOST_CASES} are taken.\n    {way_out}")
        listed = {name for one in self.listed for name in one}
        parts = [set(self.grid), listed, set(self.sample.over if self.sample else ())]
        twice = (parts[0] & parts[1]) | (parts[0] & parts[2]) | (parts[1] & parts[2])
        if twice:
            raise UsageError(f"{listing(sorted(twice))} is given in two ways at once, by grid, list or sample.")
        if self.sample and (strange := {n for pair in self.sample.correlations for n in pair} - set(self.sample.over)):
            raise UsageError(f"A correlation names {listing(sorted(strange))}, which has no distribution.")

    def cases(self) -> Iterator[dict[str, Value]]:
        """All cases in their order."""
        columns = self.sample.columns() if self.sample else {}
        samples = self.sample.count if self.sample else 1
        for number in range(self.count):
            rest, at = divmod(number, samples)
            of_sample = {name: texts[at] for name, texts in columns.items()}
            of_grid: dict[str, Value] = {}
            for name in reversed([*self.grid]):
                rest, k = divmod(rest, len(self.grid[name]))
                of_grid[name] = self.grid[name][k]
            listed = self.listed[rest] if self.listed else {}
            yield {**{name: of_grid[name] for name in self.grid}, **listed, **of_sample}

    def tries(self) -> Iterator[dict[str, Value]]:
        """A few cases from all over the design: in the middle, at both ends, and between."""
        named: dict[str, Sequence[Value]] = {name: _spread(values) for name, values in self.grid.items()}
        if self.sample:
            laws, columns = self.sample.over, self.sample.columns()
            named |= {name: _spread(_sorted(laws[name], texts)) for name, texts in columns.items()}
        listed = _spread(self.listed)
        for k in range(max(map(len, [*named.values(), listed]))):
            case = {name: values[min(k, len(values) - 1)] for name, values in named.items()}
            yield {**case, **(listed[min(k, len(listed) - 1)] if listed else {})}

    def kinds(self) -> dict[str, dict[str, Value]]:
        """Of each name of grid and sample one value of each kind: every word is one, and every dimension of numbers."""
        named: dict[str, Iterable[Value]] = dict(self.grid)
        if self.sample:  # all numbers of a law are of one kind
            named |= {name: law.words or law.texts(np.array([0.5])) for name, law in self.sample.over.items()}
        found: dict[str, dict[str, Value]] = {}
        for name, values in named.items():
            for value in values:
                found.setdefault(name, {}).setdefault(kind_of(value), value)
        return found


MOST_TRIES = 12


def kind_of(value: Value) -> str:
    """What sort of value it is: its unit in SI where it is a quantity, "number" without a unit, else the word."""
    from fairlead.quantities import NUMBER, QuantityError, quantity, unit_text

    if not isinstance(value, str):
        return str(value) if isinstance(value, bool) else "number"
    try:
        return unit_text(quantity(value).dimension) or "number"
    except QuantityError:
        return "number" if NUMBER.fullmatch(value) else value


def _sorted(law: Distribution, texts: Sequence[str]) -> list[str]:
    """Different values of a sample, numbers from the lowest to the highest."""
    return [*law.words] if law.words else sorted(dict.fromkeys(texts), key=lambda one: float(one.partition(" ")[0]))


def _spread(values: Sequence[Any]) -> list[Any]:
    """Some of the values, MOST_TRIES at most: that in the middle first, then both ends, then others."""
    count = len(values)
    if count <= MOST_TRIES:
        order = dict.fromkeys([count // 2, 0, count - 1, *range(count)]) if count else {}
    else:
        even = [round(k * (count - 1) / (MOST_TRIES - 2)) for k in range(MOST_TRIES - 1)]
        order = dict.fromkeys([count // 2, 0, count - 1, *even])
    return [values[at] for at in order]
