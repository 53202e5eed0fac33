"""How a run went, in sentences: a heading, a mood (good, fair, bad or plain) and a sentence or two each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from fairlead.analysis.margins.ruck import sentence as of_ruck
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.margins.ruck_cause import why
from fairlead.analysis.record.energy import open_by
from fairlead.analysis.record.reported import told
from fairlead.analysis.treatments.friction_record import sentence as of_friction
from fairlead.report.page.slow import slowest

if TYPE_CHECKING:
    from fairlead.results import Event, Result

CLOSED = 1e-2
"""Energy that may be missing before a reader is told to look: a hundredth of what passed."""
BEYOND = {"beyond", "rucking"}
"""Zones of an element that rucks."""
CLOSE = 0.05
"""Difference of a tension from that of statics that is called small."""


class Sentence(NamedTuple):
    """One line of the verdict; `points` are more sentences, each with the word for what it is about."""

    about: str
    mood: str
    text: str
    points: Sequence[tuple[str, str]] = ()
    brief: str = ""
    """What stands for it where it is folded away, if that is not `about`."""

    @property
    def worth(self) -> bool:
        """True for what tells how far the numbers can be trusted; it is folded away where nothing is wrong."""
        return self.about in ("Against statics", "Energy", "Worst creep", "Accuracy")


def verdict(result: Result) -> list[Sentence]:
    """All that is known of how a run went: what broke first, then what it cost and what its numbers are worth.

    Of a run that did not finish, that comes first, and what was good holds so far.
    """
    run = result.run
    found, end = [*_ruck(result), *_limits(run)], list(_finished(run))
    if run["status"] == "finished":
        first = [*found, *end]
    else:
        first = [*end, *(one._replace(about=f"{one.about} so far", mood="plain") if one.mood == "good" else one
                         for one in found)]  # fmt: skip
    return [*first, *_slow(result), *_statics(run), *_energy(run), *_creep(run), *_accuracy(run), *_remarks(run)]


def _finished(run: dict[str, Any]) -> Iterator[Sentence]:
    end, status = run.get("end_time"), run["status"]
    if status == "finished":
        cost = f" Stepping took {run['solve_time']:.2g} s of computing." if run.get("solve_time") is not None else ""
        yield Sentence("Finished", "good", f"The run reached its end, {_number(end)} s.{cost}")
        return
    said = run.get("sentence") or {
        "killed": "The process was gone before the run ended; what it had written is shown.",
        "running": "The run still goes on; what it has written so far is shown.",
    }.get(status, "The run ended early; what it had computed is shown.")
    yield Sentence("Not finished", "bad", f"Status: {status}. {said}")


def _ruck(result: Result) -> Iterator[Sentence]:
    found = result.run.get("ruck")
    for one in verdicts(result) if found is None else found:
        if not one["rucks"]:
            yield Sentence("No ruck", "good", f"{_sentence(of_ruck(one))}", why(one))
            continue
        bears, has = _number(one["ruck_force"]), one.get("compressed")
        much = f"up to {_number(has)} N, a margin of {bears}/{_number(has)} = {one['margin']:.2g}" if has else "more"
        yield Sentence("The hose rucks", "bad",
                       f"{one['line']}: the hose bears {bears} N of compression. It has {much}.",
                       [*_points(result, one), *why(one)])  # fmt: skip


def _points(result: Result, found: dict[str, Any]) -> list[tuple[str, str]]:
    """When, where, how much and why a line rucks, a sentence or two each."""
    return [
        ("When", f"First at t = {_number(found['t'])} s.{_lasting(result, found)}"),
        ("Where", f"First in {_element(found)}."),
        ("How much", f"{_extent(result, found)}{_most(result, found)}".strip()),
    ]


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
    until = "the end of the run" if longest[1] == end else f"{_number(longest[1])} s"
    one_of = f", the longest of {len(stretches)} such times" if len(stretches) > 1 else ""
    return f" From {_number(longest[0])} s to {until} some element rucks without a pause{one_of}."


def _most(result: Result, found: dict[str, Any]) -> str:
    """When and where the greatest compression was, and what statics said of it."""
    most = found.get("most")
    if most is None or not found["compressed"]:
        return ""
    return (f" The greatest compression is {_number(found['compressed'])} N at t = {_number(most['t'])} s, in "
            f"{_element(most)}.{_estimate(result, found)}")  # fmt: skip


def _estimate(result: Result, found: dict[str, Any]) -> str:
    """What statics says of the greatest compression, and whether that is on the safe side."""
    one = (result.run.get("against_statics") or {}).get("lowest")
    if not one or not math.isclose(-one["run"], found["compressed"], rel_tol=1e-6):
        return ""
    says = f"{_number(-one['statics'])} N" if one["statics"] < 0 else "no compression at all"
    if one["too_high"] <= 0:
        return f" Statics estimates {says}."
    return f" Statics estimates only {says}, which is on the unsafe side: take the margin from the run."


def _element(found: dict[str, Any]) -> str:
    """An element and where it is."""
    route = f", {_number(found['place'])} m on the route" if found.get("place") is not None else ""
    station = f" on {found['station']}" if found.get("station") else ""
    along = f" ({_number(found['along'])} m along the line{route})" if found.get("along") is not None else ""
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


def _slow(result: Result) -> Iterator[Sentence]:
    said = slowest(result)
    if said:
        yield Sentence("What made it slow", "plain", said)


def _limits(run: dict[str, Any]) -> Iterator[Sentence]:
    limits, broken = run.get("limits") or (), run.get("limits_broken") or ()
    if broken:
        more = f" And {len(broken) - 3} more." if len(broken) > 3 else ""
        yield Sentence("Limits broken", "bad", f"{'; '.join(map(str, broken[:3]))}.{more}")
    elif limits:
        near = [f"{one['signal']} {one['text']}: {one['nearest'][1]:.4g} {one['unit']} in {one['nearest'][0]} at "
                f"{one['nearest'][2]:.4g} s came nearest" for one in limits[:3] if one.get("nearest")]  # fmt: skip
        yield Sentence("Limits kept", "good", f"{'; '.join(near) or 'None of the limits of the netlist was passed'}.")


def _statics(run: dict[str, Any]) -> Iterator[Sentence]:
    found = run.get("against_statics")
    if not found:
        return
    if found.get("difference") is None:
        yield Sentence("Against statics", "plain", f"Not compared: {found.get('reason', 'unknown')}.")
        return
    off = found["difference"]
    yield Sentence("Against statics", "good" if off <= CLOSE else "fair",
                   f"In steady motion the tension differs from the algebra of statics by {100 * off:.2g} % at most: "
                   f"{found['run']:.4g} N for {found['statics']:.4g} N {found['where']}, "
                   f"{found['from']:.3g} to {found['to']:.3g} s.")  # fmt: skip


def _energy(run: dict[str, Any]) -> Iterator[Sentence]:
    closure, left_open = (run.get("energy") or {}).get("closure"), open_by(run.get("energy"))
    if closure is None or left_open is None:
        return
    closes = left_open <= CLOSED
    said = f"The ledger {'closes' if closes else 'does not close'}: {_number(closure)} of what passed is missing"
    within = ", no more than the error weights of so little motion explain" if closes and closure > CLOSED else ""
    yield Sentence("Energy", "good" if closes else "bad", f"{said}{within}.")


def _creep(run: dict[str, Any]) -> Iterator[Sentence]:
    found, friction = run.get("worst_creep"), of_friction(run.get("friction"))
    how = f" Friction: {friction}." if friction else ""
    if found and found.get("value") is not None:
        yield Sentence("Worst creep", "good" if found["value"] < 1e-6 else "fair",
                       f"A contact that should be stuck moved by at most {_number(found['value'])} m/s, in "
                       f"{found['contact']} at {found.get('t', 0.0):.4g} s.{how}")  # fmt: skip
    elif how:
        yield Sentence("Worst creep", "plain", f"No contact was held.{how}")


def _accuracy(run: dict[str, Any]) -> Iterator[Sentence]:
    asked = (run.get("settings") or {}).get("accuracy")
    if asked is not None:
        yield Sentence("Accuracy", "plain",
                       f"{_number(asked)} by step was asked for. It is a setting, so it has no tick; a run with a "
                       f"tenth of it shows how far the numbers move. Engine {run.get('engine', 'unknown')} took "
                       f"{run.get('steps', 0)} steps, {run.get('rejected', 0)} were rejected, "
                       f"{run.get('switches', 0)} zone changes.",
                       brief=f"accuracy {_number(asked)} by step")  # fmt: skip


def _remarks(run: dict[str, Any]) -> Iterator[Sentence]:
    for one in told(run):
        if one.kind in ("warning", "note"):
            yield Sentence("Remark", "fair" if one.kind == "warning" else "plain", _sentence(one.text))


def _sentence(text: str) -> str:
    text = text.strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


def _number(value: Any) -> str:
    return "unknown" if value is None else f"{value:.4g}"
