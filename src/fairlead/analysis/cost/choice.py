"""What to choose: the fastest line of a study that is exact enough, the front of lines that nothing beats, its knee.

A line is exact enough for a target when neither its numerical nor its modelling error is above it, and the floor of
the study is below it. Elements are not chosen: a discretisation error above the target is said beside the choice.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fairlead.analysis.cost.study import Row, Study

TARGETS = (0.05, 0.01, 0.001)
FASTER = 0.9  # of the time: a line that is only a little faster does not win over one that is more exact
UNFELT = 1e-3  # s: nor one that is faster by no more than this, which is what such short times scatter by


@dataclass(frozen=True)
class Choice:
    """What a study advises for one target; `row` is None when no line is exact enough."""

    target: float
    row: Row | None
    sentence: str

    @property
    def settings(self) -> Mapping[str, str]:
        """What to set, as `--set` would be given it; empty without a line."""
        return self.row.rung.settings if self.row is not None else {}


def error(study: Study, row: Row) -> float | None:
    """The larger of the numerical and the modelling error; None unless both were measured."""
    parts = [study.size(row.numerical), study.size(row.modelling)]
    return None if None in parts else max(part for part in parts if part is not None)


def known_to_be_below(study: Study, row: Row) -> float:
    """What both errors of a line are known not to be above: themselves, or the floor of its equations."""
    return max(study.told(errors, row)[0] or 0.0 for errors in (row.numerical, row.modelling))


def choose(study: Study, target: float) -> Choice:
    """The fastest line that meets the target, and a sentence."""
    rows = [row for row in study.rows if row.timed.finished and row.rung.equations.axis != "mesh"]
    found = {id(row): size for row in rows if (size := error(study, row)) is not None}
    known = [row for row in rows if id(row) in found]
    good = sorted((row for row in known if known_to_be_below(study, row) <= target), key=lambda row: row.timed.cpu)
    head = f"{100 * target:g} %: "
    if study.floor > target:
        how = "statistics of tight runs scatter by" if study.sensitive else "the references agree to"
        agree = f"{how} {percent(study.floor)}"
        what = "there are no two references" if math.isinf(study.floor) else agree
        return Choice(target, None, f"{head}cannot be told, {what}.")
    if good:
        longest = max(good[0].timed.cpu / FASTER, good[0].timed.cpu + UNFELT)
        near = [row for row in good if row.timed.cpu <= longest]
        row = min(near, key=lambda row: found[id(row)])
        return Choice(target, row, head + _sentence(study, row, target) + _enough(study, found, good, row))
    if known:
        best = min(known, key=lambda row: found[id(row)])
        return Choice(target, None, f"{head}no line reaches it; the nearest is {_sentence(study, best, target)}")
    return Choice(target, None, f"{head}nothing was measured in full.")


def _enough(study: Study, found: Mapping[int, float], good: Sequence[Row], row: Row) -> str:
    """What looser row would do, none being faster by enough to win: the loosest of the same kind, or the fastest."""
    looser = [one for one in good if one.rung.accuracy > row.rung.accuracy]
    if not looser:
        return ""
    alike = [one for one in looser if (one.rung.engine, one.rung.equations) == (row.rung.engine, row.rung.equations)]
    one = max(alike, key=lambda each: each.rung.accuracy) if alike else looser[0]
    size, floor = found[id(one)], study.floor_of(one.rung.equations)
    error = f"below {percent(floor)}" if 0 < size <= floor else percent(size)
    said = f" The looser {one.rung.label} would do too ({error}, {seconds(one.timed.cpu)}), but"
    return f"{said} saves too little time to matter." if one.timed.cpu < row.timed.cpu else f"{said} is not faster."


def front(study: Study) -> list[tuple[float, float, Row]]:
    """Time [s], error and line of those that no other beats in both, from fast to exact."""
    points = sorted(
        (row.timed.cpu, max(size, 1e-12), number)
        for number, row in enumerate(study.rows)
        if row.timed.finished and (size := error(study, row)) is not None and row.rung.equations.axis != "mesh"
    )
    kept: list[tuple[float, float, Row]] = []
    for seconds, size, number in points:
        if not kept or size < kept[-1][1]:
            kept.append((seconds, size, study.rows[number]))
    return kept


def knee(points: Sequence[tuple[float, float, Row]]) -> Row | None:
    """The line of a front farthest below the straight line between its ends, on logarithmic scales."""
    if len(points) < 3:
        return None
    x = [math.log(seconds) for seconds, _, _ in points]
    y = [math.log(size) for _, size, _ in points]
    width, height = x[-1] - x[0], y[0] - y[-1]
    if width <= 0 or height <= 0:
        return None
    below = [(y[0] - y[k]) / height - (x[k] - x[0]) / width for k in range(len(points))]
    place = max(range(len(points)), key=below.__getitem__)
    return points[place][2] if below[place] > 0 else None


def _sentence(study: Study, row: Row, target: float) -> str:
    numerical, below = study.told(row.numerical, row)
    text = f"{row.rung.label}: {'below ' if below else ''}{percent(numerical)} numerical error"
    if study.size(row.modelling):
        modelling, below = study.told(row.modelling, row)
        text += f", {'below ' if below else ''}{percent(modelling)} modelling error"
    text += f", in {seconds(row.timed.cpu)}."
    elements, below = study.told(row.discretisation, row)
    if elements is not None and elements > target and not below:
        text += f" The elements alone have an error of {percent(elements)}: use smaller ones."
    return text


def percent(value: float | None) -> str:
    """A relative error with two digits."""
    if value is None:
        return "-"
    return "0 %" if value == 0 else f"{100 * value:.2g} %" if value < 1 else f"{100 * value:.0f} %"


def seconds(value: float) -> str:
    """A time with two digits."""
    return f"{1e3 * value:.2g} ms" if value < 0.0995 else f"{value:.2g} s" if value < 9.95 else f"{value:.0f} s"
