"""The table a run ends with: what it cost, and how far its numbers can be trusted."""

from collections.abc import Mapping, Sequence
from typing import Any

from fairlead.cli.terminal import two_columns

UNKNOWN = "not known"
MOST_NAMED = 3


def print_summary(run: Mapping[str, Any], directory: object) -> None:
    """Print the closing table of a run, from the contents of its `run.json`."""
    two_columns(summary_rows(run, directory))


def summary_rows(run: Mapping[str, Any], directory: object) -> list[tuple[str, str]]:
    """(what, value with unit) of each row."""
    from fairlead.analysis.record import gave_way, kept_time
    from fairlead.analysis.record.below_weight import rows_of_table

    return [
        ("end time", f"{_number(run.get('end_time'), 's')} ({run.get('status', UNKNOWN)})"),
        ("wall time", _wall_time(run)),
        ("engine", str(run.get("engine", UNKNOWN))),
        *_friction(run.get("friction")),
        ("steps", f"{run.get('steps', UNKNOWN)}"),
        ("rejected", f"{run.get('rejected', UNKNOWN)}"),
        ("switches", f"{run.get('switches', UNKNOWN)}"),
        ("worst creep", _creep(run.get("worst_creep"))),
        ("energy closure", _closure(run.get("energy"))),
        *kept_time.rows_of_table(run.get("real_time")),
        *_lost(run.get("lost")),
        *_changed_starts(run.get("changed_starts")),
        *_together(run.get("released_together")),
        *gave_way.rows_of_table(run.get("gave_way")),
        *rows_of_table(run.get("below_weight")),
        *_against_statics(run.get("against_statics")),
        *_ruck(run.get("ruck")),
        ("results", str(directory)),
    ]


def _friction(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """How friction was treated and who chose that; nothing without a contact."""
    from fairlead.analysis.treatments.friction_record import sentence

    return [("friction", sentence(found))] if found else []


def _ruck(found: Sequence[dict[str, Any]] | None) -> list[tuple[str, str]]:
    """The verdict on each line that is watched for rucking."""
    if not found:
        return []
    from fairlead.analysis.margins.ruck import sentence

    return [("ruck", sentence(one)) for one in found[:MOST_NAMED]]


def _lost(lost: Mapping[str, float] | None) -> list[tuple[str, str]]:
    """Energy that impacts took, by component; nothing where there were none."""
    if not lost:
        return []
    most = sorted(lost.items(), key=lambda item: -item[1])
    named = ", ".join(f"{value:.3g} J in {path}" for path, value in most[:MOST_NAMED])
    return [("lost in impacts", named + (f" and in {len(most) - MOST_NAMED} more" if len(most) > MOST_NAMED else ""))]


def _changed_starts(changed: Sequence[Mapping[str, Any]] | None) -> list[tuple[str, str]]:
    """Start values that did not hold; nothing where all did."""
    return [
        ("start changed", f"{one['name']} from {one['given']:.4g} to {one['became']:.4g} {one['unit']}")
        for one in (changed or ())[:MOST_NAMED]
    ]


def _together(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Contacts that passed their limits at one instant; nothing where none did."""
    if not found or not found.get("count"):
        return []
    one = found["first"][0]
    more = f" and {one['of'] - MOST_NAMED} more" if one["of"] > MOST_NAMED else ""
    named = f"t = {one['t']:.6g} s: {', '.join(one['contacts'][:MOST_NAMED])}{more} came to their limits together"
    again = f", and so at {found['count'] - 1} later instants" if found["count"] > 1 else ""
    why = "They let go together; had one been first, others might hold. A small difference between them decides it."
    return [("let go at once", f"{named}{again}. {why}")]


def _against_statics(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """How far a line at constant speed is from the tensions of `fairlead statics`; nothing without a route."""
    if found is None:
        return []
    return [("against statics", _total(found)), *_drift(found.get("drift")), *_shares(found.get("shares")),
            *_lowest(found.get("lowest"))]  # fmt: skip


def _drift(found: dict[str, Any] | None) -> list[tuple[str, str]]:
    """What still changes at constant speed; nothing where the motion has settled."""
    if found is None or found["settled"]:
        return []
    from fairlead.analysis.margins.settled import sentence

    return [("not settled", sentence(found))]


def _total(found: Mapping[str, Any]) -> str:
    """The tension of all layers together."""
    if found.get("difference") is None:
        return f"not compared: {found.get('reason', UNKNOWN)}"
    both = f"{found['run']:.4g} N for {found['statics']:.4g} N {found['where']}"
    what = " of hose and core together" if found.get("shares") else ""
    return f"{100 * found['difference']:.2g} % at most{what} ({both}, {found['from']:.3g} ... {found['to']:.3g} s)"


def _shares(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """How hose and core share it, which statics estimates; nothing for a line of one layer."""
    if found is None:
        return []
    run, statics = (" and ".join(f"{found[one][key]:.4g}" for one in ("hose", "core")) for key in ("run", "statics"))
    when = f"{found['where']}, {found['from']:.3g} ... {found['to']:.3g} s"
    return [("hose and core", f"{run} N for an estimate of {statics} N ({when}): that of the hose {_too_far(found)}")]


def _lowest(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """The lowest tension of the hose, with the margin against ruck; nothing for a line of one layer."""
    if found is None:
        return []
    where = found["station"] or (f"{found['place']:.3g} m" if found["place"] is not None else "")
    at = f"{where}, {found['t']:.4g} s" if where else f"{found['t']:.4g} s"
    both = f"{found['run']:.4g} N ({at}) for an estimate of {found['statics']:.4g} N"
    if found["ruck_force"] is not None:
        both += f", ruck margin {_margin(found['run_margin'])} for {_margin(found['statics_margin'])}"
    unsafe = ", on the unsafe side" if found["too_high"] > 0 and found["run"] < 0 else ""
    return [("lowest hose", f"{both}: it {_too_far(found)}{unsafe}")]


def _too_far(found: Mapping[str, Any]) -> str:
    """Which way an estimate is wrong, and how much."""
    return f"is {abs(found['too_high']):.3g} N too {'high' if found['too_high'] > 0 else 'low'}"


def _margin(value: float | None) -> str:
    return "none (no compression)" if value is None else f"{value:.2g}"


def _number(value: float | None, unit: str) -> str:
    return UNKNOWN if value is None else f"{value:.4g} {unit}"


def _wall_time(run: Mapping[str, Any]) -> str:
    """Seconds from the command to the result; the rest is reading, compiling and writing."""
    text = _number(run.get("wall_time"), "s")
    stepping = run.get("solve_time")
    return text if stepping is None else f"{text}, of it stepping {stepping:.2g} s"


def _creep(creep: Mapping[str, Any] | None) -> str:
    """Largest slip speed of a contact that should be stuck; a scene may have no such contact."""
    if not creep or creep.get("value") is None:
        return "no contact was held"
    return f"{creep['value']:.3g} m/s in {creep['contact']}"


def _closure(energy: Mapping[str, Any] | None) -> str:
    """Energy not accounted for, relative to what passed through."""
    if not energy or energy.get("closure") is None:
        return UNKNOWN
    words = [word for word in ("supplied", "dissipated") if energy.get(word) is not None]
    detail = ", ".join(f"{word} {energy[word]:.3g} J" for word in words)
    return f"{energy['closure']:.2g}{f' ({detail})' if detail else ''}"
