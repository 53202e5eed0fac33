"""Tables of a result: margins of its lines, limits, energy, zone changes."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from fairlead.analysis.margins.limits_again import judged
from fairlead.analysis.margins.margins import LineMargins, StationMargins, Worst
from fairlead.analysis.margins.margins import margins as of_lines
from fairlead.analysis.margins.ruck import sentence, verdicts
from fairlead.errors import UsageError, did_you_mean, listing, shown
from fairlead.results import Result
from fairlead.results.signal import matching
from fairlead.results.table import Table

QUANTITIES = {
    "peak": "N", "lowest": "N", "hose": "N", "core": "N", "side_wall": "N/m", "scuffed": "m", "inner_scuffed": "m",
    "slipped": "m", "registration": "m",
}  # fmt: skip
"""What margins are told of, as `StationMargins` describes it, with units; `hose` and `core` are lowest tensions."""


def margins(result: Result, picked: str) -> Table:
    """A row for each quantity of each station, and of the whole line. Raises DamagedResultsError, UsageError."""
    rows, lines = list[tuple[Any, ...]](), of_lines(result)
    notes = [] if lines else ["the model has no line on a route; limits of the netlist are in result.limits"]
    names = [line.line for line in lines]
    if picked != "*" and not (isinstance(picked, str) and matching(names, picked)):
        raise UsageError(_no_line(result, picked, names))
    for line in lines:
        if not matching([line.line], picked):
            continue
        for station in (*line.stations, line.whole):
            rows += [row for name in QUANTITIES if (row := _row(line, station, name)) is not None]
        notes += [f"record {text}" for text in line.missing]
    columns = ("line", "station", "quantity", "value", "unit", "margin", "t", "signal", "place")
    return Table("margins", columns, ("", "", "", "", "", "", "s", "", "m"), tuple(rows), tuple(notes))


def _no_line(result: Result, picked: object, names: list[str]) -> str:
    """What margins are told of, where nothing has this name."""
    near = did_you_mean(picked, names) if isinstance(picked, str) else ""
    there = f"Margins are those of {listing(names)}." if names else "This run has no line."
    limited = [one.signal for one in judged(result)]
    more = f"The limits of the netlist, on {listing(limited)}, are in result.limits." if limited else ""
    return f"margins: {shown(picked)} is not a line. {near} {there} {more}".replace("  ", " ").strip()


def _row(line: LineMargins, station: StationMargins, quantity: str) -> tuple[Any, ...] | None:
    worst: Worst | None = getattr(station, quantity)
    if worst is None or (quantity == "hose" and line.of_hose != "hose"):  # which is told already
        return None
    margin = {line.of_hose: line.ruck_margin, "side_wall": line.side_wall_margin}.get(quantity)
    bears = margin(station) if margin is not None else None
    place = (worst.t, worst.signal, worst.place)
    return (line.line, station.name, quantity, worst.value, QUANTITIES[quantity], bears, *place)


def rucks(result: Result) -> Table:
    """A row for each line with a `ruck_force`. Raises DamagedResultsError."""
    units = {"line": "", "rucks": "", "ruck_force": "N", "compressed": "N", "margin": "", "t": "s", "element": "",
             "along": "m", "place": "m", "station": ""}  # fmt: skip
    found = verdicts(result)
    rows = tuple(tuple(one.get(name) for name in units) for one in found)
    return Table("rucks", tuple(units), tuple(units.values()), rows,
                 tuple(sentence(one) for one in found) or ("no line of the model has a ruck_force",))  # fmt: skip


def limits(result: Result) -> Table:
    """A row for each limit of the netlist. Raises DamagedResultsError."""
    rows = ((one.signal, one.text, one.bound, one.value, one.unit, one.t, one.broken) for one in judged(result))
    columns, found = ("signal", "allowed", "bound", "value", "unit", "t", "broken"), tuple(rows)
    notes = () if found else ("the model has no limits",)
    return Table("limits", columns, ("", "", "", "", "", "s", ""), found, notes)


def energy(result: Result) -> Table:
    """Supplied, dissipated, change of what is stored, losses in impacts, what is missing [J]; the share missing."""
    ledger, lost = result.run.get("energy") or {}, result.run.get("lost") or {}
    rows: list[tuple[str, float | None]] = [(name, ledger.get(name)) for name in ("supplied", "dissipated")]
    rows.append(("stored", ledger.get("stored_change")))
    rows += [(f"lost in impacts of {path}", value) for path, value in lost.items()]
    if all(value is not None for _, value in rows[:3]):
        supplied, dissipated, stored = (float(value) for _, value in rows[:3] if value is not None)
        rows.append(("missing", stored + dissipated - supplied))
    closure, silent = ledger.get("closure"), ledger.get("undeclared") or ()
    notes = [f"{closure:.2g} of what passed is missing"] if closure is not None else []
    notes += [f"{', '.join(silent)}: no energy is declared, so it is not judged"] if silent else []
    return Table("energy", ("entry", "energy"), ("", "J"), tuple(rows), tuple(notes))


def switches(result: Result, pattern: str) -> Table:
    """A row for each pair of zones of each component that fits. Raises UsageError where none does."""
    found: dict[tuple[str, str, str], list[float]] = defaultdict(list)
    for event in result.events:
        found[event.component, event.zone_from, event.zone_to].append(event.t)
    names = list(dict.fromkeys(component for component, _, _ in found))
    picked = set(matching(names, pattern)) if isinstance(pattern, str) else set()
    if pattern != "*" and not picked:
        raise UsageError(_never_changed(result, pattern, names))
    rows = [(*key, len(times), min(times), max(times)) for key, times in found.items() if key[0] in picked]
    rows.sort(key=lambda row: -row[3])
    columns = ("component", "zone_from", "zone_to", "count", "first", "last")
    return Table("zone changes", columns, ("", "", "", "", "s", "s"), tuple(rows))


def _never_changed(result: Result, pattern: str, names: list[str]) -> str:
    """Why no zone change fits: nothing of this name changes zone, or what there is did not in this run."""
    could = [member for one in result.run.get("zones") or () for member in _members(one)]
    if isinstance(pattern, str) and matching(could, pattern):
        return f"{pattern} did not change zone in this run."
    known = list(dict.fromkeys((*names, *could)))
    near = did_you_mean(pattern, known) if isinstance(pattern, str) else ""
    there = f"Zones are changed by {listing(known)}." if known else "Nothing in this run changes zone."
    return f"No component of the name {pattern} changes zone. {near} {there}".replace("  ", " ")


def _members(one: dict[str, Any]) -> list[str]:
    """Components of an entry of `zones`: `line.outer[*]` with its elements."""
    return [str(one["family"]).replace("*", str(number), 1) for number in one["elements"]]
