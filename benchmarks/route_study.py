"""How hard must the belts of the handling route be clamped? The study of docs/studies.md, beside its closed form.

    python -m benchmarks.route_study [--samples 64] [--out DIR] [--processes N]   a minute or two of two free cores

Runs models/route_study/sweep.yaml, which goes on where it stopped; prints the probability that a limit is broken and
the table by what the belts can bear over what the start takes; writes docs/figures/route_tornado.png and
route_failures.png.
"""

import argparse
import itertools
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas
from numpy.typing import NDArray

import fairlead
from fairlead.cases import Cases
from fairlead.studies.pictures.draw import draw
from fairlead.studies.pictures.rows import Rows
from fairlead.studies.sweeps.breach import breach
from fairlead.studies.sweeps.plan import read_plan
from fairlead.studies.sweeps.sweep import sweep

ROOT = Path(__file__).parents[1]
FILE, FIGURES = ROOT / "models" / "route_study" / "sweep.yaml", ROOT / "docs" / "figures"
BEND_A, BEND_B = np.pi / 2, np.pi / 3
BELTS, FRICTION = 1.5, 0.6  # m of belts, and their friction
TAIL = 150.0  # N at the end of the line
LINE, BEFORE = 5.8, 33.0  # kg/m; m of line before the belts at the start
WINCH = 1 / 0.65**2  # kg; its moment over its radius squared
RISE = 1.0  # s in which the speed is reached
CLASSES = (0.0, 0.8, 1.0, 1.5, 2.0, np.inf)


def margin(frame: pandas.DataFrame) -> NDArray:
    """What the belts can bear over what the start takes, for a line that slides in both bends as in a capstan.

    bears 2 mu_belt clamp L;  takes (T_winch + m v/t) exp(mu A) - T_tail exp(-mu B)
    """
    mu, inertia = frame["mu"], (LINE * BEFORE + WINCH) * frame["speed"] / RISE
    takes = (frame["back_tension"] + inertia) * np.exp(mu * BEND_A) - TAIL * np.exp(-mu * BEND_B)
    return (2 * FRICTION * BELTS * frame["clamp"] / takes).to_numpy()


def study(folder: Path, samples: int, processes: int | None = None) -> pandas.DataFrame:
    """The rows of the first cases of the study; its table is in the folder."""
    plan = read_plan(str(FILE))
    assert plan.design.sample is not None
    design = replace(plan.design, sample=replace(plan.design.sample, samples=samples))
    cases = Cases(fairlead.load(plan.model, set=plan.settings), plan.figures, max_steps=plan.max_steps)
    return sweep(cases, design, folder, processes=processes)[0].frame()


def pictures(folder: Path, into: Path) -> list[Path]:
    """Tornado and failure map of the slip, from the table in a folder."""
    with tempfile.TemporaryDirectory() as drawn:
        made = {file.stem: file.read_bytes() for file in draw(Rows.read(folder), "slip", Path(drawn))[0]}
    files = [into / f"route_{name}.png" for name in ("tornado", "failures")]
    for file in files:
        file.write_bytes(made[file.stem.removeprefix("route_")])
    return files


def main() -> None:
    """Run, print, draw."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--processes", type=int)
    parser.add_argument("--out", type=Path, default=Path("results") / "route_study")
    asked = parser.parse_args()
    frame = study(asked.out, asked.samples, asked.processes)
    found, broken = margin(frame), (frame["limits_broken"] > 0).to_numpy()
    print(breach(frame))
    print("| bears/takes | cases | a limit broken | largest slip: median [m/s] | smallest margin of the hose |")
    print("|---|---|---|---|---|")
    for low, high in itertools.pairwise(CLASSES):
        mine = (found >= low) & (found < high)
        words = f"{low:g} to {high:g}" if np.isfinite(high) else f"above {low:g}"
        slip, ruck = frame["slip"][mine].median(), frame["ruck"][mine].min()
        print(f"| {words} | {mine.sum()} | {(broken & mine).sum()} | {slip:.2f} | {ruck:.1f} |")
    for file in pictures(asked.out, FIGURES):
        print(f"wrote {file}")


if __name__ == "__main__":
    main()
