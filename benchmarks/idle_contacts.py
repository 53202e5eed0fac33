"""What idle contacts cost: a thousand of which ten are at work, beside the ten alone.

    python benchmarks/idle_contacts.py           two minutes; prints the table of docs/effects.md

    standing   a rod on guides, pulled to and fro so that the last ten blocks slip: of 20 blocks and of 1000
    off        1000 blocks that all swing, the last ten on guides: without and with 990 guides that touch nothing

Every pair makes the same motion. CPU time of the loop (`timed_run`), and what one step takes.
"""

from __future__ import annotations

import pathlib
import tempfile
from collections.abc import Iterator

import fairlead
from fairlead.analysis.cost.timed_run import Timed, timed_run

LIBRARY = str(pathlib.Path(__file__).with_name("idle_library.py"))
ACCURACY, CAP = "1e-4", 600.0
REST = """
schema: 1
name: idle
description: Ten contacts at work, the others idle.
components:
  rod: {ROD}
  hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}
  hand: {type: MotionSource, position: {sine: {amplitude: 2.7 mm, frequency: 1 Hz}}}
connections:
  - [rod.end, hook.a]
  - [hook.b, hand.flange]
friction: {method: METHOD}
run: {stop: STOP s}
record: {signals: [hook.tension]}
"""
STANDING = "type: RodOnGuides, blocks: N, mass: M kg, axial_stiffness: K N, damping_time: 0.002 s, friction: F N"
LIFTED = (
    "type: LiftedRow, blocks: 1000, guides: N, mass: 0.1 kg, stiffness: 1e6 N/m, damping: 2e3 N*s/m, "
    "normal_force: 0.5 N"
)
SCENES = {"standing": (20, 1000, 30), "off": (10, 1000, 1)}  # contacts in the two scenes of a pair; s


def main() -> None:
    print("| idle contacts | treatment | engine | contacts | steps | CPU time | a step | over that of the few |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for kind, method, engine in (
        ("standing", "hold", "rodas"), ("standing", "hold", "stepping"), ("off", "binding", "rodas"),
        ("off", "hold", "rodas"), ("off", "hold", "stepping"),
    ):  # fmt: skip
        few = 0.0
        for number, timed in pair(kind, method, engine):
            step = timed.cpu / timed.steps
            few = few or step
            print(f"| {kind} | {method} | {engine} | {number} | {timed.steps} | {1e3 * timed.cpu:.3g} ms "
                  f"| {1e6 * step:.3g} us | {step / few:.2g} |", flush=True)  # fmt: skip


def pair(kind: str, method: str, engine: str) -> Iterator[tuple[int, Timed]]:
    """The runs with few contacts and with all of them."""
    *numbers, stop = SCENES[kind]
    for number in numbers:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "idle.yaml"
            path.write_text(scene(kind, method, number, stop), encoding="utf-8")
            settings = {"run.engine": engine, "run.accuracy": ACCURACY}
            yield number, timed_run(lambda more, path=path: fairlead.load(str(path), set=more, libraries=[LIBRARY]),
                                    settings, ["hook.tension"], (0.0, float(stop)), CAP)  # fmt: skip


def scene(kind: str, method: str, number: int, stop: int) -> str:
    rod = STANDING if kind == "standing" else LIFTED
    for word, value in (("N,", f"{number},"), ("M kg", f"{0.1 * number} kg"), ("K N", f"{1e6 / number} N"),
                        ("F N", f"{0.5 * number} N")):  # fmt: skip
        rod = rod.replace(f" {word}", f" {value}") if word != "N," else rod.replace(": N,", f": {value}")
    return REST.replace("ROD", rod).replace("METHOD", method).replace("STOP", str(stop))


if __name__ == "__main__":
    main()
