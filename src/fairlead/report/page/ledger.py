"""The energy ledger of a run as rows with bars: what came in, where it went, what is missing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fairlead.results import Result

MOST_LOST = 8


def ledger_rows(result: Result) -> list[dict[str, Any]]:
    """Rows of entry, energy [J] and the share of the largest; empty where no ledger was kept or no energy passed."""
    energy = result.run.get("energy") or {}
    supplied, gone, stored = (energy.get(key) for key in ("supplied", "dissipated", "stored_change"))
    if supplied is None or gone is None or stored is None or not any((supplied, gone, stored)):
        return []
    lost = sorted((result.run.get("lost") or {}).items(), key=lambda item: -abs(item[1]))
    taken = sum(value for _, value in lost)
    rows = [("supplied by sources", supplied, "in"), ("dissipated", gone, "out"),
            ("more stored than before", stored, "out")]  # fmt: skip
    rows += [(f"lost in impacts of {name}", value, "out") for name, value in lost[:MOST_LOST]]
    missing = supplied - gone - stored - taken  # small beside what it is the difference of: two digits say all
    rows += [("missing", float(f"{missing:.2g}"), "gap")]
    most = max(max(abs(value) for _, value, _ in rows), 1e-300)
    return [{"entry": entry, "energy": value, "bar": abs(value) / most, "kind": kind} for entry, value, kind in rows]
