"""What stiction above sliding friction costs in rows of blocks that a slow drive pulls, beside equal levels.

    python benchmarks/stiction_rows.py [--blocks 100 --blocks 300] [--accuracy 1e-4] [--engine stepping]

The rod of `hundred_blocks` (10 kg, 1000 N, friction 50 N, guides that differ by 30 %), pulled through a spring at
10 mm/s for 3 s. Printed are CPU of the loop, counts, and the largest error of a position over time against `rodas` at
a tenth of the accuracy, in the largest position of the row.
"""

from __future__ import annotations

import argparse
import math
import pathlib
import tempfile
import warnings
from typing import Any

import machine  # noqa: F401  # first: it settles the number of threads before numpy is there
import numpy as np
from outcomes import watched

import fairlead

LEVELS = (1.0, 1.3)


def netlist(blocks: int, level: float, speed: float, stop: float) -> str:
    """The scene."""
    k = 1000.0 * blocks
    lines = ["schema: 1", "name: stiction_row", "components:", "  ground: {type: Ground}"]
    joins = []
    for i in range(blocks):
        normal = 50.0 / blocks * (1 + 0.3 * math.sin(1.7 * i + 0.3))
        curve = f"{{curve: coulomb, stiction: {level}, coulomb: 1.0}}"
        lines += [f"  b{i}: {{type: Mass, mass: {10.0 / blocks} kg}}",
                  f"  g{i}: {{type: Contact, normal_force: {normal} N, curve: {curve}}}"]  # fmt: skip
        joins += [f"  - [b{i}.flange, g{i}.b]", f"  - [ground.flange, g{i}.a]"]
        if i:
            lines.append(f"  s{i}: {{type: SpringDamper, stiffness: {k} N/m, damping: {0.002 * k} N*s/m}}")
            joins += [f"  - [b{i - 1}.flange, s{i}.a]", f"  - [b{i}.flange, s{i}.b]"]
    lines += ["  hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}",
              f"  hand: {{type: MotionSource, velocity: {speed} m/s}}", "connections:", *joins,
              f"  - [b{blocks - 1}.flange, hook.a]", "  - [hook.b, hand.flange]",
              f"run: {{stop: {stop} s}}", "record: {every: 20 ms, signals: ['b*.x']}"]  # fmt: skip
    return "\n".join(lines) + "\n"


def run(path: pathlib.Path, engine: str, accuracy: float) -> tuple[np.ndarray, Any]:
    """Positions on the grid, and the outcome of the engine."""
    with warnings.catch_warnings(), watched() as kept:
        warnings.simplefilter("ignore")
        model = fairlead.load(str(path), set={"run.engine": engine, "run.accuracy": str(accuracy)})
        result = model.run(out=None)
    times = np.arange(0.0, kept[-1].t, 0.02)
    return np.stack([result.at(name, times) for name in result.match("b*.x")]), kept[-1]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blocks", type=int, action="append")
    parser.add_argument("--accuracy", type=float, action="append")
    parser.add_argument("--engine", action="append")
    parser.add_argument("--speed", type=float, default=0.01)
    parser.add_argument("--stop", type=float, default=3.0)
    given = parser.parse_args()
    print("| blocks | levels | engine | accuracy | CPU | steps | rejected | switches | rhs | factorisations | error |")
    print("|" + 11 * " --- |")
    for blocks in given.blocks or (100, 300, 1000):
        for level in LEVELS:
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "row.yaml"
                path.write_text(netlist(blocks, level, given.speed, given.stop), encoding="utf-8")
                exact, _ = run(path, "rodas", 0.1 * min(given.accuracy or (1e-4,)))
                for engine in given.engine or ("stepping", "rodas"):
                    for accuracy in given.accuracy or (1e-4,):
                        found, outcome = run(path, engine, accuracy)
                        c, many = outcome.counters, min(found.shape[1], exact.shape[1])
                        off = np.abs(found[:, :many] - exact[:, :many]).max() / np.abs(exact).max()
                        cells = (blocks, f"{level:g}", engine, f"{accuracy:g}", f"{outcome.loop_cpu:.3g} s", c.steps,
                                 c.rejected, c.switches, c.rhs, c.factorisations, f"{off:.1e}")  # fmt: skip
                        print(f"| {' | '.join(map(str, cells))} |", flush=True)


if __name__ == "__main__":
    main()
