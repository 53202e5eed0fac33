"""A sweep: cases of a design that the table does not have yet are computed, and added as they come."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol

from fairlead.cases.cases import PLACE as OF_CASE
from fairlead.cases.row import FINISHED, Row, Value
from fairlead.errors import Location, ModelError
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.farm import Case, Farm, Here
from fairlead.studies.sweeps.job import Job
from fairlead.studies.sweeps.table import Heading, SweepTable, texts_among

PLACE = Location("sweep")


class Computers(Protocol):
    """Whoever computes cases: `Farm`, or `Cluster`."""

    def rows(self, cases: Iterator[Case]) -> Iterator[tuple[int, Row]]:
        """Rows as they come."""


@dataclass
class Standing:
    """How far a sweep is, for whoever watches."""

    total: int
    reused: int = 0
    done: int = 0
    failed: int = 0
    begun: float = field(default_factory=time.monotonic)

    @property
    def seconds(self) -> float:
        """Since the first case was handed out [s]."""
        return time.monotonic() - self.begun

    @property
    def rate(self) -> float:
        """Cases in a second."""
        return self.done / max(self.seconds, 1e-9)

    @property
    def left(self) -> float:
        """Seconds to go at this rate; infinite before the first case."""
        return (self.total - self.reused - self.done) / self.rate if self.done else float("inf")


Watch = Callable[[Standing], None]


def sweep(job: Job, design: Design, folder: Path, *, computers: Callable[[Job], Any] | None = None,
          processes: int | None = None, force: bool = False, watch: Watch | None = None,
          ) -> tuple[SweepTable, Standing]:  # fmt: skip
    """Compute what is missing, by `computers` (a context), else by processes of this machine, one for each core.

    With `processes=0` this process computes, which a debugger needs; a case that kills it ends all.

    Raises ModelError or UsageError before anything runs if a case at an end of the design is refused, UsageError for a
    folder with another sweep. After KeyboardInterrupt, or a disk that is full, the table has all rows it could write.
    """
    design.refuse()
    for case in design.corners():
        _check(job, case)
    table = SweepTable(folder, heading_of(job, design), force=force)
    known = {key for key, _ in table.rows_by_key()}
    numbers = {(key, number) for key, number in table.rows_by_key()}
    standing = Standing(design.count)
    twins: list[tuple[int, str]] = []
    cases = _missing(job, design, known, numbers, twins, standing)
    make = computers or (Here if processes == 0 else lambda one: Farm(one, processes or cores()))
    try:
        with make(job) as crew:
            standing.begun = time.monotonic()
            for number, row in crew.rows(cases):
                table.add(number, replace(row, key=job.key(row.values)))
                standing.done += 1
                standing.failed += row.status != FINISHED
                if watch is not None:
                    watch(standing)
        for number, key in twins:
            table.again(number, key)
    finally:
        table.write()
    return table, standing


def _check(job: Job, values: Mapping[str, Value]) -> None:
    """Raise ModelError for values of a case that the model has not; they are told as those of the sweep."""
    try:
        job.check(values)
    except ModelError as error:
        raise ModelError([replace(one, where=PLACE) if one.where == OF_CASE else one for one in error.faults]) from None


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def heading_of(job: Job, design: Design) -> Heading:
    """What the table says of itself."""
    seen: dict[str, list[Value]] = {name: [*values] for name, values in design.grid.items()}
    for case in design.listed:
        for name, value in case.items():
            seen.setdefault(name, []).append(value)
    if design.sample:
        words: Mapping[str, list[Value]] = {name: [*law.words[:1]] for name, law in design.sample.over.items()}
        seen |= words
    told: dict[str, Any] = {"grid": list(design.grid), "listed": len(design.listed), "limits": job.limited}
    if design.sample:
        one = design.sample
        laws = {name: f"{law.kind}{law.numbers or law.words}" for name, law in one.over.items()}
        told["sample"] = {
            "kind": one.kind,
            "samples": one.samples,
            "over": list(one.over),
            "seed": one.seed,
            "laws": laws,
        }
    return Heading(job.name, job.scene, design.count, tuple(design.names), texts_among(seen), job.units, told)


def _missing(job: Job, design: Design, known: set[str], numbers: set[tuple[str, int]], twins: list[tuple[int, str]],
             standing: Standing) -> Iterator[tuple[int, Mapping[str, Value]]]:  # fmt: skip
    """Cases that no row is there for. One that stands twice in the design is computed once."""
    for number, values in enumerate(design.cases()):
        key = job.key(values)
        if key not in known:
            known.add(key)
            yield number, values
        else:
            standing.reused += 1
            if (key, number) not in numbers:
                twins.append((number, key))
