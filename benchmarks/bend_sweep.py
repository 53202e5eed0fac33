"""The single bend over friction, tension and treatment of friction (physics 7c).

    python benchmarks/bend_sweep.py            runs what is missing in benchmarks/data, some minutes of CPU
    python benchmarks/bend_sweep.py --table    the tables

For friction 0.20 to 0.70 of the hose on the bend and 400, 800, 1600 N outboard the bundled `single_bend` is hauled for
5 s with each treatment. Expected of all: the tension inboard over that outboard is exp(mu pi/2); the de-registration
jumps between 0.45 and 0.50, where the bulkheads cannot drag the hose along any more.
"""

from __future__ import annotations

import argparse
import json
import math
import pathlib
import tempfile
import warnings
from typing import Any

import numpy as np
from machine import commit

DATA = pathlib.Path(__file__).parent / "data" / "bend_sweep.jsonl"
FRICTIONS = [round(0.2 + 0.05 * k, 2) for k in range(11)]
TENSIONS = [800.0, 400.0, 1600.0]  # N
TREATMENTS: dict[str, dict[str, str]] = {
    "exact": {"method": "hold"},
    "robust": {"method": "binding"},
    "tanh": {"method": "tanh"},
    "LuGre": {"method": "lugre"},
    "literal": {"method": "binding", "friction.form": "literal"},
}
STOP, SINCE = 5.0, 3.0  # s; the ratio of tensions is a mean from here on
PATIENCE = "30 s"  # of wall time


def run(mu: float, tension: float, treatment: str) -> dict[str, Any]:
    """One run in the figures of the tables."""
    import fairlead

    settings = {"mu": str(mu), "line.tension": f"{tension} N", "tow.force": f"{tension} N", "run.stop": f"{STOP} s",
                "run.max_wall": PATIENCE, **TREATMENTS[treatment]}  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fairlead.load("single_bend", set=settings).run(out=f"{folder}/run")
        told = result.run
        row = {"mu": mu, "tension": tension, "treatment": treatment, "status": result.status, "end": told["end_time"],
               "sentence": told["sentence"], "steps": told["steps"], "switches": told["switches"],
               "solve_s": round(told["solve_time"], 2), "commit": commit()}  # fmt: skip
        return row | (figures(result, mu, tension) if result.status == "finished" else {})


def figures(result: Any, mu: float, tension: float) -> dict[str, float]:
    """Greatest de-registration, lowest hose tension, and the tension inboard over that of a string, less one."""
    t, force = result.t, -result["haul.force"]
    steady = t >= SINCE
    mean = np.trapezoid(force[steady], t[steady]) / (t[-1] - t[steady][0])
    return {
        "registration_mm": round(float(1e3 * np.abs(result.columns(result.match("line.registration[*].d"))).max()), 1),
        "lowest_hose_N": round(float(result.columns(result.match("line.hose[*].tension")).min()), 1),
        "excess": round(float(mean / (tension * math.exp(mu * math.pi / 2)) - 1), 4),
    }


def kept() -> dict[tuple[float, float, str], dict[str, Any]]:
    """Rows of the data file."""
    if not DATA.exists():
        return {}
    rows = [json.loads(line) for line in DATA.read_text(encoding="utf-8").splitlines() if line.strip()]
    return {(row["mu"], row["tension"], row["treatment"]): row for row in rows}


def complete() -> None:
    """Run what is missing."""
    for tension in TENSIONS:
        for treatment in TREATMENTS:
            for mu in FRICTIONS:
                if (mu, tension, treatment) not in kept():
                    row = run(mu, tension, treatment)
                    with DATA.open("a", encoding="utf-8") as file:
                        file.write(json.dumps(row) + "\n")
                    print(row["treatment"], mu, f"{tension:g} N", row["sentence"], flush=True)


def table(tension: float) -> str:
    """Greatest de-registration, excess of the ratio of tensions, steps, per treatment over friction."""
    found, treatments = kept(), list(TREATMENTS)
    lines = ["| friction | " + " | ".join(treatments) + " |", "| --- |" + " --- |" * len(treatments)]
    for mu in FRICTIONS:
        cells = [cell(found.get((mu, tension, treatment))) for treatment in treatments]
        lines.append(f"| {mu:.2f} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def cell(row: dict[str, Any] | None) -> str:
    """What is told of a run."""
    if row is None:
        return "not run"
    if row["status"] != "finished":
        return f"ended at {row['end']:.2g} s"
    return f"{row['registration_mm']:.1f} mm, {100 * row['excess']:+.1f} %, {row['steps']}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="print the tables")
    if not parser.parse_args().table:
        complete()
    for tension in sorted(TENSIONS):
        print(f"\n{tension:g} N outboard\n\n{table(tension)}")
