"""Fill `data/independent_bend.json`: the single bend by both independent engines at several accuracies.

    nice -n 10 python benchmarks/bend_table.py              # everything that is missing (about two hours)
    nice -n 10 python benchmarks/bend_table.py --print      # the table for docs/bend_tables.md

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
BY_PLACE = "by place"  # see BendScene.by_place
# (elements, creep, accuracy, law): scipy's accuracy is rtol, the convex engine's its step [s]
CONVEX = [(n, 1e-4, h, "line") for n in (60, 120) for h in (1e-3, 5e-4)]
CONVEX += [(60, 1e-4, h, "line") for h in (2.5e-4, 1.25e-4)]
CONVEX += [(60, creep, 2.5e-4, "line") for creep in (1e-5, 1e-6)]
CONVEX += [(n, 1e-4, 5e-4, BY_PLACE) for n in (60, 120)]
SCIPY = [(60, 1e-4, 1e-5, "line"), (60, 1e-4, 1e-6, "line"), (120, 1e-4, 1e-5, "line")]
SCIPY += [(60, 1e-5, 1e-5, "line"), (60, 1e-4, 1e-5, "tanh"), (120, 1e-4, 1e-6, "line")]
SCIPY += [(60, 1e-4, 1e-7, "line")]
HEADER = (
    "engine", "n", "v_c [m/s]", "d at 1 s", "5 s", "8 s", "12 s", "20 s", "greatest [mm]", "mean T_in", "std",
    "half range [N]", "lowest T_h to 1 s", "8 s", "20 s [N]", "below -160 N [s]", "for 0.1 s [s]",
    "guide [J]", "bulkheads [J]",
)  # fmt: skip


def cases() -> list[tuple[str, BendScene, float, str]]:
    """Engine, scene, accuracy and law of every case, cheap ones first."""
    planned = [("convex", case) for case in CONVEX] + [("scipy", case) for case in SCIPY]
    return [
        (engine, BendScene(mu=mu, creep=creep, elements=n, by_place=law == BY_PLACE), accuracy, law)
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
    """Markdown table of all stored runs for one friction value: convex first, then by mesh and accuracy."""
    runs = [run for run in stored().values() if run["scene"]["mu"] == mu]
    runs.sort(key=lambda run: ("rtol" in run, run["scene"]["elements"], -_accuracy(run), -run["scene"]["creep"]))
    lines = [HEADER, ["---"] * len(HEADER), *(_cells(run) for run in runs)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _accuracy(run: dict) -> float:
    return run["rtol"] if "rtol" in run else run["step"]


def _cells(run: dict) -> list[str]:
    """One line of the table, as text."""
    t, scene = run["table"], run["scene"]
    engine = f"scipy Radau, rtol {run['rtol']:g}" if "rtol" in run else f"convex, h = {1e3 * run['step']:g} ms"
    low = t["lowest_hose_tension_so_far_N"]
    numbers = [*t["registration_mm"].values(), t["registration_max_mm"], t["inboard_mean_N"]]
    ripple = [f"{t[f'inboard_ripple_{kind}_N']:.0f}" for kind in ("std", "half_range")]
    ruck = [t["ruck_first_crossing_s"], t["ruck_first_dwell_s"]]
    return [
        engine + (", tanh" if run["law"] == "tanh" else "") + (", by place" if scene.get("by_place") else ""),
        f"{scene['elements']}",
        f"{scene['creep']:g}",
        *(f"{value:.1f}" for value in numbers),
        *ripple,
        *(f"{low[instant]:.1f}" for instant in ("1", "8", "20")),
        *("never" if value is None else f"{value:.1f}" for value in ruck),
        f"{t['device_work_J']:.0f}",
        f"{t['bulkhead_work_J']:.1f}",
    ]


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
