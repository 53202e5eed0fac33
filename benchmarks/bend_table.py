"""Fill `data/independent_bend.json`: the single bend by both independent engines at several accuracies.

    nice -n 10 python benchmarks/bend_table.py              # everything that is missing (about two hours)
    nice -n 10 python benchmarks/bend_table.py --print      # the table for docs/validation.md

Cases already in the file are skipped, so the run can be stopped at any time and taken up again.
"""

import argparse
import json
from pathlib import Path

import convex_bend
import independent_bend
from bend_scene import BendScene

DATA = Path(__file__).parent / "data" / "independent_bend.json"
MUS = (0.35, 0.60)
# (elements, creep, accuracy, law): scipy's accuracy is rtol, the convex engine's its step [s]
CONVEX = [(n, 1e-4, h, "line") for n in (60, 120) for h in (1e-3, 5e-4)]
CONVEX += [(60, 1e-4, h, "line") for h in (2.5e-4, 1.25e-4)]
CONVEX += [(60, creep, 2.5e-4, "line") for creep in (1e-5, 1e-6)]
SCIPY = [(60, 1e-4, 1e-5, "line"), (60, 1e-4, 1e-6, "line"), (120, 1e-4, 1e-5, "line")]
SCIPY += [(60, 1e-5, 1e-5, "line"), (60, 1e-4, 1e-5, "tanh"), (120, 1e-4, 1e-6, "line")]
SCIPY += [(60, 1e-4, 1e-7, "line")]
COLUMNS = (
    "registration_mm",
    "registration_max_mm",
    "inboard_mean_N",
    "inboard_ripple_std_N",
    "inboard_ripple_half_range_N",
    "lowest_hose_tension_so_far_N",
    "ruck_first_crossing_s",
    "ruck_first_dwell_s",
    "device_work_J",
    "bulkhead_work_J",
)


def cases() -> list[tuple[str, BendScene, float, str]]:
    """Engine, scene, accuracy and law of every case, cheap ones first."""
    planned = [("convex", case) for case in CONVEX] + [("scipy", case) for case in SCIPY]
    return [
        (engine, BendScene(mu=mu, creep=creep, elements=n), accuracy, law)
        for engine, (n, creep, accuracy, law) in planned
        for mu in MUS
    ]


def name(engine: str, scene: BendScene, accuracy: float, law: str) -> str:
    """Key of a case in the file."""
    return f"{engine} mu={scene.mu:g} n={scene.elements} creep={scene.creep:g} accuracy={accuracy:g} {law}"


def solve(engine: str, scene: BendScene, accuracy: float, law: str) -> dict:
    """One case."""
    if engine == "convex":
        return convex_bend.run(scene, accuracy)
    return independent_bend.run(scene, law, "Radau", accuracy, wall=10_000.0)


def stored() -> dict[str, dict]:
    """What the file holds so far."""
    return json.loads(DATA.read_text()) if DATA.exists() else {}


def fill() -> None:
    """Run what is missing and store each result as it comes."""
    for case in cases():
        key = name(*case)
        if key in stored():
            continue
        result = solve(*case)
        DATA.write_text(json.dumps({**stored(), key: result}, indent=1) + "\n")
        print(key, result["counters"], flush=True)


def show(mu: float) -> str:
    """Markdown table of all stored runs for one friction value."""
    runs = {key: run for key, run in stored().items() if run["scene"]["mu"] == mu}
    head = "| run | 1 s | 5 s | 8 s | 12 s | 20 s | max [mm] | T_in mean | std | half range [N] "
    head += "| lowest T_h [N] | first < -160 N [s] | dwell [s] | work guide | bulkheads [J] |"
    lines = [head, "|" + " --- |" * 15]
    lines += [
        f"| {key.replace(f' mu={mu:g}', '')} | " + _row(run["table"]) + " |" for key, run in runs.items()
    ]
    return "\n".join(lines)


def _row(table: dict) -> str:
    cells = []
    for column in COLUMNS:
        value = table[column]
        if column == "registration_mm":
            cells += [f"{v:.1f}" for v in value.values()]
        elif column == "lowest_hose_tension_so_far_N":
            cells.append(f"{value['20']:.1f}")
        else:
            cells.append("never" if value is None else f"{value:.1f}" if abs(value) < 1e3 else f"{value:.0f}")
    return " | ".join(cells)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--print", action="store_true", help="print the tables instead of running")
    if parser.parse_args().print:
        for mu in MUS:
            print(f"\nmu = {mu:g}\n\n{show(mu)}")
    else:
        fill()


if __name__ == "__main__":
    main()
