"""The single bend over friction, tension and treatment of friction.

    python benchmarks/bend_sweep.py            runs what is missing in benchmarks/data/bend_sweep.jsonl (198 runs of a
                                               second or so), then writes tables and figure into docs/bend_tables.md
    python benchmarks/bend_sweep.py --table    the tables and the figure only

For friction 0.20 to 0.70 of the hose on the bend and 400, 800, 1600 N outboard the bundled `single_bend` is hauled for
12 s with each treatment. Expected of all: the mean tension inboard over that outboard is exp(mu pi/2), and the
de-registration leaves its elastic level where the bulkheads cannot drag the hose along any more.
"""

from __future__ import annotations

import argparse
import json
import math
import pathlib
import tempfile
import time
import warnings
from typing import Any

import numpy as np
from machine import commit

DATA = pathlib.Path(__file__).parent / "data" / "bend_sweep.jsonl"
FRICTIONS = [round(0.2 + 0.05 * k, 2) for k in range(11)]
TENSIONS = [400.0, 800.0, 1600.0]  # N
TREATMENTS: dict[str, dict[str, str]] = {
    "exact": {"method": "hold"},
    "robust": {"method": "binding"},
    "tanh": {"method": "tanh"},
    "LuGre": {"method": "lugre"},
    "literal": {"method": "binding", "friction.form": "literal"},
    "literal, naive, h 0.1": {
        "method": "binding",
        "friction.form": "literal",
        "friction.applied_force": "naive",
        "friction.hysteresis": "0.1",
    },
}
STOP, SINCE = 12.0, 5.0  # s; the ratio of tensions is a mean from here on
RUCK = -160.0  # N, 2 % strain of a hose with EA = 8 kN
PATIENCE = "10 s"  # of wall time

Key = tuple[float, float, str]


def run(mu: float, tension: float, treatment: str, stop: float = STOP) -> dict[str, Any]:
    """One run in the figures of the tables."""
    import fairlead

    settings = {"mu": str(mu), "line.tension": f"{tension} N", "tow.force": f"{tension} N", "run.stop": f"{stop} s",
                "run.max_wall": PATIENCE, "line.ruck_force": "null", **TREATMENTS[treatment]}  # fmt: skip
    begun = time.process_time()
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fairlead.load("single_bend", set=settings).run(out=f"{folder}/run", check=False)
        told = result.run
        row = {"mu": mu, "tension": tension, "treatment": treatment, "status": result.status, "end": told["end_time"],
               "sentence": told["sentence"], "steps": told["steps"], "switches": told["switches"],
               "cpu_s": round(time.process_time() - begun, 2), "commit": commit()}  # fmt: skip
        return row | (figures(result, mu, tension) if result.status == "finished" else {})


def figures(result: Any, mu: float, tension: float) -> dict[str, float | None]:
    """Greatest de-registration, lowest hose tension, first ruck, and tension inboard over that of a string, less 1."""
    t, force = result.t, -result["haul.force"]
    steady = t >= min(SINCE, t[-1] / 2)
    mean = np.trapezoid(force[steady], t[steady]) / (t[-1] - t[steady][0])
    hose = result.columns(result.match("line.hose[*].tension")).min(axis=1)
    rucked = t[hose < RUCK]
    return {
        "registration_mm": round(float(1e3 * np.abs(result.columns(result.match("line.registration[*].d"))).max()), 1),
        "lowest_hose_N": round(float(hose.min()), 1),
        "ruck_s": round(float(rucked[0]), 2) if len(rucked) else None,
        "excess": round(float(mean / (tension * math.exp(mu * math.pi / 2)) - 1), 4),
    }


def kept() -> dict[Key, dict[str, Any]]:
    """Rows of the data file."""
    if not DATA.exists():
        return {}
    rows = [json.loads(line) for line in DATA.read_text(encoding="utf-8").splitlines() if line.strip()]
    return {(row["mu"], row["tension"], row["treatment"]): row for row in rows}


def complete() -> None:
    """Run what is missing."""
    found = kept()
    wanted = [(mu, tension, one) for tension in TENSIONS for one in TREATMENTS for mu in FRICTIONS]
    for mu, tension, one in wanted:
        if (mu, tension, one) not in found:
            row = run(mu, tension, one)
            with DATA.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
            print(one, mu, f"{tension:g} N", row["sentence"], flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="write tables and figure from what is there")
    if not parser.parse_args().table:
        complete()
    from bend_sweep_page import write

    write(kept())
