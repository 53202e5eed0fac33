"""Rigid stops: impacts one after another, several in one instant, redundant ones, through what friction holds."""

from __future__ import annotations

import numpy as np

from tests.hard.play import Play
from tests.hard.registry import NO_FRICTION, case

LOCATING = ("rodas", "rodas3p", "ida")
"""`stepping` refuses rigid stops by name."""
G = 9.81

BALL = """
components:
  ball: {type: Mass, mass: 2 kg, position: 1 m, velocity: 0 m/s}
  weight: {type: ForceSource, force: -19.62 N}
  floor: {type: Ground}
  bounce: {type: RigidStop, restitution: @E@}
connections: [[ball.flange, weight.flange, bounce.b], [floor.flange, bounce.a]]
run: {stop: @STOP@ s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case({"half": {"e": 0.5}, "nine tenths": {"e": 0.9}}, engines=LOCATING, treatments=NO_FRICTION)
def ball_that_bounces_until_it_lies(play: Play, e: float) -> None:
    """A ball falls on a floor that gives back a share of its speed; infinitely many bounces in a finite time.

    Oracle: hits at t0, t0 (1 + 2 e), t0 (1 + 2 e + 2 e^2), ...; at rest from t0 (1 + e)/(1 - e) on; mgh is lost.
    """
    first = np.sqrt(2 / G)
    rest = first * (1 + e) / (1 - e)
    result = play.run(BALL.replace("@E@", repr(e)).replace("@STOP@", repr(float(np.ceil(rest) + 1))))
    hits = [event.t for event in result.events if event.zone_to == "touching"]
    play.near("first hits", hits[:5], first * (1 + 2 * np.cumsum([0, e, e**2, e**3, e**4])), 1e-4)
    play.near("end of the bounces", hits[-1], rest, 1e-3)
    play.near("place at the end", result["ball.x"][-1], 0.0, 1e-6)
    play.near("energy lost", result.run["energy"]["dissipated"], 2 * G, 1e-4)


@case({"with gaps": {"gap": 0.1}, "with hair gaps": {"gap": 1e-6}}, engines=LOCATING, treatments=NO_FRICTION)
def blow_through_ten_balls(play: Play, gap: float) -> None:
    """Ten equal balls in a row that lose nothing; the first runs into the others.

    Oracle: each hands its speed to the next, so that the last leaves with that of the first.
    """
    parts = [
        f"  b{i}: {{type: Mass, mass: 1 kg, position: {i * gap!r} m, velocity: {2 * (i == 0)} m/s}}" for i in range(10)
    ]
    parts += [f"  s{i}: {{type: RigidStop, restitution: 1}}" for i in range(9)]
    joins = [f"  - [b{i}.flange, s{i}.a]\n  - [b{i + 1}.flange, s{i}.b]" for i in range(9)]
    run = "run: {stop: 0.6 s, accuracy: 1e-6}\nrecord: {every: 10 ms}"
    result = play.run("\n".join(["components:", *parts, "connections:", *joins, run]) + "\n")
    play.near("speeds", [result[f"b{i}.v"][-1] for i in range(10)], [0.0] * 9 + [2.0], 1e-6)


HELD = """
components:
  one: {type: Mass, mass: 1 kg, position: 0 m, velocity: 10 m/s}
  two: {type: Mass, mass: 3 kg, position: 1 m, velocity: 0 m/s}
  stop: {type: RigidStop}
  again: {type: RigidStop}
  ground: {type: Ground}
  pad: {type: Contact, normal_force: 1 mN, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
connections:
  - [one.flange, stop.a, again.a]
  - [two.flange, stop.b, again.b, pad.b]
  - [ground.flange, pad.a]
run: {stop: 0.3 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case(engines=LOCATING, treatments=("hold", "binding", "tanh"))
def blow_through_two_stops_into_a_body_that_friction_holds(play: Play) -> None:
    """1 kg at 10 m/s runs into 3 kg, which a millinewton of friction holds, through two stops side by side.

    Oracle: both go on at 2.5 m/s, less what sliding friction takes in 0.2 s.
    """
    result = play.run(HELD)
    for name in ("one.v", "two.v"):
        play.near(name, result[name][-1], 2.5 - 5e-4 / 4 * 0.2, 1e-5)


KICKED = """
components:
  wall: {type: MotionSource, velocity: {step: {to: 2 m/s, at: 0.1 s}}, origin: 0 m}
  one: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
  two: {type: Mass, mass: 3 kg, position: 0 m, velocity: 0 m/s}
  first: {type: RigidStop, restitution: @E@}
  second: {type: RigidStop}
connections: [[wall.flange, first.a], [one.flange, first.b, second.a], [two.flange, second.b]]
run: {stop: 0.5 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case({"plastic": {"e": 0.0}, "elastic": {"e": 1.0}}, engines=LOCATING, treatments=NO_FRICTION)
def wall_that_jumps_in_speed_kicks_what_touches_it(play: Play, e: float) -> None:
    """Two bodies touch a wall, and each other, when its speed jumps.

    Oracle: both go on together at (1 + e) times the speed of the wall.
    """
    result = play.run(KICKED.replace("@E@", repr(e)))
    play.near("speeds", [result["one.v"][-1], result["two.v"][-1]], 2 * (1 + e), 1e-6)
