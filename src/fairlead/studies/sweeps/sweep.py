"""A sweep: cases of a design that the table does not have yet are computed, and added as they come."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol

from fairlead.cases.cases import PLACE as OF_CASE
from fairlead.cases.row import FINISHED, Row, Value
from fairlead.errors import Location, ModelError, shown
from fairlead.studies.sweeps.design import Design, kind_of
from fairlead.studies.sweeps.farm import Case, Farm, Here
from fairlead.studies.sweeps.job import Job
from fairlead.studies.sweeps.table import Heading, SweepTable, texts_among

PLACE = Location("sweep")


class Computers(Protocol):
    """Whoever computes cases: `Farm`, `Here` or `Cluster`."""

    def rows(self, cases: Iterator[Case]) -> Iterator[tuple[int, Row]]:
        """Rows as they come."""


@dataclass
class Standing:
    """How far a sweep is, for whoever watches."""

    total: int
    reused: int = 0
    twice: int = 0
    """Of the reused: those that are another case of the design once more."""
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


def sweep(job: Job, design: Design, folder: Path, *,
          computers: Callable[[Job], AbstractContextManager[Computers]] | None = None,
          processes: int | None = None, force: bool = False, watch: Watch | None = None,
          ) -> tuple[SweepTable, Standing]:  # fmt: skip
    """Compute what is missing, by `computers` (a context), else by processes of this machine, one for each core.

    With `processes=0` this process computes, which a debugger needs; a case that kills it ends all.

    Raises ModelError before anything runs for a name, a word or a dimension that the model does not take, and if none
    of a few cases from all over the design is possible; a number beyond its range costs its row. Raises UsageError for
    a folder with another sweep. After KeyboardInterrupt, or a disk that is full, the table has all rows it could write.
    Rows of an earlier design stay in it, with no number; `frame` of the table has those of the design.
    """
    design.refuse()
    _refuse_what_no_case_can_have(job, design)
    table = SweepTable(folder, heading_of(job, design), force=force)
    known, standing = table.keys(), Standing(design.count)
    if known:
        of_design = ((number, job.key(values)) for number, values in enumerate(design.cases()))
        there = [(number, key) for number, key in of_design if key in known]
        table.number(there)
        standing.reused = len(there)
    twins: list[tuple[int, str]] = []
    cases = _missing(job, design, known, twins, standing)
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


def _refuse_what_no_case_can_have(job: Job, design: Design) -> None:
    """Raise ModelError where all tries are refused, or a kind of value beside those of a case that is not."""
    sound, refused = None, list[ModelError]()
    for case in design.tries():
        try:
            job.check(case)
        except ModelError as error:
            refused.append(_of_case(error, case))
        else:
            sound = case
            break
    if sound is None:
        raise refused[0]
    if design.listed:
        return  # their values come together, so that no other case is made of them
    for name, kinds in design.kinds().items():
        for kind, value in kinds.items():
            if kind != kind_of(sound[name]):
                case = {**sound, name: value}
                try:
                    job.check(case)
                except ModelError as error:
                    raise _of_case(error, case) from None


def _of_case(error: ModelError, case: Mapping[str, Value]) -> ModelError:
    """The mistakes of a case, told as those of the sweep, with the values of the case."""
    values = ", ".join(f"{name} = {shown(value)}" for name, value in case.items())
    faults = [replace(one, where=PLACE) if one.where == OF_CASE else one for one in error.faults]
    *others, last = faults
    if values in f"{last.what} {last.way_out}":  # it says so itself
        return ModelError(faults)
    way_out = "\n".join(filter(None, [last.way_out, f"This is in the case {values}."]))
    return ModelError([*others, replace(last, way_out=way_out)])


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
    about = {name: job.about[name] for name in design.names if name in job.about}
    return Heading(job.name, job.scene, design.count, tuple(design.names), texts_among(seen), job.units, told, about)


def _missing(job: Job, design: Design, known: set[str], twins: list[tuple[int, str]],
             standing: Standing) -> Iterator[tuple[int, Mapping[str, Value]]]:  # fmt: skip
    """Cases that no row is there for. One that stands twice in the design is computed once."""
    given: set[str] = set()
    for number, values in enumerate(design.cases()):
        key = job.key(values)
        if key in given:
            standing.reused += 1
            standing.twice += 1
            twins.append((number, key))
        elif key not in known:
            given.add(key)
            yield number, values
