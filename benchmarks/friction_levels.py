"""All conceivable friction levels: the whole route, deployed and hauled, at 20 frictions times 3 speeds of the ship.

    python benchmarks/friction_levels.py             runs what is missing in benchmarks/data, half a minute of CPU a run
    python benchmarks/friction_levels.py --table     table and figure of what is there: docs/friction_levels.md

The model is the bundled `guidance_route` on its own settings: electrohydraulic drives under sampled control. A finished
run is a line of the data file at once, so the script may be interrupted and started again at any time; a run that did
not reach its end is a line too, with the sentence in which it ended.
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

DATA = pathlib.Path(__file__).parent / "data" / "friction_levels.jsonl"
FRICTIONS = [round(0.05 * k, 2) for k in range(1, 21)]
SHIPS = [4.0, 2.0, 6.0]  # m/s; the usual one first
SPANS = {"deploying": (18.0, 24.9, +1), "hauling": (34.0, 44.0, -1)}
PLACES = {"winch": 1.0, "before": 4.2, "after": 7.2, "sea": 9.7}  # m along the route; the deployer is at 5 to 6.5 m
SEA, SPEED, TAIL, WINCH = 10.0, 0.5, 150.0, 200.0
DRAG = 0.5 * 1025.0 * 0.003 * math.pi * 0.085  # N/m at 1 m/s


def run(mu: float, ship: float) -> dict[str, Any]:
    """One run in the figures of the table."""
    import fairlead

    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = fairlead.load("guidance_route", set={"mu": str(mu), "ship": f"{ship} m/s"})
        begun = time.process_time()
        result = model.run(out=f"{folder}/run", check=False)
        cpu = time.process_time() - begun
        told = result.run
        row = {"mu": mu, "ship": ship, "status": result.status, "end": told["end_time"], "sentence": told["sentence"],
               "engine": told["engine"], "steps": told["steps"], "switches": told["switches"], "cpu_s": round(cpu, 1),
               "closure": told["energy"]["closure"]}  # fmt: skip
        return row | figures(result, mu, ship) | {"commit": commit()}


def figures(result: Any, mu: float, ship: float) -> dict[str, Any]:
    """Tensions and what they are compared with."""
    tension = sum(result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
    hose, core = (result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
    nodes = result.columns(result.match("line.hose_node[*].x"))
    inside = (nodes[:, 1:] < SEA) & (nodes[:, :-1] > 0.0)
    found: dict[str, Any] = {
        "lowest_hose_N": round(float(hose.min()), 1),
        "lowest_core_N": round(float(np.where(inside, core, np.inf).min()), 1),
        "peak_N": round(float(np.where(inside, tension, -np.inf).max()), 1),
        "paid_out_m": round(float(nodes[:, -1].max() - nodes[0, -1]), 2),
    }
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    for span, (begin, end, way) in SPANS.items():
        if result.t[-1] < end:
            continue
        rows = np.searchsorted(result.t, np.arange(begin, end, 0.05))
        means = np.mean([np.interp(list(PLACES.values()), middle[k], tension[k]) for k in rows], axis=0)
        length = nodes[rows, -1].mean() - SEA
        want = closed_form(mu, ship, way, length)
        found[span] = {place: round(float(mean), 1) for place, mean in zip(PLACES, means, strict=True)}
        found[f"{span}_error"] = round(float(np.max(np.abs(means / want - 1))), 4)
    return found


def closed_form(mu: float, ship: float, way: int, length: float) -> np.ndarray:
    """Tensions of steady sliding at the four places [N]; `way` is +1 while deploying, `length` what is in the sea."""
    sea = TAIL + DRAG * length * (ship - way * SPEED) ** 2
    return np.array([WINCH, WINCH * math.exp(way * mu * math.pi / 2), sea * math.exp(-way * mu * math.pi / 3), sea])


def kept() -> list[dict[str, Any]]:
    """The lines of the data file, the last of each pair counts."""
    if not DATA.exists():
        return []
    lines = [json.loads(line) for line in DATA.read_text(encoding="utf-8").splitlines() if line.strip()]
    return list({(line["mu"], line["ship"]): line for line in lines}.values())


def complete() -> None:
    """Run what is missing."""
    there = {(row["mu"], row["ship"]) for row in kept()}
    for ship in SHIPS:
        for mu in FRICTIONS:
            if (mu, ship) not in there:
                row = run(mu, ship)
                with DATA.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
                print(f"mu {mu:.2f}, ship {ship:g} m/s: {row['sentence']} {row['steps']} steps, {row['cpu_s']} s CPU",
                      flush=True)  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="write docs/friction_levels.md and its figure")
    if parser.parse_args().table:
        from friction_levels_page import write

        write(kept())
    else:
        complete()
