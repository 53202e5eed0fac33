"""How a run went, in sentences: a heading, a mood (good, fair, bad or plain) and a sentence or two each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from fairlead.analysis.margins.ruck import sentence as of_ruck
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.record.reported import told
from fairlead.analysis.treatments.friction_record import sentence as of_friction
from fairlead.report.page.zones import meaning, starts

if TYPE_CHECKING:
    from fairlead.results import Result

CLOSED = 1e-2
"""Energy that may be missing before a reader is told to look: a hundredth of what passed."""
BEYOND = {"beyond", "rucking"}
"""Zones of an element that rucks."""
CLOSE = 0.05
"""Difference of a tension from that of statics that is called small."""


class Sentence(NamedTuple):
    """One line of the verdict."""

    about: str
    mood: str
    text: str


def verdict(result: Result) -> list[Sentence]:
    """All that is known of how a run went. The first is whether it finished."""
    run = result.run
    return [*_finished(run), *_ruck(result), *_limits(run), *_statics(run), *_energy(run), *_creep(run),
            *_accuracy(run), *_remarks(run)]  # fmt: skip


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
        why = f" {_extent(result, one)} {_why(result, one)}".rstrip() if one["rucks"] else ""
        yield Sentence("The hose rucks" if one["rucks"] else "No ruck", "bad" if one["rucks"] else "good",
                       f"{_sentence(of_ruck(one))}{why}")  # fmt: skip


def _extent(result: Result, found: dict[str, Any]) -> str:
    """How much of the line rucks, and over what time."""
    mine = [one for one in result.events if one.component.startswith(f"{found['line']}.") and BEYOND & {one.zone_to}]
    who = {one.component for one in mine}
    most, now = 0, set[str]()
    for one in result.events:
        if one.component in who:
            now = now | {one.component} if one.zone_to in BEYOND else now - {one.component}
            most = max(most, len(now))
    return (
        f"In the whole run {len(who)} elements ruck at some time, {most} at once at most; "
        f"the last of them begins at t = {mine[-1].t:.4g} s."
    ) if mine else ""


def _why(result: Result, found: dict[str, Any]) -> str:
    """What the contacts of the hose did at the instant of the first ruck: counts, read from the zone changes."""
    line, t = found["line"], found["t"]
    zones = _zones_at(result, t)
    drags = Counter(meaning(zone) for name, zone in zones.items() if name.startswith(f"{line}.outer"))
    inner = Counter(meaning(zone) for name, zone in zones.items() if name.startswith(f"{line}.inner["))
    sliding = drags["forward"] + drags["backward"]
    loose, held = inner["forward"] + inner["backward"], inner["stuck"]
    if not sliding + drags["stuck"] or not loose + held:
        return ""
    where = f" {found['station']}" if found.get("station") else " its devices"
    return (
        f"Why: at that instant the hose rubs on{where} at {sliding + drags['stuck']} places ({sliding} of them slide), "
        f"and the core slides inside the hose at {loose} of {loose + held} pressed places: what drags the hose along "
        "is weaker than what holds it back, so it is pushed together."
    )


def _zones_at(result: Result, t: float) -> dict[str, str]:


    zones = starts(result.run)
    for event in result.events:
        if event.t > t:
            break
        zones[event.component] = event.zone_to
    return zones


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
    closure = (run.get("energy") or {}).get("closure")
    if closure is not None:
        yield Sentence("Energy", "good" if closure <= CLOSED else "bad",
                       f"The ledger closes: {_number(closure)} of what passed is missing." if closure <= CLOSED else
                       f"The ledger does not close: {_number(closure)} of what passed is missing.")  # fmt: skip


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
                       f"Asked for {_number(asked)} by step; engine {run.get('engine', 'unknown')} took "
                       f"{run.get('steps', 0)} steps, {run.get('rejected', 0)} were rejected, "
                       f"{run.get('switches', 0)} zone changes.")  # fmt: skip


def _remarks(run: dict[str, Any]) -> Iterator[Sentence]:
    for one in told(run):
        if one.kind in ("warning", "note"):
            yield Sentence("Remark", "fair" if one.kind == "warning" else "plain", _sentence(one.text))


def _sentence(text: str) -> str:
    text = text.strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


def _number(value: Any) -> str:
    return "unknown" if value is None else f"{value:.4g}"
