"""What a fit says: as lines for a terminal and as a record for JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from fairlead.studies.fits.fit_file import Asked
from fairlead.studies.fits.laws import SAME, Judged, as_good, better_everywhere, preferred
from fairlead.studies.fits.problem import Record, Target
from fairlead.studies.fits.search import Error, Fitted


def record_of(
    asked: Asked, fitted: Fitted, targets: Sequence[Target], errors: Mapping[str, Mapping[str, Error] | None],
    chaotic: Mapping[str, bool], units: Mapping[str, Mapping[str, str]],
) -> dict[str, Any]:  # fmt: skip
    """A fit as JSON: numbers in SI, `errors` in the units of their signals."""
    return {
        "parameters": {
            one.name: {
                "value": fitted.values[one.name], "start": one.start, "low": one.low, "high": one.high, "log": one.log,
                "at_bound": at_bound(one.low, one.high, fitted.values[one.name]),
                "interval": _ends(fitted.intervals[one.name].low, fitted.intervals[one.name].high),
                "bootstrap": fitted.intervals[one.name].drawn,
                "step": fitted.steps[one.name].size, "step_error": fitted.steps[one.name].error,
                "unit": one.unit, "factor": one.factor,
            }
            for one in fitted.problem.sought
        },
        "loss": fitted.loss, "noise_floor": fitted.noise, "runs": fitted.runs,
        "records": {
            name: {
                "left_out": name in asked.given.leave_out, "chaotic": bool(chaotic.get(name)),
                "by": next((one.by for one in targets if one.record.name == name), None),
                "errors": None if found is None else {
                    signal: {**vars(error), "unit": units[name][signal],
                             "block": fitted.blocks.get((name, signal))} for signal, error in found.items()
                },
            }
            for name, found in errors.items()
        },
        "remarks": [*fitted.remarks],
        "directions": [vars(one) for one in fitted.directions],
        "starts": [vars(one) for one in fitted.starts],
    }  # fmt: skip


def laws_record(judged: Sequence[Judged]) -> dict[str, Any]:
    """A comparison of laws as JSON."""
    return {
        "laws": {
            one.law.name: {
                "sentence": one.sentence,
                "values": one.fitted.values if one.fitted else None,
                "trained": {r: {s: vars(e) for s, e in found.items()} for r, found in one.trained.items()},
                "left_out": {r: {s: vars(e) for s, e in found.items()} for r, found in one.left_out.items()},
                "untold": [way.sentence for way in one.fitted.directions if not way.told] if one.fitted else [],
            }
            for one in judged
        },
        "preferred": preferred(judged),
        "as_good": as_good(judged),
        "better_everywhere": better_everywhere(judged),
    }


def lines_of(told: Mapping[str, Any]) -> Iterator[str]:
    """A fit as lines."""
    yield from _parameter_lines(told["parameters"], "no interval" if told["remarks"] else "not told by the data")
    for name, one in told["records"].items():
        word = "left out" if one["left_out"] else f"fitted by {one['by']}"
        if one["chaotic"]:
            word += "; its course cannot be foretold (chaos)"
        if one["errors"] is None:
            yield f"{name} ({word}): the run did not finish"
            continue
        for signal, error in one["errors"].items():
            sizes = f"mean error {error['mean']:.4g} {error['unit']}, rms {error['rms']:.4g} {error['unit']}"
            block = error["block"]
            drawn = f"; bootstrap in blocks of {block} samples" if block is not None and block > 1 else ""
            yield f"{name} ({word}): {signal}: {sizes}{drawn}"
    yield from told["remarks"]
    for one in told["directions"]:
        if not one["told"] and not told["remarks"]:
            yield one["sentence"]
    sizes = ", ".join(f"{name} {one['step']:.2g} ({one['step_error']:.1g})" for name, one in told["parameters"].items())
    yield f"noise floor {told['noise_floor']:.2g} of a residual; steps (error of the derivative): {sizes}"
    ended = [one["loss"] for one in told["starts"]]
    same = sum(one <= min(ended) * (1 + 1e-3) + 1e-12 for one in ended)
    yield f"loss {told['loss']:.6g}; {same} of {len(ended)} starts end there; {told['runs']} runs"


def _parameter_lines(parameters: Mapping[str, Any], without: str) -> Iterator[str]:
    for name, one in parameters.items():
        unit, factor = (f" {one['unit']}" if one["unit"] else ""), one["factor"]
        line = f"{name} = {one['value'] / factor:.6g}{unit}"
        if one["interval"] is None:
            line += f", {without}"
        else:
            low, high = (x / factor for x in one["interval"])
            drawn = [x / factor for x in one["bootstrap"]]
            line += f", 95 % from {low:.6g} to {high:.6g}; by bootstrap from {drawn[0]:.6g} to {drawn[1]:.6g}"
        yield line + (f"; it stands at its bound {one['at_bound']}" if one["at_bound"] else "")


def table_of(judged: Sequence[Judged]) -> tuple[list[str], list[list[str]]]:
    """Laws as a table: heading and rows; mean errors of every record, trained and left out."""
    columns = [(record, signal) for one in judged[:1] for record, found in _widest(judged).items() for signal in found]
    several = len({signal for _, signal in columns}) > 1
    head = ["law"]
    for record, signal in columns:
        name = f"{record} {signal}" if several else record
        head += [f"{name}: trained", "left out"]
    rows = []
    for one in judged:
        row = [one.law.name]
        for record, signal in columns:
            for found in (one.trained, one.left_out):
                error = found.get(record, {}).get(signal)
                row.append(f"{error.mean:.4g}" if error else "-")
        rows.append(row)
    return head, rows


def law_lines(judged: Sequence[Judged]) -> Iterator[str]:
    """A comparison of laws as lines."""
    head, rows = table_of(judged)
    widths = [max(len(row[k]) for row in [head, *rows]) for k in range(len(head))]
    yield "mean error of each record, fitted with it and without it:"
    for row in [head, *rows]:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
    for one in judged:
        if one.sentence:
            yield f"{one.law.name}: {one.sentence}"
    better = better_everywhere(judged)
    yield _preference(judged)
    first = judged[0].law.name
    if better:
        yield f"Better than {first} on every record left out: {', '.join(better)}."
    else:
        yield f"No law is better than {first} on every record left out."


def _preference(judged: Sequence[Judged]) -> str:
    """Which law the records that were left out prefer, or that they do not tell laws apart."""
    same, name = as_good(judged), preferred(judged)
    if not same:
        return "No law is preferred, since none foretells every record that was left out."
    if len(same) == 1:
        return f"The data prefer {name} by its errors on what was left out."
    *others, last = same
    told = f"The data do not tell {', '.join(others)} and {last} apart"
    return f"{told}: their errors on what was left out differ by less than {SAME:.0%}. {name} has the smallest."


def _widest(judged: Sequence[Judged]) -> Mapping[str, Mapping[str, Error]]:
    return max((one.left_out for one in judged), key=len)


def at_bound(low: float, high: float, value: float) -> str:
    """Which bound a value stands at, or nothing."""
    near = 1e-4 * (high - low)
    return "low" if value - low < near else "high" if high - value < near else ""


def _ends(low: float | None, high: float | None) -> tuple[float, float] | None:
    return None if low is None or high is None else (low, high)


def units_of(records: Sequence[Record]) -> dict[str, Mapping[str, str]]:
    """Units of signals by record."""
    return {one.name: one.units for one in records}
