"""Whether and how a line rucks, as lines of the verdict: when, where, how much, why, and whether that has settled."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fairlead.analysis.margins import ruck_places, settled
from fairlead.analysis.margins.ruck import BEYOND, verdicts
from fairlead.analysis.margins.ruck import sentence as of_ruck
from fairlead.analysis.margins.ruck_cause import why
from fairlead.analysis.margins.ruck_words import figure, moment
from fairlead.report.page.sentence import Sentence, ended

if TYPE_CHECKING:
    from fairlead.results import Event, Result


def rucking(result: Result) -> Iterator[Sentence]:
    """A line of the verdict for each line that is watched for rucking."""
    found = result.run.get("ruck")
    for one in verdicts(result) if found is None else found:
        if not one["rucks"]:
            yield Sentence("No ruck", "good", ended(of_ruck(one)), [*_unsettled(result, one), *why(one)])
            continue
        limit, most = figure(one["ruck_force"]), one.get("compressed")
        much = ""
        if most:
            much = (f" The greatest compression is {figure(most)} N, so the margin is {limit}/{figure(most)} = "
                    f"{one['margin']:.2g}.")  # fmt: skip
        yield Sentence("The hose rucks", "bad",
                       f"{one['line']}: an element rucks where it is compressed by more than {limit} N.{much}",
                       [*_points(result, one), *_unsettled(result, one), *why(one)])  # fmt: skip


def _points(result: Result, found: dict[str, Any]) -> list[tuple[str, str]]:
    """When, where and how much a line rucks, a sentence or two each."""
    places = ruck_places.sentences(found.get("places") or ())
    first = f"First in {_element(found, on=not places)}."
    return [
        ("When", f"First at t = {moment(found['t'])} s.{_lasting(result, found)}"),
        ("Where", f"{places} {first}".strip()),
        ("How much", f"{_extent(result, found)}{_most(result, found)}".strip()),
    ]


def _unsettled(result: Result, found: dict[str, Any]) -> list[tuple[str, str]]:
    """What still changes at constant speed, and what follows for the margin."""
    drift = (result.run.get("against_statics") or {}).get("drift")
    if not drift or drift["settled"] or drift["line"] != found["line"]:
        return []
    holds = "margin" if found.get("margin") else "verdict"
    then = (f"So the {holds} depends on how long that motion lasts: let it last longer (run.stop) before you take the "
            f"{holds} for that of a steady motion.")  # fmt: skip
    return [("Not settled", f"{settled.sentence(drift)} {then}")]


def _mine(result: Result, found: dict[str, Any]) -> list[Event]:
    """Every beginning of a ruck in a line."""
    return [one for one in result.events if one.component.startswith(f"{found['line']}.") and one.zone_to in BEYOND]


def _rucking(result: Result, found: dict[str, Any]) -> list[tuple[float, int]]:
    """After each change, when it was and how many elements ruck."""
    who, now, told = {one.component for one in _mine(result, found)}, set[str](), list[tuple[float, int]]()
    for one in result.events:
        if one.component in who:
            now = now | {one.component} if one.zone_to in BEYOND else now - {one.component}
            told.append((one.t, len(now)))
    return told


def _lasting(result: Result, found: dict[str, Any]) -> str:
    """The longest stretch in which some element rucks all the time; empty where nothing is known of it."""
    changes, end = _rucking(result, found), result.run.get("end_time")
    stretches, begin = list[tuple[float, float]](), None
    for t, count in dict(changes).items():  # of several at one instant the last counts
        if count and begin is None:
            begin = t
        elif not count and begin is not None:
            stretches.append((begin, t))
            begin = None
    if begin is not None and end is not None:
        stretches.append((begin, end))
    if not stretches:
        return ""
    longest = max(stretches, key=lambda one: one[1] - one[0])
    until = "the end of the run" if longest[1] == end else f"{moment(longest[1])} s"
    others = len(stretches) - 1
    shorter = f", and in {others} shorter span{'s' * (others > 1)}" if others else ""
    return f" From {moment(longest[0])} s to {until} some element rucks without a pause{shorter}."


def _most(result: Result, found: dict[str, Any]) -> str:
    """When and where the greatest compression was, and what statics said of it."""
    most = found.get("most")
    if most is None or not found["compressed"]:
        return ""
    return (f" The greatest compression is {figure(found['compressed'])} N at t = {moment(most['t'])} s, in "
            f"{_element(most)}.{_estimate(result, found)}")  # fmt: skip


def _estimate(result: Result, found: dict[str, Any]) -> str:
    """What statics says of the greatest compression, and whether that is on the safe side."""
    one = (result.run.get("against_statics") or {}).get("lowest")
    if not one or not math.isclose(-one["run"], found["compressed"], rel_tol=1e-6):
        return ""
    says = f"{figure(-one['statics'])} N" if one["statics"] < 0 else "no compression at all"
    if one["too_high"] <= 0:
        return f" Statics estimates {says}."
    return f" Statics estimates only {says}, which is on the unsafe side: take the margin from the run."


def _element(found: dict[str, Any], *, on: bool = True) -> str:
    """An element and where it is."""
    route = f", {figure(found['place'])} m on the route" if found.get("place") is not None else ""
    station = f" on {found['station']}" if on and found.get("station") else ""
    along = f" ({figure(found['along'])} m along the line{route})" if found.get("along") is not None else ""
    return f"element {found['element']}{station}{along}"


def _extent(result: Result, found: dict[str, Any]) -> str:
    """How much of the line rucks."""
    who = {one.component for one in _mine(result, found)}
    if len(who) == 1:
        return "It is the only element that rucks."
    if not who:
        return ""
    most = max(count for _, count in _rucking(result, found))
    return f"{len(who)} elements ruck at some time, at most {most} at once."
