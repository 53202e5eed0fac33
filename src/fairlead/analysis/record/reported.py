"""What a run has to say beside its numbers: remarks, why it ended early, chatter, strains, limits that it broke.

All of it is read from the contents of `run.json`, so that a run says the same when it is opened again. The command line
prints it on standard error; `Model.run` gives the remarks to `warnings`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

from fairlead.analysis.record.chattering import remark as of_chatter
from fairlead.analysis.record.energy import open_by, suspects, unjudged
from fairlead.analysis.record.pushes import remark as of_pushes
from fairlead.analysis.record.strains import remark as of_strains

OPEN = 0.1
"""An energy ledger that misses more than this share of what passed is not that of a run to be trusted."""


class Told(NamedTuple):
    """One sentence, and how much it matters: an `end` is why the run did not finish; a `note` asks for nothing."""

    kind: Literal["warning", "end", "note", "limit broken"]
    text: str


def told(run: Mapping[str, Any]) -> Iterator[Told]:
    """All of it, in the order in which the command line prints it."""
    for said in run.get("remarks") or ():
        yield Told("warning", str(said))
    if run["status"] != "finished":
        yield Told("end", str(run.get("sentence") or "the run ended early"))
    reaction = run.get("settings", {}).get("chatter", "")
    if said := of_chatter(run.get("chattering", ()), run.get("dwell", 0.0), reaction):
        yield Told("warning", said)
    closure = open_by(run.get("energy"))
    if run["status"] == "finished" and closure is not None and not closure <= OPEN:
        missing = f"the energy ledger does not close, {closure:.2g} of what passed is missing: do not trust this run."
        first = suspects(run.get("energy"))
        advice = f"{'Then ask' if first else 'Ask'} for a finer accuracy, or look for a number far from all others."
        yield Told("warning", f"{missing} {first} {advice}".replace("  ", " "))
    if silent := unjudged(run.get("energy")):
        yield Told("note", silent)
    if strained := of_strains(run.get("strains")):
        yield Told("warning", strained)
    if pushed := of_pushes(run.get("pushes")):
        yield Told("warning", pushed)
    for broken in run.get("limits_broken") or ():
        yield Told("limit broken", str(broken))


def remarks(run: Mapping[str, Any]) -> tuple[str, ...]:
    """The sentences that `Model.run` warns of; why a run did not finish is not among them."""
    said = (f"limit broken: {one.text}" if one.kind == "limit broken" else one.text
            for one in told(run) if one.kind in ("warning", "limit broken"))  # fmt: skip
    return tuple(said)
