"""The robustness list of the single bend (physics 7a) by the convex engine: one change at a time, 12 s each.

    nice -n 10 python benchmarks/bend_variants.py [--step 5e-4]

Writes `data/bend_variants.json` and prints one line per variant beside the number of the specification.
"""

import argparse
import json
from pathlib import Path

import convex_bend
from bend_scene import BendScene

DATA = Path(__file__).parent / "data" / "bend_variants.json"
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


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--step", type=float, default=5e-4, help="step length h [s]")
    step = parser.parse_args().step
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
