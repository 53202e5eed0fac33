"""How far the numbers of a run can be trusted: lines of the verdict that are folded away where nothing is wrong.

A tick says what it compares. Statics knows the tension of all layers together; how hose and core share it is an
estimate, which has a line of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fairlead.analysis.margins.ruck_words import moment
from fairlead.analysis.margins.settled import SMALL, much
from fairlead.analysis.margins.settled import sentence as of_drift
from fairlead.analysis.record.energy import open_by, suspects
from fairlead.analysis.treatments.friction_record import sentence as of_friction
from fairlead.report.page.sentence import Sentence, number

CLOSED = 1e-2
"""Energy that may be missing before a reader is told to look: a hundredth of what passed."""
CLOSE = SMALL
"""Difference of a tension from that of statics that is called small."""


def trust(run: dict[str, Any]) -> list[Sentence]:
    """All that tells how far the numbers of a run can be trusted."""
    found = [*_statics(run), *_settled(run), *_hose(run), *_energy(run), *_creep(run), *_accuracy(run)]
    return [one._replace(worth=True) for one in found]


def _statics(run: dict[str, Any]) -> Iterator[Sentence]:
    """The tension of all layers together, which statics knows."""
    found = run.get("against_statics")
    if not found:
        return
    if found.get("difference") is None:
        yield Sentence("Against statics", "plain", f"Not compared: {found.get('reason', 'unknown')}.")
        return
    off, two = found["difference"], found.get("shares")
    what = "tension of hose and core together" if two else "tension"
    rest = " It says nothing of how the two share it." if two else ""
    brief = f"{what} {'as in' if off <= CLOSE else 'not as in'} statics"
    yield Sentence("Against statics", "good" if off <= CLOSE else "fair",
                   f"At constant speed, {moment(found['from'])} to {moment(found['to'])} s, the mean {what} differs "
                   f"from that of statics by {100 * off:.2g} % at most: {found['run']:.4g} N for "
                   f"{found['statics']:.4g} N {found['where']}.{rest}", brief=brief)  # fmt: skip


def _settled(run: dict[str, Any]) -> Iterator[Sentence]:
    """Whether what moves at constant speed has become steady."""
    found = (run.get("against_statics") or {}).get("drift")
    if not found:
        return
    if not found["settled"]:
        told = any(one["line"] == found["line"] for one in run.get("ruck") or ())  # with the verdict on that line
        said = (f"The {found['layer']} still changes at constant speed, by {much(found)} from one half of the time to "
                "the other. The verdict has the figures.")  # fmt: skip
        yield Sentence("Not settled", "fair", said if told else of_drift(found), brief="not settled", above=told)
        return
    yield Sentence("Settled", "good",
                   f"At constant speed, {moment(found['from'])} to {moment(found['to'])} s, the extremes of the "
                   f"tension of the {found['layer']} change by at most {much(found)}, from the first half of that "
                   f"time to the second.{_beside(run, found)}")  # fmt: skip


def _beside(run: dict[str, Any], found: dict[str, Any]) -> str:
    """What the force is that a change is told as a share of."""
    lines = {one["line"]: one.get("ruck_force") for one in run.get("routes") or ()}
    beside, rucks = found.get("beside"), lines.get(found["line"])
    if not beside:
        return ""
    return f" At {number(beside)} N it rucks." if beside == rucks else f" Its tensions span {number(beside)} N."


def _hose(run: dict[str, Any]) -> Iterator[Sentence]:
    """The lowest tension of the hose alone, which statics estimates and which a ruck margin comes from.

    It is marked where an estimate that is so far off could decide whether the hose rucks.
    """
    one = (run.get("against_statics") or {}).get("lowest")
    if not one:
        return
    bears, off = one["ruck_force"], one["too_high"]
    close = abs(off) <= CLOSE * max(bears or 0.0, abs(one["run"]), abs(one["statics"]))
    unsafe = off > 0 and not close
    decides = unsafe and (one["run"] < 0 if bears is None else off - one["run"] > bears)  # so far off it could ruck
    side = "too high, which is the unsafe side: take the margin from the run" if unsafe else "too high"
    if off <= 0:
        side = "too low, which is the safe side"
    above = any(line["rucks"] for line in run.get("ruck") or ())
    yield Sentence("Hose against statics", "fair" if decides else "good" if close else "plain",
                   f"The lowest tension of the hose alone is {number(one['run'])} N. Statics estimates "
                   f"{number(one['statics'])} N, {number(abs(off))} N {side}.",
                   brief=f"hose alone {'as in' if close else 'not as in'} statics", above=above)  # fmt: skip


def _energy(run: dict[str, Any]) -> Iterator[Sentence]:
    closure, left_open = (run.get("energy") or {}).get("closure"), open_by(run.get("energy"))
    if closure is None or left_open is None:
        return
    closes = left_open <= CLOSED
    said = f"The ledger {'closes' if closes else 'does not close'}: {number(closure)} of what passed is missing"
    within = ", no more than the error weights of so little motion explain" if closes and closure > CLOSED else ""
    own = "" if closes else f" {suspects(run.get('energy'))}".rstrip()
    yield Sentence("Energy", "good" if closes else "bad", f"{said}{within}.{own}", brief="energy")


def _creep(run: dict[str, Any]) -> Iterator[Sentence]:
    found, friction = run.get("worst_creep"), of_friction(run.get("friction"))
    how = f" Friction: {friction}." if friction else ""
    if found and found.get("value") is not None:
        yield Sentence("Worst creep", "good" if found["value"] < 1e-6 else "fair",
                       f"A contact that should be stuck moved by at most {number(found['value'])} m/s, in "
                       f"{found['contact']} at {moment(found.get('t', 0.0))} s.{how}")  # fmt: skip
    elif how:
        held = "No contact was held." if "steps" in run else "Not known of a run that was cut off."
        yield Sentence("Worst creep", "plain", f"{held}{how}")


def _accuracy(run: dict[str, Any]) -> Iterator[Sentence]:
    asked = (run.get("settings") or {}).get("accuracy")
    if asked is not None:
        counts = " How many steps it took is not known of a run that was cut off."
        if "steps" in run:
            counts = (f" It took {run['steps']} steps, {run.get('rejected', 0)} were rejected, "
                      f"{run.get('switches', 0)} zone changes.")  # fmt: skip
        yield Sentence("Accuracy", "plain",
                       f"A relative error of {number(asked)} in each step was allowed. It is a setting, so it has no "
                       f"tick; a run with a tenth of it shows how far the numbers move. The engine was "
                       f"{run.get('engine', 'unknown')}.{counts}",
                       brief=f"accuracy {number(asked)} a step")  # fmt: skip
