"""What the line search of `stepping` is worth: scenes in which a full Newton move goes astray, without and with it.

    python benchmarks/line_search.py             two minutes; prints the table of docs/integrator.md
    python benchmarks/line_search.py --plain     without the search alone (compiles the engine anew, without it)

    blocks     ten blocks on a shaken table, each on a contact, one linked to the next, the last pulled to and fro
    oil        a piston moved to and fro drives oil through two sharp edges and a relief valve that cracks

Each with fixed steps of 5, 20 and 50 ms, and with error control at accuracy 1e-3, for 2 s. `ended`: runs that did not
reach their end; `again`: steps repeated with half their length as they did not converge; `solves` with the factors.
"""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from typing import NamedTuple

LIBRARY = str(pathlib.Path(__file__).with_name("stiffening_library.py"))
BLOCKS, STOP, MOST_STEPS = 10, 2.0, 20000
STEPS = (5e-3, 2e-2, 5e-2)
LINKS = {
    "spring": "Spring, stiffness: 400 N/m",
    "cubic spring": "CubicSpring, stiffness: 50 N/m, doubling: 2 mm",
    "stranded rope": "StrandedRope, force: 1 N, scale: 1 mm",
    "cross cord": "CrossCord, tension: 1 N, stiffness: 1e5 N, length: 0.1 m",
    "tether": "Tether, stiffness: 2e4 N/m, length: 1 mm",
}
SMOOTH = ("tanh", "arctan", "root")
OIL = """
schema: 1
name: oil
description: A piston pushes oil to and fro through sharp edges.
components:
  floor: {{type: Ground}}
  hand: {{type: MotionSource, position: {{sine: {{amplitude: 50 mm, frequency: 1 Hz, offset: 0.15 m}}}}}}
  drag: {{type: Spring, stiffness: 1 MN/m}}
  rod: {{type: Mass, mass: 20 kg, position: 0.15 m}}
  ram: {{type: Chamber, area: 20 cm^2, stroke: 0.3 m, dead_volume: 0.1 L, pressure: 120 bar}}
  relief: {{type: ReliefValve, setting: 30 bar, slope: 1e-9 m^3/s/Pa, lag: 1 ms}}
  near: {{type: Orifice, area: 5 mm^2, critical_pressure: {critical} Pa}}
  far: {{type: Orifice, area: 5 mm^2, critical_pressure: {critical} Pa}}
  between: {{type: Volume, volume: 10 cm^3, pressure: 120 bar}}
  return: {{type: PressureSource, pressure: 120 bar}}
connections:
  - [floor.flange, ram.body]
  - [hand.flange, drag.a]
  - [drag.b, rod.flange, ram.rod]
  - [ram.port, near.a, relief.a]
  - [near.b, between.port, far.a]
  - [far.b, relief.b, return.port]
run: {{stop: 2 s, accuracy: 1e-3}}
"""


class Cost(NamedTuple):
    """What a run, or several, took."""

    ended: int
    steps: int
    again: int
    solves: int
    cpu: float


def main() -> None:
    if "--plain" in sys.argv:
        without_search()
    found = {kind: list(costs) for kind, costs in measured()}
    if "--plain" in sys.argv or "--raw" in sys.argv:
        for kind, costs in found.items():
            for cost in costs:
                print(kind, *cost, sep="\t")
        return
    with tempfile.TemporaryDirectory() as cache:
        command = [sys.executable, __file__, "--plain"]
        plain = subprocess.run(command, env={**os.environ, "FAIRLEAD_CACHE": cache}, text=True, check=True, stdout=-1)
    before: dict[str, list[Cost]] = {}
    for line in plain.stdout.splitlines():
        kind, *numbers, cpu = line.split("\t")
        before.setdefault(kind, []).append(Cost(*map(int, numbers), float(cpu)))
    print("| scenes | step | ended | steps | again | solves | CPU time |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    names = [f"{1e3 * h:g} ms" for h in STEPS] + ["by error"]
    for kind, costs in found.items():
        for name, old, new in zip(names, before[kind], costs, strict=True):
            pairs = [f"{a} -> {b}" for a, b in zip(old[:-1], new[:-1], strict=True)]
            times = f"{1e3 * old.cpu:.3g} -> {1e3 * new.cpu:.3g} ms"
            print(f"| {kind} | {name} | {' | '.join([*pairs, times])} |", flush=True)


def without_search() -> None:
    """Have the engine compiled with a search that takes no move back, as where friction falls; its cache is its own."""
    import fairlead.integrate.stepping.residual as line_search

    line_search.FALLING = float("-inf")


def measured() -> Iterator[tuple[str, list[Cost]]]:
    """Each kind of scenes, and the sums over them for each way to choose the step."""
    for kind, texts in scenes().items():
        costs = []
        for step in (*STEPS, None):
            runs = [cost_of(text, step) for text in texts]
            costs.append(Cost(*(sum(column) for column in zip(*runs, strict=True))))
        yield kind, costs


def cost_of(text: str, step: float | None) -> Cost:
    """One scene, with a fixed step or with error control."""
    import fairlead
    from fairlead.integrate import Run, integrate

    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scene.yaml")
        path.write_text(text, encoding="utf-8")
        system = fairlead.load(path, libraries=[LIBRARY]).system
    run = Run(stop=STOP, every=0.01, engine="stepping", fixed_step=step, max_steps=MOST_STEPS)
    outcome = integrate(system, run)
    counts = outcome.counters
    return Cost(0 if outcome.ok else 1, counts.steps, counts.unsolved, counts.solves, outcome.loop_cpu)


def scenes() -> dict[str, list[str]]:
    """Netlists by kind."""
    creep = "creep: 1e-5 m/s"
    linear, cubic = LINKS["spring"], LINKS["cubic spring"]
    return {
        "blocks, tanh, arctan and root": [blocks(k, f"method: {m}, {creep}") for m in SMOOTH for k in (linear, cubic)],
        "blocks, lugre": [blocks(k, "method: lugre") for k in (linear, cubic)],
        "blocks, hold, five links": [blocks(k, "method: hold") for k in LINKS.values()],
        "oil, edges sharp below 1e5, 1e2 and 0.1 Pa": [OIL.format(critical=c) for c in (1e5, 1e2, 0.1)],
    }


def blocks(link: str, friction: str) -> str:
    """The netlist of the row of blocks."""
    parts = ["  table: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.5 Hz}}}",
             "  hand: {type: ForceSource, force: {sine: {amplitude: 20 N, frequency: 0.8 Hz}}}"]  # fmt: skip
    wires = [f"[hand.flange, block{BLOCKS - 1}.flange]"]
    for k in range(BLOCKS):
        curve = f"{{curve: stribeck, stiction: {0.3 + 0.03 * k:g}, coulomb: {0.2 + 0.03 * k:g}, velocity: 5 mm/s}}"
        parts.append(f"  block{k}: {{type: Mass, mass: {1 + 0.07 * k:g} kg}}")
        parts.append(f"  pad{k}: {{type: Contact, normal_force: 10 N, curve: {curve}}}")
        wires.append(f"[table.flange, pad{k}.a], [pad{k}.b, block{k}.flange]")
        if k:
            parts.append(f"  link{k}: {{type: {link}}}")
            wires.append(f"[block{k - 1}.flange, link{k}.a], [link{k}.b, block{k}.flange]")
    head = f"schema: 1\nname: blocks\nfriction: {{{friction}}}\nrun: {{stop: {STOP} s, accuracy: 1e-3}}\ncomponents:\n"
    return head + "\n".join(parts) + f"\nconnections: [{', '.join(wires)}]\n"


if __name__ == "__main__":
    main()
