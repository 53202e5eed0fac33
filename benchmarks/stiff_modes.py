"""What it brings `stepping` to take away the error of the midpoint rule, so that what is stiff for a step dies away.

    python benchmarks/stiff_modes.py          three minutes; prints the figures of docs/integrator.md

Solves and time of `single_bend` with exact hold over the number of its elements, 2 s; and the force of a motion that
is given to a drum with line on it, a cable through a bend into the sea, against `rodas` at accuracy 1e-6.
"""

from __future__ import annotations

from machine import machine, sentence  # first: it settles the number of threads before numpy is there

import numpy as np  # isort: skip

import fairlead
from fairlead.integrate import Run, integrate

THETAS = {"order three": 0.5, "midpoint rule alone": 0.5 + 1e-9}
ELEMENTS = (200, 800, 3200)
DRUM = """
schema: 1
name: drum
components:
  line: {type: Cable, length: 80 m, element: 0.25 m, start: -70 m, tension: 300 N, mass: 2 kg/m, stiffness: 200 kN,
         compression: carried, diameter: 40 mm}
  route:
    type: Route
    stations:
      - {name: winch, type: Winch, radius: 0.5 m, moment: 30 kg*m^2}
      - {name: bend, type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.3}
      - {name: sea, type: Sea, start: 7 m, speed: 3 m/s, tail: 300 N}
  drum:
    type: MotionSource
    velocity: {table: {t: [0 s, 0.5 s, 4 s, 4.5 s, 5 s, 5.5 s, 8 s], y: [0, 1, 1, 0, 0, -0.8, -0.8]}}
connections:
  - [line.path, route.path]
  - [drum.flange, route.winch.rim]
run: {stop: 8 s}
"""


def bend(elements: int, theta: float) -> str:
    """One line about the bend."""
    settings = {"element": f"{15.0 / elements!r} m", "friction.method": "hold", "run.accuracy": "3e-3"}
    system = fairlead.load("single_bend", set=settings).system
    outcome = integrate(system, Run(stop=2.0, every=0.1, engine="stepping", theta=theta))
    assert outcome.ok, outcome.sentence
    counted = outcome.counters
    return f"{counted.steps} steps, {counted.solves} solves, {counted.switches} switches, {outcome.loop_cpu:.2f} s"


def force(path: str, engine: str, accuracy: str, theta: float = 0.5) -> np.ndarray:
    """The force of the given motion, every millisecond."""
    system = fairlead.load(path, set={"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=8.0, every=1e-3, engine=engine, theta=theta, record=["drum.force"]))
    assert outcome.ok, outcome.sentence
    return outcome.values[outcome.sides == 0][:, 0]


def main() -> None:
    """Print all."""
    import tempfile

    print(sentence(machine()))
    for elements in ELEMENTS:
        for name, theta in THETAS.items():
            print(f"single_bend, {elements:4d} elements, {name}: {bend(elements, theta)}")
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(DRUM)
        file.flush()
        exact = force(file.name, "rodas", "1e-6")
        for accuracy in ("1e-3", "1e-4"):
            for name, theta in THETAS.items():
                off = force(file.name, "stepping", accuracy, theta) - exact
                print(f"force of the drum, accuracy {accuracy}, {name}: off by {off.std():.0f} N (rms), "
                      f"{np.abs(off).max():.0f} N at most, of {np.abs(exact).mean():.0f} N")  # fmt: skip


if __name__ == "__main__":
    main()
