"""The error of steps of one length, over their length: the table of docs/real_time.md.

    python benchmarks/real_time.py            a minute; prints the table

The error is the largest difference from `rodas` at accuracy 1e-8, over all times and named signals, each over its
largest value. Overruns are steps that met the bound on their work, or were taken again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

import fairlead

STEPS = ("10 ms", "1 ms", "0.1 ms")
MODELS: Mapping[str, tuple[str, Mapping[str, str]]] = {
    "belt": ("block.x", {"run.stop": "10 s"}),
    "block_and_spring": ("block.x", {}),
    "block_and_spring, hold": ("block.x", {"method": "hold"}),
    "winch_drive": ("line.v", {}),
    "hundred_blocks": ("rod.block[*].x", {}),
    "capstan": ("rope.node[*].x", {}),
}
"""By model, and what was changed of it: signals that are compared, and settings."""
GRID = 0.01
"""s, of the times at which they are compared."""


def main() -> None:
    """Print the table."""
    print("| model | signals | step | error | overruns | steps |\n|---|---|---|---|---|---|")
    for name in MODELS:
        for row in rows(name):
            print("| " + " | ".join(row) + " |", flush=True)


def rows(name: str) -> Iterator[list[str]]:
    """The rows of a model."""
    signals, settings = MODELS[name]
    model = fairlead.load(name.partition(",")[0], {**settings, "record.every": f"{GRID} s"})
    exact = model.run(out=None, engine="rodas", accuracy=1e-8)
    for step in STEPS:
        made = model.run(out=None, real_time=step)
        kept = made.run["real_time"]
        yield [name, signals, step, f"{error(made, exact, signals):.1e}", str(kept["overruns"]), str(kept["steps"])]


def error(made: fairlead.Result, exact: fairlead.Result, signals: str) -> float:
    """The largest, over its largest value, at the times of the grid."""
    times, worst = exact.t[0] + np.arange(round((exact.t[-1] - exact.t[0]) / GRID) + 1) * GRID, 0.0
    for name in exact.chosen(signals):
        shown = exact.at(name, times)
        worst = max(worst, float(np.abs(made.at(name, times) - shown).max() / np.abs(shown).max()))
    return worst


if __name__ == "__main__":
    main()
