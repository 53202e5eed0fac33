"""The robustness list of the single bend (physics 7a): one change at a time, 12 s each.

    nice -n 10 python benchmarks/bend_variants.py [--step 5e-4]    by the convex engine; data/bend_variants.json
    nice -n 10 python benchmarks/bend_variants.py --radau          the first second by scipy's Radau; ..._begin.json
    python benchmarks/bend_variants.py --fairlead                  by fairlead; data/bend_variants_fairlead.json

Writes the data file and prints one line per variant beside the number of the specification; of fairlead in the
columns of docs/bend_tables.md.
"""

import argparse
import json
import tempfile
from pathlib import Path
from typing import Any

import convex_bend
import numpy as np
from bend_scene import BendScene

DATA = Path(__file__).parent / "data" / "bend_variants.json"
BEGIN = Path(__file__).parent / "data" / "bend_variants_begin.json"
BY_FAIRLEAD = Path(__file__).parent / "data" / "bend_variants_fairlead.json"
METHODS = ("hold", "binding")
# What is changed against mu = 0.60, and the published greatest de-registration [mm] at 12 s
VARIANTS: dict[str, tuple[dict[str, float], float]] = {
    "element 0.125 m": ({"elements": 120}, 185.0),
    "creep 1e-5": ({"creep": 1e-5}, 177.0),
    "creep 1e-3": ({"creep": 1e-3}, 166.0),
    "creep 1e-3, mu 0.35": ({"creep": 1e-3, "mu": 0.35}, 8.0),
    "EA_h 25 kN": ({"hose_stiffness": 25e3}, 56.0),
    "bulkhead friction constant 0.5": ({"bulkhead_coulomb": 0.5}, 92.0),
    "T_out 200 N": ({"outboard": 200.0}, 46.0),
    # The line must lie inboard of the bend to be paid out through it; where it starts was not specified.
    "deployment from -4.5 m": ({"speed": 0.3, "first": -4.5}, 76.0),
    "mu 0.25": ({"mu": 0.25}, 5.0),
    "mu 0.40": ({"mu": 0.40}, 6.0),
    "mu 0.45": ({"mu": 0.45}, 23.0),
    "mu 0.50": ({"mu": 0.50}, 82.0),
    "mu 0.49, bulkhead constant 0.5": ({"mu": 0.49, "bulkhead_coulomb": 0.5}, 7.1),
    "mu 0.50, bulkhead constant 0.5": ({"mu": 0.50, "bulkhead_coulomb": 0.5}, 9.1),
    "mu 0.51, bulkhead constant 0.5": ({"mu": 0.51, "bulkhead_coulomb": 0.5}, 12.7),
}


def settings(change: dict[str, float]) -> dict[str, str]:
    """A change as `--set` of the bundled single_bend takes it."""
    given = {"mu": "0.6"}
    for name, value in change.items():
        given |= {
            "mu": {"mu": f"{value}"},
            "elements": {"element": f"{15 / value} m"},
            "creep": {"creep": f"{value} m/s"},
            "hose_stiffness": {"line.hose.stiffness": f"{value} N"},
            "bulkhead_coulomb": {"line.bulkhead_friction.coulomb": f"{value}"},
            "outboard": {"tow.force": f"{value} N", "line.tension": f"{value} N"},
            "speed": {"haul.velocity.ramp.to": f"{value} m/s"},
            "first": {"line.start": f"{value} m"},
        }[name]
    return given


def by_fairlead(change: dict[str, float], method: str, stop: float, out: Path) -> Any:
    """The result of a variant, in a new folder `out`. Raises SystemExit when it does not finish."""
    import fairlead

    given = {**settings(change), "line.ruck_force": "null", "method": method, "run.stop": f"{stop} s"}
    result = fairlead.load("single_bend", set=given).run(out=out, check=False)
    if result.status != "finished":
        raise SystemExit(result.run["sentence"])
    return result


def figures(result: Any) -> dict[str, Any]:
    """De-registration at 1 s and the greatest [mm], lowest hose tension [N], first below -160 N [s]."""
    from single_bend import RUCK

    apart = 1e3 * np.abs(result.columns(result.match("line.registration[*].d"))).max(axis=1)
    lowest = result.columns(result.match("line.hose[*].tension")).min(axis=1)
    below = result.t[lowest < RUCK]
    return {
        "registration_1s_mm": round(float(np.interp(1.0, result.t, apart)), 2),
        "registration_max_mm": round(float(apart.max()), 2), "lowest_hose_N": round(float(lowest.min()), 1),
        "ruck_first_crossing_s": round(float(below[0]), 2) if len(below) else None,
    }  # fmt: skip


def kept(path: Path) -> dict[str, Any]:
    """What a data file holds."""
    return json.loads(path.read_text(encoding="utf-8"))


def row(label: str, found: dict[str, Any]) -> str:
    """The row of docs/bend_tables.md: specification, Radau, convex engine, fairlead with both treatments."""
    convex, radau = kept(DATA)[label], kept(BEGIN)[label]
    table = convex["table"]
    cells = [label, f"{convex['published_mm']:g}", f"{radau['registration_mm']:.1f}"]
    cells.append(f"{table['registration_mm']['1']:.1f}; {table['registration_max_mm']:.1f}, "
                 f"{table['lowest_hose_tension_so_far_N']['12']:.0f} N")  # fmt: skip
    for method in METHODS:
        one = found.get(method)
        cells.append("-" if one is None else f"{one['registration_1s_mm']:.1f}; {one['registration_max_mm']:.1f}, "
                     f"{one['lowest_hose_N']:.0f} N")  # fmt: skip
    crossed = [table["ruck_first_crossing_s"], *(found[m]["ruck_first_crossing_s"] for m in METHODS if m in found)]
    cells.append(", ".join("-" if each is None else f"{each:.1f}" for each in crossed))
    return "| " + " | ".join(cells) + " |"


def run_fairlead() -> None:
    """All variants by fairlead; creep is a parameter of binding alone."""
    found: dict[str, Any] = {}
    for label, (change, _) in VARIANTS.items():
        found[label] = {}
        for method in ("binding",) if "creep" in change else METHODS:
            with tempfile.TemporaryDirectory() as folder:
                found[label][method] = figures(by_fairlead(change, method, 12.0, Path(folder) / "run"))
        print(row(label, found[label]), flush=True)
    BY_FAIRLEAD.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


def run_radau(rtol: float = 1e-6, wall: float = 600.0) -> None:
    """The first second of all variants, the equations of `bend_equations.py` by scipy's Radau."""
    from bend_equations import Bend
    from bend_scene import table
    from independent_bend import integrate

    found = {}
    for label, (change, _) in VARIANTS.items():
        scene = BendScene(**{"mu": 0.60, "stop": 1.0, **change})
        record, count = integrate(Bend(scene, "line"), "Radau", rtol, 0.01, wall)
        told = table(scene, record)
        found[label] = {"registration_mm": told["registration_mm"]["1"],
                        "lowest_hose_tension_N": told["lowest_hose_tension_N"]["1"], "rtol": rtol,
                        "steps": count["steps"], "wall_s": count["wall_s"]}  # fmt: skip
        print(label, found[label], flush=True)
    BEGIN.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--step", type=float, default=5e-4, help="step length h [s]")
    parser.add_argument("--fairlead", action="store_true", help="by fairlead instead")
    parser.add_argument("--radau", action="store_true", help="the first second by scipy's Radau instead")
    options = parser.parse_args()
    if options.radau:
        run_radau()
        return
    if options.fairlead:
        run_fairlead()
        return
    step = options.step
    found = {}
    for label, (change, published) in VARIANTS.items():
        result = convex_bend.run(BendScene(**{"mu": 0.60, "stop": 12.0, **change}), step)
        found[label] = {"published_mm": published, "step": step, "change": change, "table": result["table"]}
        table = result["table"]
        low = table["lowest_hose_tension_so_far_N"]["12"]
        print(
            f"{label:34} published {published:6.1f}  found {table['registration_max_mm']:7.2f} mm  "
            f"lowest {low:8.1f} N  ruck {table['ruck_first_crossing_s']}",
            flush=True,
        )
    DATA.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
