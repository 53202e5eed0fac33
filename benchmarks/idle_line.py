"""What line costs that touches nothing: seconds of processor time per simulated second over the length of the line.

    python benchmarks/idle_line.py [--figure FILE]          six minutes; prints the table of docs/routes.md

The route is that of `long_deployment`, with modules of 25 m, paid out at 1 m/s; what is outside the devices lies on
the drum or in the sea. The time is that of the loop from 10 s to 22 s, with what it takes to leave out what is carried
and to take it back, and the least of three runs, since other programs on a machine only add to it.
"""

from __future__ import annotations

import argparse
import pathlib
from collections.abc import Iterator
from typing import NamedTuple

from machine import machine

import fairlead
from fairlead.integrate import Run, integrate, parts

MODULE = 25.0  # m
ROUTE = 14.0  # m from the drum to where the sea begins, and a little more
LENGTHS = (25, 50, 100, 200, 400)  # m
BEGIN, END = 10.0, 22.0  # s, when the line runs at 1 m/s
AS_ONE = {"route.stations[4].form": "rigid"}  # from 30 m on: a module and 5 m
RUNS = 3
KINDS = {
    "on the drum": (lambda length: (-length, ROUTE), False, {}),
    "on the drum, nothing left out": (lambda length: (-length, ROUTE), True, {}),
    "in the sea": (lambda length: (-25.0, ROUTE + length), False, {}),
    "in the sea, as one body": (lambda length: (-25.0, ROUTE + length), False, AS_ONE),
}


class Measured(NamedTuple):
    """One row."""

    kind: str
    idle: float  # m
    unknowns: int
    per_second: float  # s of processor time
    steps: float  # per simulated second


def measured() -> Iterator[Measured]:
    """All rows, after a run that is not counted."""
    loop_time("on the drum", LENGTHS[0], 1.0)
    for kind in KINDS:
        for length in LENGTHS:
            (before, first, _), (after, last, n) = (
                min(loop_time(kind, length, stop) for _ in range(RUNS)) for stop in (BEGIN, END)
            )
            span = END - BEGIN
            yield Measured(kind, length, n, (after - before) / span, (last - first) / span)


def loop_time(kind: str, idle: float, stop: float) -> tuple[float, int, int]:
    """Processor time of the loop to `stop`, steps, and how many unknowns the whole has."""
    ends, whole, more = KINDS[kind]
    inboard, outboard = ends(idle)
    length = outboard - inboard
    modules = max(round(length / MODULE), 1)
    given = {"line.length": f"{length} m", "line.start": f"{inboard} m", "line.modules": str(modules), **more}
    system = fairlead.load("long_deployment", set=given).system
    least = parts.LEAST
    parts.LEAST = 10**9 if whole else least
    try:
        outcome = integrate(system, Run(stop=stop, every=0.5, engine="stepping", record=["belts.force"]))
    finally:
        parts.LEAST = least
    assert outcome.ok, outcome.sentence
    return outcome.loop_cpu, outcome.counters.steps, system.n


def draw(rows: list[Measured], path: pathlib.Path) -> None:
    """Time over length, one curve a kind."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.0), layout="constrained")
    axes = figure.subplots()
    for kind, marker in zip(KINDS, "o^sd", strict=True):
        mine = [row for row in rows if row.kind == kind]
        axes.plot([row.idle for row in mine], [1e3 * row.per_second for row in mine], marker=marker, label=kind)
    axes.set(xlabel="line that touches nothing [m]", ylabel="processor time per simulated second [ms]", ylim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main() -> None:
    """Print the table, and draw it where a file is named."""
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--figure", type=pathlib.Path)
    figure = asked.parse_args().figure
    print(machine())
    print("| idle line | length | unknowns | steps per s | ms per simulated s |\n| --- | --- | --- | --- | --- |")
    rows = []
    for row in measured():
        rows.append(row)
        print(f"| {row.kind} | {row.idle:.0f} m | {row.unknowns} | {row.steps:.0f} | {1e3 * row.per_second:.1f} |",
              flush=True)  # fmt: skip
    if figure is not None:
        draw(rows, figure)


if __name__ == "__main__":
    main()
