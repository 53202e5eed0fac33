"""How a run went, in sentences: a heading, a mood (good, fair, bad or plain) and a sentence or two each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fairlead.analysis.margins.ruck_words import moment
from fairlead.analysis.record.reported import told
from fairlead.report.page.happened import happened
from fairlead.report.page.places import without_folders
from fairlead.report.page.rucking import rucking
from fairlead.report.page.sentence import Sentence, ended
from fairlead.report.page.slow import slowest
from fairlead.report.page.trust import trust

if TYPE_CHECKING:
    from fairlead.results import Result


def verdict(result: Result) -> list[Sentence]:
    """All that is known of how a run went: what broke first, then what it cost and what its numbers are worth.

    Of a run that did not finish, that comes first, and what was good holds so far.
    """
    return [one.rewritten(lambda text: without_folders(text, result.run)) for one in _verdict(result)]


def _verdict(result: Result) -> list[Sentence]:
    run = result.run
    found, end = [*rucking(result), *_limits(run)], list(_finished(run))
    if run["status"] == "finished":
        first = [*found, *happened(result), *end]
    else:
        first = [*end, *(one._replace(about=f"{one.about} so far", mood="plain") if one.mood == "good" else one
                         for one in found), *happened(result)]  # fmt: skip
    return [*first, *_slow(result), *trust(run), *_remarks(run)]


def _finished(run: dict[str, Any]) -> Iterator[Sentence]:
    status = run["status"]
    if status == "finished":
        cost = f" Stepping took {run['solve_time']:.2g} s of computing." if run.get("solve_time") is not None else ""
        end = run.get("end_time")
        at = "" if end is None else f", {moment(end)} s"
        yield Sentence("Finished", "good", f"The run reached its end{at}.{cost}")
        return
    said = run.get("sentence") or {
        "killed": "The process was gone before the run ended; what it had written is shown.",
        "running": "The run still goes on; what it has written so far is shown.",
    }.get(status, "The run ended early; what it had computed is shown.")
    yield Sentence("Not finished", "bad", f"Status: {status}. {said}")


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


def _remarks(run: dict[str, Any]) -> Iterator[Sentence]:
    for one in told(run):
        if one.kind in ("warning", "note"):
            yield Sentence("Remark", "fair" if one.kind == "warning" else "plain", ended(one.text))
