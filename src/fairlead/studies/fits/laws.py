"""Laws beside each other: each is fitted with every record left out in turn, and foretells that one.

Those with fewer parameters come first. The search of a law begins at their fits too, so that one that contains another
is not fitted worse than that; with a record left out, at fits that have not seen it either.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from fairlead.errors import FairleadError, UsageError
from fairlead.model import Model
from fairlead.studies.fits.fit_file import Asked, Law
from fairlead.studies.fits.nests import Contained, Floats, places
from fairlead.studies.fits.problem import Problem, Record, Target
from fairlead.studies.fits.search import Error, Fitted, Told, errors, fit, foretelling, prepared

SAME = 0.01
"""Share of its error by which a law is better at least, to be called better: two runs that no record tells apart differ
by less."""


@dataclass(frozen=True)
class Judged:
    """A law: by record, its errors when all records are fitted and when that one is left out, by signal."""

    law: Law
    trained: dict[str, dict[str, Error]] = field(default_factory=dict)
    left_out: dict[str, dict[str, Error]] = field(default_factory=dict)
    fitted: Fitted | None = None
    sentence: str = ""
    """Why it could not be judged; empty when it could."""


def compare(asked: Asked, laws: Sequence[Law], told: Told | None = None) -> list[Judged]:
    """Every law judged. Raises UsageError for a single record, ModelError for a law that the model has not."""
    if len(asked.given.records) < 2:
        raise UsageError("Laws are compared by leaving each record out in turn; give two records or more.")
    ready = [(law, *prepared(asked, law)[:2]) for law in laws]  # all mistakes come before anything is fitted
    made: dict[int, Judged] = {}
    fits: list[_Fits] = []
    for k in sorted(range(len(laws)), key=lambda k: len(laws[k].sought)):
        law, records, targets = ready[k]
        try:
            made[k], values = _judge(asked, law, records, targets, fits, told)
            fits.append(_Fits(law, records[0].cases.model, values))
        except FairleadError as error:
            made[k] = Judged(law, sentence=" ".join(str(error).split()))
    return [made[k] for k in range(len(laws))]


@dataclass(frozen=True)
class _Fits:
    """Values of a law fitted to all records, under no name, and without each record, under its name."""

    law: Law
    model: Model
    values: dict[str, dict[str, float]]

    def places(self, asked: Asked, law: Law, records: Sequence[Record], without: str) -> Iterator[tuple[str, Floats]]:
        """Where a law with more parameters may begin, for it to be this one."""
        if len(law.sought) > len(self.law.sought):
            problem = Problem((*asked.sought, *law.sought), ())
            like = Contained.of(self.model, self.values[without])
            yield from ((self.law.name, one) for one in places(problem, records[0].cases.model, like))


def _judge(asked: Asked, law: Law, records: list[Record], targets: list[Target], fits: Sequence[_Fits],
           told: Told | None) -> tuple[Judged, dict[str, dict[str, float]]]:  # fmt: skip
    """A law judged, and its fits. Raises FairleadError when no start gives a run that finishes."""

    def also(without: str = "") -> list[tuple[str, Floats]]:
        return [place for one in fits for place in one.places(asked, law, records, without)]

    whole = fit(asked, targets, law, also=also())
    if told is not None:
        told(f"{law.name}: loss {whole.loss:.6g} in {whole.runs} runs")
    judged, values, targets = Judged(law, fitted=whole), {"": whole.values}, [*whole.problem.targets]
    for k, record in enumerate(records):
        rest = foretelling(asked, [*targets[:k], *targets[k + 1 :]], law, whole, also(record.name))
        values[record.name] = rest
        judged.trained[record.name] = errors(record, whole.values) or {}
        judged.left_out[record.name] = errors(record, rest) or {}
        if told is not None:
            told(
                f"{law.name}: {record.name} {_sizes(judged.trained[record.name], record.units)}, "
                f"left out {_sizes(judged.left_out[record.name], record.units)}"
            )
    return judged, values


def _sizes(found: Mapping[str, Error], units: Mapping[str, str]) -> str:
    """Mean errors of a record's signals, as a line tells them."""
    return ", ".join(f"{error.mean:.4g} {units[name]}" for name, error in found.items()) or "did not finish"


def preferred(judged: Sequence[Judged]) -> str:
    """The law with the smallest left-out error, summed over records and signals as shares of the first law's."""
    scores = _scores(judged)
    return min(scores, key=lambda name: scores[name], default="")


def as_good(judged: Sequence[Judged]) -> list[str]:
    """The preferred law, and those that what was left out does not tell from it; none where no law foretells it all."""
    scores = _scores(judged)
    best = min(scores.values(), default=math.inf)
    return [name for name, score in scores.items() if score <= best * (1 + SAME)] if math.isfinite(best) else []


def better_everywhere(judged: Sequence[Judged]) -> list[str]:
    """Laws whose left-out error is below that of the first law, by more than `SAME`, on every record and signal."""
    first = judged[0]
    return [one.law.name for one in judged[1:] if not one.sentence and not first.sentence and all(
        one.left_out[record].get(signal, Error(float("inf"), 0)).mean < (1 - SAME) * error.mean
        for record, found in first.left_out.items() for signal, error in found.items())]  # fmt: skip


def _scores(judged: Sequence[Judged]) -> dict[str, float]:
    """By law, errors on what was left out, summed as shares of the first law that has one; infinite without."""
    able = [one for one in judged if not one.sentence]
    sizes: dict[tuple[str, str], float] = {}
    for one in able:
        for record, found in one.left_out.items():
            for signal, error in found.items():
                sizes.setdefault((record, signal), max(error.mean, 1e-300))

    def share(one: Judged, record: str, signal: str) -> float:
        error = one.left_out.get(record, {}).get(signal)
        return error.mean / sizes[record, signal] if error else math.inf

    return {one.law.name: sum(share(one, *place) for place in sizes) for one in able}
