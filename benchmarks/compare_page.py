"""The tables of docs/benchmarks.md that compare.py writes: ratios and aims, and what each way of solving reached."""

from __future__ import annotations

import pathlib
from typing import Any

from compare_table import AIMS, cheapest, label, ratios
from work_precision import STYLES

PAGE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "benchmarks.md"
BEGIN, END = "<!-- compare.py writes from here -->", "<!-- to here -->"
SHOWN = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
HEADS = {
    "belt": "Belt: one block, 50 cycles of stick-slip", "chain-10": "Chain of 10 blocks",
    "chain-100": "Chain of 100 blocks", "chain-1000": "Chain of 1000 blocks",
}  # fmt: skip
NAMES = {"sundae": "CVODE"}


def write(result: dict[str, Any]) -> None:
    """Put the tables into the page."""
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    if not rest:
        raise SystemExit(f"{PAGE} has no line {BEGIN}")
    told = "\n\n".join(case(name, found) for name, found in result["cases"].items())
    PAGE.write_text(f"{before}{BEGIN}\n\n{told}\n\n{END}{rest.partition(END)[2]}", encoding="utf-8")


def case(name: str, found: dict[str, Any]) -> str:
    """All that is told of a case."""
    rows = found["rows"]
    return "\n\n".join([f"### {HEADS[name]}", beside_peers(name, rows), measured(rows), every_way(rows)])


def beside_peers(name: str, rows: list[dict]) -> str:
    """The cheapest of fairlead and of its peers at each error, and the aims."""
    lines = ["| error at most | fairlead, whole call | | in the loop | aim | C by hand | best peer | | ratio |",
             "| --- " * 9 + "|"]  # fmt: skip
    for line in ratios(rows):
        if line["error"] not in SHOWN and (name, line["error"]) not in AIMS:
            continue
        ours, theirs, (aim, _, by_hand) = line["fairlead"], line["peer"], AIMS.get((name, line["error"]), (None,) * 3)
        inside = min(one["least_solve"] for one in rows if one["program"] == "fairlead" and fits(one, line["error"]))
        met = "" if aim is None else f"{time(aim)}, " + ("met" if inside <= aim else "**not met**")
        peer = "none gets there | |" if theirs is None else \
            f"{time(theirs['cpu'])} | {NAMES.get(theirs['program'], theirs['program'])} {label(theirs)} |"  # fmt: skip
        cells = [power(line["error"]), time(ours["cpu"]), f"{ours['method']}, {label(ours).partition(' ')[0]}, "
                 f"{ours['accuracy']:.0e}", time(inside), met, time(by_hand) if by_hand else ""]  # fmt: skip
        ratio = "" if theirs is None else f"{line['ratio']:.0f}"
        lines.append("| " + " | ".join(cells) + f" | {peer} {ratio} |")
    return "\n".join(lines)


def fits(one: dict, wanted: float) -> bool:
    """Whether a run came that near."""
    return one.get("error", 1.0) <= wanted


def every_way(rows: list[dict]) -> str:
    """CPU time of each way of solving at each error, and what became of the runs that gave none."""
    lines = ["| way | " + " | ".join(power(wanted) for wanted in SHOWN) + " | best error | else |", "| --- " * 8 + "|"]
    for series in sorted({one["series"] for one in rows}, key=list(STYLES).index):
        mine = [one for one in rows if one["series"] == series]
        found = [cheapest(mine, wanted) for wanted in SHOWN]
        best = min((one["error"] for one in mine if "error" in one), default=None)
        program, _, rest = series.partition(" ")
        reasons = (f"{power(one['accuracy'])} {short(one['failed'])}" for one in mine if "failed" in one)
        failed = "; ".join(dict.fromkeys(reasons))
        cells = [f"{NAMES.get(program, program)} {rest}", *(time(one["cpu"]) if one else "-" for one in found)]
        lines.append("| " + " | ".join([*cells, power(best) if best else "none", failed]) + " |")
    return "\n".join(lines)


def short(reason: str) -> str:
    """A reason without what only matters in the data file."""
    return reason.removeprefix("failed: ").removeprefix("cannot: ").partition("\n")[0][:110]


def measured(rows: list[dict]) -> str:
    """When, and at which commits."""
    dates, commits = sorted({one["date"] for one in rows}), sorted({one["commit"] for one in rows})
    until = "" if dates[0] == dates[-1] else f" to {dates[-1]}"
    return f"Rows of {dates[0]}{until} UTC, at {', '.join(commits)}."


def time(seconds: float) -> str:
    """Three digits at most, in ms or s."""
    return (
        f"{1e3 * seconds:.2g} ms" if seconds < 0.0995 else f"{seconds:.2g} s" if seconds < 99.5 else f"{seconds:.0f} s"
    )


def power(wanted: float) -> str:
    """An error as it is written."""
    return f"{wanted:.0e}".replace("e-0", "e-")
