"""How far the estimate of `fairlead statics` for hose and core is from runs: routes at three frictions of their bends.

    python benchmarks/hose_estimates.py          five minutes; prints the table of docs/routes.md

The hose in steady motion where the estimate is farthest off (means over the second half of a stretch of steady speed),
and its lowest tension over the run beside that in the table of statics.
"""

from __future__ import annotations

import tempfile
import warnings
from typing import Any

from machine import machine

import fairlead
from fairlead.analysis.margins.quasi_static import against_statics

SCENES = {"single_bend": (0.2, 0.35, 0.6), "guidance_route_ideal": (0.2, 0.35, 0.6), "guidance_route": (0.35, 0.6),
          "long_route": (0.2, 0.3, 0.6)}  # fmt: skip
HEAD = ("scene", "mu", "hose in steady motion N", "statics N", "where", "lowest hose N", "statics N", "margin",
        "statics", "where")  # fmt: skip


def compared(name: str, mu: float) -> dict[str, Any]:
    """A run of a bundled route against statics."""
    model = fairlead.load(name, set={"mu": f"{mu:g}"})
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = model.run(out=f"{folder}/run")
        if result.status != "finished":
            raise SystemExit(f"{name}, mu {mu}: {result.run['sentence']}")
        return against_statics(model.flat, result)


def row(name: str, mu: float) -> list[str]:
    """One line of the table."""
    found = compared(name, mu)
    shared, lowest = found["shares"], found["lowest"]
    margins = [f"{one:.2g}" if one else "-" for one in (lowest["run_margin"], lowest["statics_margin"])]
    return [
        f"`{name}`", f"{mu:g}", f"{shared['hose']['run']:.0f}", f"{shared['hose']['statics']:.0f}",
        shared["where"], f"{lowest['run']:.0f}", f"{lowest['statics']:.0f}", *margins,
        f"{lowest['station'] or 'between stations'}, {lowest['t']:.3g} s",
    ]  # fmt: skip


def main() -> None:
    """Print the table."""
    print(machine())
    print(f"| {' | '.join(HEAD)} |\n|{' --- |' * len(HEAD)}")
    for name, frictions in SCENES.items():
        for mu in frictions:
            print(f"| {' | '.join(row(name, mu))} |", flush=True)


if __name__ == "__main__":
    main()
