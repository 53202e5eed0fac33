"""Bodies on a plate that moves as given, and feet without inertia: they leave it and land on it again."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from tests.hard.play import Play
from tests.hard.registry import NO_FRICTION, case
from tests.reference.thrown import G, flights, hops

LOCATING = ("rodas", "rodas3p", "ida")
"""`stepping` refuses rigid stops by name."""

PLATE = f"""
components:
  weight: {{type: ForceSource, force: {-G} N}}
  body: {{type: Mass, mass: 1 kg}}
  rest: {{type: RigidStop}}
  plate: {{type: MotionSource, velocity: {{sine: {{amplitude: @V@ m/s, frequency: @F@ Hz}}}}}}
connections: [[plate.flange, rest.a], [rest.b, body.flange, weight.flange]]
initial: {{body.x: 0 m}}
run: {{stop: @STOP@ s, accuracy: 1e-6}}
record: {{every: 1 ms}}
"""

FOOT = f"""
components:
  weight: {{type: ForceSource, force: {-G} N}}
  body: {{type: Mass, mass: 1 kg}}
  leg: {{type: SpringDamper, stiffness: 5000 N/m, damping: 20 N*s/m}}
  rest: {{type: RigidStop}}
  lower: @LOWER@
connections: [[lower.flange, rest.a], [rest.b, leg.a], [leg.b, body.flange, weight.flange]]
initial: {{body.x: 0.1 m, leg.a.x: 0.1 m}}
run: {{stop: 0.8 s, accuracy: 1e-6}}
record: {{every: 1 ms}}
"""
SHAKER = "{type: MotionSource, velocity: {sine: {amplitude: 1 m/s, frequency: 2 Hz}}}"


@case({"2 Hz": {"v": 1.0, "f": 2.0}, "8 Hz": {"v": 0.35, "f": 8.0}}, engines=LOCATING, treatments=NO_FRICTION)
def body_that_a_shaking_plate_throws(play: Play, v: float, f: float) -> None:
    """A body lies on a plate that moves as given, is thrown, and lands without rebound, three times.

    Oracle: it leaves where the plate falls faster than it does itself, and lands where its parabola meets the plate.
    There is no other switch.
    """
    stop = 3.3 / f
    result = play.run(PLATE.replace("@V@", repr(v)).replace("@F@", repr(f)).replace("@STOP@", repr(stop)))
    told = [(event.t, event.zone_to) for event in result.events]
    flown = [(t, later[0]) for (t, zone), later in pairwise(told) if zone == "free" and later[0] - t > 0.01 / f]
    exact = [flight for flight in flights(v, f, stop) if flight[1] < stop]
    play.check(len(flown) == len(exact), f"{len(flown)} flights, must be {len(exact)}")
    play.near("leaves and lands", flown, exact, within=2e-5 / f)
    play.check(len(told) == 2 * len(exact) + 1, f"{len(told)} switches, must be {2 * len(exact) + 1}")


@case({"on the ground": {"lower": "{type: Ground}", "pace": 0.0}, "on a shaker": {"lower": SHAKER, "pace": 4 * np.pi}},
      engines=LOCATING, treatments=NO_FRICTION)  # fmt: skip
def foot_without_inertia_that_hops(play: Play, lower: str, pace: float) -> None:
    """A body falls on a leg, a spring with a damper, whose foot has no inertia and meets a rigid stop.

    Oracle: the foot takes a force, no impulse, so that it stays until nothing presses it: times by an integrator that
    is told when.
    """
    result = play.run(FOOT.replace("@LOWER@", lower))
    found, exact = [event.t for event in result.events], hops(pace)
    play.check(len(found) == len(exact), f"{len(found)} switches, must be {len(exact)}")
    play.near("meets and leaves", found, exact, within=5e-5)
