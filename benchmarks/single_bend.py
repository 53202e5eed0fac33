"""The single bend at both friction levels beside the expected bands, and the spread over settings.

    python benchmarks/single_bend.py             both columns with the bands, about a minute
    python benchmarks/single_bend.py --spread    also accuracy, mesh and treatment; writes benchmarks/data

The bands are those of the published experiment (in unison at mu = 0.35, de-registered and rucking at 0.60)
in numbers: docs/validation.md says where each comes from.
"""

from __future__ import annotations

import argparse
import json
import math
import pathlib
import tempfile
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

RUCK = -160.0  # N, 2 % strain of a hose with EA = 8 kN
DWELL = 0.1  # s
TIMES = (1.0, 5.0, 8.0, 12.0, 20.0)
DATA = pathlib.Path(__file__).parent / "data" / "single_bend.json"


@dataclass(frozen=True)
class Row:
    """One run in the figures of the validation table."""

    mu: float
    method: str
    accuracy: float
    elements: int
    registration_mm: dict[str, float]
    registration_max_mm: float
    inboard_mean_N: float
    inboard_std_N: float
    inboard_half_range_N: float
    lowest_hose_so_far_N: dict[str, float]
    ruck_first_crossing_s: float | None
    ruck_first_dwell_s: float | None
    dissipated_J: float
    energy_closure: float
    switches: int
    steps: int
    solve_s: float

    @property
    def capstan(self) -> float:
        """Inboard tension of steady sliding [N]."""
        return 800.0 * math.exp(self.mu * math.pi / 2)


def run(mu: float, method: str, accuracy: float, elements: int) -> Row:
    """Simulate 20 s and draw up the row."""
    import fairlead

    settings = {"line.ruck_force": "null", "mu": mu, "method": method,
                "element": f"{15 / elements} m", "run.accuracy": accuracy}  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        model = fairlead.load("single_bend", set={k: str(v) for k, v in settings.items()})
        result = model.run(out=f"{folder}/run", check=False)
        return row(result, mu, method, accuracy, elements)


def row(result: Any, mu: float, method: str, accuracy: float, elements: int) -> Row:
    """The figures of one run."""
    if result.status != "finished":
        raise SystemExit(f"mu = {mu}, {method}, accuracy {accuracy}: {result.run['sentence']}")
    t = result.t
    worst = np.abs(np.stack([result[n] for n in result.match("line.registration[*].d")])).max(axis=0)
    lowest = np.stack([result[n] for n in result.match("line.hose[*].tension")])
    inboard = -result["haul.force"]
    part = (t >= 5) & (t <= 15)
    mean = float(np.trapezoid(inboard[part], t[part]) / (t[part][-1] - t[part][0]))
    crossing, dwell = ruck(t, lowest)
    return Row(
        mu, method, accuracy, elements,
        {f"{at:g}": round(1e3 * float(np.interp(at, t, worst)), 2) for at in TIMES}, round(1e3 * float(worst.max()), 2),
        round(mean, 1), round(float(inboard[part].std()), 1), round(float(np.ptp(inboard[part])) / 2, 1),
        {f"{at:g}": round(float(lowest[:, t <= at].min()), 1) for at in TIMES}, crossing, dwell,
        round(result.run["energy"]["dissipated"], 1), result.run["energy"]["closure"],
        result.run["switches"], result.run["steps"], round(result.run["solve_time"], 2),
    )  # fmt: skip


def ruck(t: np.ndarray, tensions: np.ndarray) -> tuple[float | None, float | None]:
    """First time an element is compressed beyond the limit, and the first time it has been for the dwell."""
    first, dwelt = math.inf, math.inf
    for tension in tensions:
        beyond = tension < RUCK
        if not beyond.any():
            continue
        first = min(first, float(t[beyond.argmax()]))
        since = np.where(beyond, np.maximum.accumulate(np.where(beyond, -math.inf, t)), np.nan)
        long = beyond & (t - since >= DWELL)
        if long.any():
            dwelt = min(dwelt, float(t[long.argmax()]))
    return (round(first, 2) if first < math.inf else None, round(dwelt, 2) if dwelt < math.inf else None)


def bands(low: Row, high: Row) -> Iterator[tuple[str, str, str, str, bool]]:
    """(what, column of 0.35, column of 0.60, expected, whether both are inside)."""
    yield (
        "greatest de-registration", f"{low.registration_max_mm} mm", f"{high.registration_max_mm} mm",
        "< 10 mm | > 120 mm", low.registration_max_mm < 10 and high.registration_max_mm > 120,
    )  # fmt: skip
    errors = [abs(r.inboard_mean_N / r.capstan - 1) for r in (low, high)]
    yield (
        "mean inboard tension, 5-15 s",
        f"{low.inboard_mean_N} N ({errors[0]:.1%})", f"{high.inboard_mean_N} N ({errors[1]:.1%})",
        f"{low.capstan:.0f} N within 1 % | {high.capstan:.0f} N within 2 %", errors[0] < 0.01 and errors[1] < 0.02,
    )  # fmt: skip
    yield (
        "hose below -160 N first / for 0.1 s", f"{low.ruck_first_crossing_s} / {low.ruck_first_dwell_s}",
        f"{high.ruck_first_crossing_s} s / {high.ruck_first_dwell_s} s", "never | yes",
        low.ruck_first_crossing_s is None and high.ruck_first_dwell_s is not None,
    )  # fmt: skip


def show(low: Row, high: Row) -> bool:
    """Print both columns beside the bands; True if all are inside."""
    good = True
    print(f"{low.method}, accuracy {low.accuracy:g}, {low.elements} elements")
    print(f"{'':42}{'mu = 0.35':>22}{'mu = 0.60':>22}   expected")
    for what, left, right, expected, inside in bands(low, high):
        good = good and inside
        print(f"{what:42}{left:>22}{right:>22}   {expected}   {'ok' if inside else 'OUTSIDE'}")
    for at in TIMES:
        key = f"{at:g}"
        left, right = (f"{r.registration_mm[key]} mm, {r.lowest_hose_so_far_N[key]} N" for r in (low, high))
        print(f"{'  de-registration, lowest hose so far, ' + key + ' s':42}{left:>22}{right:>22}")
    print(f"{'  dissipated':42}{low.dissipated_J:>20} J{high.dissipated_J:>20} J")
    print(f"{'  steps, switches, solve time':42}{f'{low.steps}, {low.switches}, {low.solve_s} s':>22}"
          f"{f'{high.steps}, {high.switches}, {high.solve_s} s':>22}\n")  # fmt: skip
    return good


def markdown(r: Row) -> str:
    """The row of the page of tables: same columns as the independent engines, work in one column."""
    d, low = r.registration_mm, r.lowest_hose_so_far_N
    creep = "1e-4" if r.method == "binding" else "-"
    cells = [f"rodas, {r.method}, accuracy {r.accuracy:g}", r.elements, creep,
             *(f"{d[k]:.1f}" for k in ("1", "5", "8", "12", "20")), f"{r.registration_max_mm:.1f}",
             r.inboard_mean_N, f"{r.inboard_std_N:.0f}", f"{r.inboard_half_range_N:.0f}",
             low["1"], low["8"], low["20"], r.ruck_first_crossing_s or "never", r.ruck_first_dwell_s or "never",
             f"{r.dissipated_J:.0f}"]  # fmt: skip
    return "| " + " | ".join(map(str, cells)) + " |"


def main() -> None:
    """Both columns; with --spread over treatments, accuracies and meshes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spread", action="store_true", help="vary treatment, accuracy and mesh; write the data file")
    options = parser.parse_args()
    cases = [("binding", 1e-3, 60)]
    if options.spread:
        cases = [(m, a, n) for m in ("hold", "binding") for a in (1e-3, 1e-4) for n in (60, 120)]
    rows, good = [], True
    for case in cases:
        pair = [run(mu, *case) for mu in (0.35, 0.60)]
        good = show(*pair) and good
        rows += [asdict(r) for r in pair]
        if options.spread:
            DATA.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    if options.spread:
        for mu in (0.35, 0.60):
            print(f"\nmu = {mu}")
            print("\n".join(markdown(Row(**r)) for r in rows if r["mu"] == mu))
    raise SystemExit(0 if good else 1)


if __name__ == "__main__":
    main()
